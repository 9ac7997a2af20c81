//! The architecture, held to what README.md says of it: the parts of the workspace, and the paper's names
//! in the paper's room. That no part uses one that stands above it is Cargo's to check.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The parts of the workspace, each of which uses those before it only.
const PARTS: [&str; 8] =
    ["base", "numbers", "mathcad", "problem", "paper", "engine", "studies", "report"];

/// What takes the place of a part of the listings, evaluates their conditions, or writes more of them.
const STAND_INS: [&str; 3] =
    ["engine/decisions.rs", "engine/fast/listings.rs", "report/exports/mathcad.rs"];

/// The names that the top level may have.
const TOP: &[&str] = &[
    ".ci",
    ".gitignore",
    "CHANGELOG.md",
    "CITATION.cff",
    "CONTRIBUTING.md",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "SECURITY.md",
    "benches",
    "deny.toml",
    "examples",
    "fuzz",
    "golden",
    "listings",
    "rustfmt.toml",
    "src",
    "tests",
];

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

/// The manifests build no unit tests: they would not be run.
#[test]
fn every_test_stands_in_the_tests_folder() {
    let is_test = |text: &str| text.contains("#[test]") || text.contains("cfg(test)");
    let own = sources(&src()).into_iter().filter(|(_, text)| is_test(text));
    assert_eq!(own.map(|(path, _)| path).collect::<Vec<_>>(), [""; 0].map(PathBuf::from));
}

/// The paper's arrays and its arithmetic of equation numbers stand in the paper's room alone, and in what
/// stands in for its listings.
#[test]
fn the_papers_names_stay_in_the_papers_room() {
    let forbidden = [".EL[", "EL[(", "ind_1", ".S[", ".S.", ".cnt", ".trg", ".elem"];
    let mut wrong = Vec::new();
    for (path, text) in sources(&src()) {
        let inside = path.strip_prefix(src()).expect("a file of src").display().to_string();
        if inside.starts_with("paper/") || STAND_INS.contains(&inside.as_str()) {
            continue;
        }
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            // What stands between quotation marks is no code.
            let code: String = line.split('"').step_by(2).collect();
            if forbidden.iter().any(|name| is_named(&code, name)) {
                wrong.push(format!("{inside}: {line}"));
            }
        }
    }
    assert!(wrong.is_empty(), "the paper's names outside src/paper:\n{}", wrong.join("\n"));
}

/// Whether a line has a name, behind which no letter follows.
fn is_named(code: &str, name: &str) -> bool {
    code.match_indices(name).any(|(at, _)| {
        let next = code[at + name.len()..].chars().next();
        !name.ends_with(char::is_alphanumeric)
            || !next.is_some_and(|c| c.is_alphanumeric() || c == '_')
    })
}

#[test]
fn names_are_found() {
    assert!(is_named("sheet.cnt[i]", ".cnt") && is_named("sheet.S[2]", ".S["));
    assert!(!is_named("self.cnt_of", ".cnt") && !is_named("sheet.element", ".elem"));
}

/// What stands at the top: what the project is made of, and what Cargo and git conventions call for.
#[test]
fn the_top_level_has_what_belongs_there() {
    let output = std::process::Command::new("git")
        .args(["ls-files", "-z"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output();
    // Without git, or outside a repository, nothing tells a file of the project from a result.
    let Some(output) = output.ok().filter(|output| output.status.success()) else { return };
    let files = String::from_utf8(output.stdout).expect("names are UTF-8");
    let top = |file: &str| file.split('/').next().expect("a name").to_string();
    let found: BTreeSet<String> = files.split_terminator('\0').map(top).collect();
    let known: BTreeSet<String> = TOP.iter().map(ToString::to_string).collect();
    let unknown: Vec<&String> = found.difference(&known).collect();
    assert!(unknown.is_empty(), "{unknown:?} do not belong at the top level");
}
