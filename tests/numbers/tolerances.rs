//! The table of tolerances has none that no test uses.

use std::collections::BTreeSet;
use std::path::Path;

use crate::common::tolerances::TABLE;

/// The source of every test.
fn sources(folder: &Path) -> Vec<String> {
    let mut sources = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("a folder entry").path();
        if path.is_dir() {
            sources.extend(self::sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            sources.push(std::fs::read_to_string(path).expect("a source file"));
        }
    }
    sources
}

/// What a source file takes from the table: the names after `tolerances::`, one or in braces. The
/// compiler warns of a name that is taken and not used.
fn taken(source: &str) -> Vec<&str> {
    let after = source.split("tolerances::").skip(1);
    let names = after.map(|text| match text.strip_prefix('{') {
        Some(list) => list.split('}').next().unwrap_or(list),
        None => text.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or(text),
    });
    names.flat_map(|names| names.split(',').map(str::trim)).collect()
}

#[test]
fn every_tolerance_is_used_by_a_test() {
    let sources = sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests"));
    let taken: BTreeSet<&str> = sources.iter().flat_map(|source| taken(source)).collect();
    let unused: Vec<_> =
        TABLE.iter().map(|(name, _)| *name).filter(|n| !taken.contains(n)).collect();
    assert!(unused.is_empty(), "no test uses {unused:?}");
}
