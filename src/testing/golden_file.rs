//! Golden files without a head: what users get, as schemas and pages, and rows.

use std::path::Path;

/// Compares `text` with the file at `path`; INSTA_UPDATE=always changes the file.
#[track_caller]
pub fn assert_file(path: &Path, text: &str) {
    assert_file_by(path, text, |golden, is| golden == is);
}

/// The same under a rule of what is the same, which gets the golden text, then the value.
#[track_caller]
pub fn assert_file_by(path: &Path, text: &str, same: fn(&str, &str) -> bool) {
    let golden = std::fs::read_to_string(path).unwrap_or_default();
    if same(&golden, text) {
        return;
    }
    if std::env::var_os("INSTA_UPDATE").is_some_and(|update| update == "always") {
        let folder = path.parent().expect("a golden file lies in a folder");
        let written = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(path, text));
        return written.expect("a golden file can be written");
    }
    let first = golden.lines().zip(text.lines()).find(|(golden, is)| !same(golden, is));
    panic!("{} differs: {first:?}", path.display());
}

/// Compares the rows of a file, behind each of which stands what `answer` gives of it, in lines that begin with two
/// blanks; lines that begin with `#` say what must hold.
#[track_caller]
pub fn assert_rows(path: &Path, same: fn(&str, &str) -> bool, answer: impl Fn(&str) -> String) {
    let text = std::fs::read_to_string(path).expect("a file of rows");
    let rows = text.lines().filter(|line| !line.starts_with("  "));
    let found = rows.map(|row| match row.starts_with('#') || row.is_empty() {
        true => format!("{row}\n"),
        false => format!("{row}\n  {}\n", answer(row).replace('\n', "\n  ")),
    });
    assert_file_by(path, &found.collect::<String>(), same);
}
