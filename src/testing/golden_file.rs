//! Golden files, each compared under a rule of what is the same; `GOLDEN=write` in the environment writes anew those that
//! differ. A path that is not whole is below the package's folder, in which Cargo runs its tests.

use std::fs::{OpenOptions, create_dir_all, read_to_string, write};
use std::io::Write;
use std::path::{Path, absolute};

/// Whether what differs is written anew.
pub fn is_written() -> bool {
    std::env::var("GOLDEN").is_ok_and(|how| how == "write")
}

/// Compares `text` with the file at `path`, to the letter.
#[track_caller]
pub fn assert_file(path: impl AsRef<Path>, text: &str) {
    assert_file_by(path, text, |golden, is| golden == is);
}

/// The same under a rule of what is the same, which gets the golden text, then the value. The path goes to the list
/// that `GOLDEN_USED` names.
#[track_caller]
pub fn assert_file_by(path: impl AsRef<Path>, text: &str, same: fn(&str, &str) -> bool) {
    let path = path.as_ref();
    if let Some(list) = std::env::var_os("GOLDEN_USED") {
        let line = format!("{}\n", absolute(path).expect("a path").display());
        let list = OpenOptions::new().append(true).create(true).open(list);
        list.and_then(|mut list| list.write_all(line.as_bytes())).expect("the list of used files");
    }
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
