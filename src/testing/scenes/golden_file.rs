//! Golden files that are what users get, without a head: schemas, pages.

use std::path::Path;

/// Compares `text` with the file at `path`; INSTA_UPDATE=always changes the file.
#[track_caller]
pub fn assert_file(path: &Path, text: &str) {
    if std::env::var_os("INSTA_UPDATE").is_some_and(|update| update == "always") {
        let folder = path.parent().expect("a golden file lies in a folder");
        let written = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(path, text));
        written.expect("a golden file can be written");
    }
    let golden = std::fs::read_to_string(path).unwrap_or_default();
    let lines = || golden.lines().zip(text.lines()).enumerate();
    let first = lines().find(|(_, (golden, is))| golden != is);
    assert!(golden == text, "{} differs: {first:?}", path.display());
}
