//! The parts of the workspace: each uses those before it, and no test stands where it is not run.

use std::path::{Path, PathBuf};

/// The parts of the workspace, each of which uses those before it only.
const PARTS: [&str; 9] =
    ["base", "numbers", "mathcad", "problem", "paper", "engine", "report", "commands", "studies"];

/// The source files below a folder, each with its text.
fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder of src") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = std::fs::read_to_string(&path).expect("a source file is text");
            files.push((path, text));
        }
    }
    files
}

fn src() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The reference and what it rests on build without the engine.
#[test]
fn each_part_uses_those_before_it() {
    for (place, part) in PARTS.iter().enumerate() {
        let manifest = std::fs::read_to_string(src().join(part).join("Cargo.toml"));
        let manifest = manifest.expect("a part has a manifest");
        let used = manifest.lines().filter_map(|line| line.strip_prefix("plane-contact-"));
        for used in used.map(|line| line.trim_end_matches(".workspace = true")) {
            assert!(PARTS[..place].contains(&used), "{part} uses {used}");
        }
    }
}

/// Where a manifest builds no tests, they would not be run.
#[test]
fn tests_stand_where_they_are_built() {
    let tests = PARTS.map(|part| {
        let manifest = std::fs::read_to_string(src().join(part).join("Cargo.toml"));
        (src().join(part), !manifest.expect("a part has a manifest").contains("test = false"))
    });
    let is_test = |text: &str| text.contains("#[test]") || text.contains("cfg(test)");
    let is_built = |path: &Path| tests.iter().any(|(part, built)| *built && path.starts_with(part));
    let lost = sources(&src()).into_iter().filter(|(path, text)| is_test(text) && !is_built(path));
    assert_eq!(lost.map(|(path, _)| path).collect::<Vec<_>>(), [""; 0].map(PathBuf::from));
}
