//! Golden files, each compared under a rule of what is the same: texts by insta (`.snap`), and what has no room for its
//! head, as pages, schemas and rows. `INSTA_UPDATE=always` in the environment writes anew those that differ. A path that is
//! not whole is below the package's folder, in which Cargo runs its tests.

use std::fs::{create_dir_all, read_to_string, write};
use std::path::{Path, absolute};

use insta::internals::SnapshotContents;
use insta::{Comparator, Settings, Snapshot};

/// Whether what differs is written anew.
pub fn is_written() -> bool {
    std::env::var("INSTA_UPDATE").is_ok_and(|how| how == "always")
}

/// Compares `text` with the snapshot at `path`, under a rule of what is the same, which gets the
/// golden text, then the value. `cargo insta review` shows what differs.
#[track_caller]
pub fn assert_text(path: impl AsRef<Path>, text: &str, same: fn(&str, &str) -> bool) {
    let path = absolute(path).expect("a path");
    let name = path.file_stem().and_then(|name| name.to_str()).expect("a name");
    let mut settings = Settings::clone_current();
    settings.set_snapshot_path(path.parent().expect("a snapshot lies in a folder"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_comparator(Box::new(Rule(same)));
    settings.bind(|| insta::assert_snapshot!(name, text));
}

/// A rule of what is the same.
struct Rule(fn(&str, &str) -> bool);

impl Comparator for Rule {
    fn matches(&self, golden: &Snapshot, is: &Snapshot) -> bool {
        match (golden.contents(), is.contents()) {
            (SnapshotContents::Text(golden), SnapshotContents::Text(is)) => {
                (self.0)(&golden.to_string(), &is.to_string())
            }
            _ => false,
        }
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(Rule(self.0))
    }
}

/// Compares `text` with the file at `path`, to the letter.
#[track_caller]
pub fn assert_file(path: impl AsRef<Path>, text: &str) {
    assert_file_by(path, text, |golden, is| golden == is);
}

/// The same under a rule of what is the same, which gets the golden text, then the value.
#[track_caller]
pub fn assert_file_by(path: impl AsRef<Path>, text: &str, same: fn(&str, &str) -> bool) {
    let path = path.as_ref();
    let golden = read_to_string(path).unwrap_or_default();
    if same(&golden, text) {
        return;
    }
    if is_written() {
        let folder = path.parent().expect("a golden file lies in a folder");
        let written = create_dir_all(folder).and_then(|()| write(path, text));
        return written.expect("a golden file can be written");
    }
    let first = golden.lines().zip(text.lines()).find(|(golden, is)| !same(golden, is));
    let (golden, is) = first.unwrap_or(("as many lines", "more or fewer"));
    panic!("{} differs:\nexpected {golden}\n     got {is}", path.display());
}

/// Compares the rows of a file, behind each of which stands what `answer` gives of it, in lines that begin with two
/// blanks; lines that begin with `#` say what must hold.
#[track_caller]
pub fn assert_rows(path: impl AsRef<Path>, answer: impl Fn(&str) -> String) {
    assert_rows_by(path, |golden, is| golden == is, answer);
}

/// The same under a rule of what is the same.
#[track_caller]
pub fn assert_rows_by(
    path: impl AsRef<Path>,
    same: fn(&str, &str) -> bool,
    answer: impl Fn(&str) -> String,
) {
    let text = read_to_string(&path).expect("a file of rows");
    let rows = text.lines().filter(|line| !line.starts_with("  "));
    let found = rows.map(|row| match row.starts_with('#') || row.is_empty() {
        true => format!("{row}\n"),
        false => format!("{row}\n  {}\n", answer(row).replace('\n', "\n  ")),
    });
    assert_file_by(path, &found.collect::<String>(), same);
}
