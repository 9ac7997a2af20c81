//! Runs that once went wrong, one table for each area: input, command, what is expected.
//!
//! A row runs in a folder of its own that holds copies of its input files, so that a command may
//! write there. Input files lie under `tests/program/cases/<area>/<input>/`.

mod contact;
mod fields;
mod files;
mod meshes;
mod sentences;
mod snapshots;
mod solvers;
mod worksheets;

use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// One row: what is run, and what it must and must not print.
struct Case {
    /// The folder of the input files below that of the area; "" where the command needs none.
    input: &'static str,
    /// A command of `sh`, with `plane-contact` on its path.
    command: &'static str,
    /// The exit status expected.
    status: i32,
    /// What standard output and standard error must contain.
    contains: &'static [&'static str],
    /// What they must not contain.
    lacks: &'static [&'static str],
}

/// Runs every row of an area and reports all that fail.
fn check(area: &str, cases: &[Case]) {
    let failures: Vec<String> = cases.iter().filter_map(|case| failure(area, case)).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
}

/// Returns what differs from what a row expects.
fn failure(area: &str, case: &Case) -> Option<String> {
    let folder = TempDir::new().expect("a folder");
    if !case.input.is_empty() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/cases");
        copy(&root.join(area).join(case.input), folder.path());
    }
    let program = Path::new(env!("CARGO_BIN_EXE_plane-contact")).parent().expect("a folder");
    let path = std::env::var("PATH").unwrap_or_default();
    let output = Command::new("sh")
        .args(["-c", case.command])
        .current_dir(folder.path())
        .env("PATH", format!("{}:{path}", program.display()))
        .env_remove("COLUMNS")
        .stdin(Stdio::null())
        .output()
        .expect("sh starts");
    let text =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    let text = text.concat();
    let missing = case.contains.iter().filter(|words| !text.contains(**words));
    let unwanted = case.lacks.iter().filter(|words| text.contains(**words));
    let mut wrong: Vec<String> = missing.map(|words| format!("lacks {words:?}")).collect();
    wrong.extend(unwanted.map(|words| format!("contains {words:?}")));
    if output.status.code() != Some(case.status) {
        wrong.push(format!("{}, expected exit status {}", output.status, case.status));
    }
    let head: String = text.chars().take(3000).collect();
    let place = format!("{area}/{}: {}", case.input, case.command);
    (!wrong.is_empty()).then(|| format!("{place}\n  {}\n{head}", wrong.join("\n  ")))
}

fn copy(from: &Path, to: &Path) {
    for entry in std::fs::read_dir(from).expect("the input files of a case") {
        let entry = entry.expect("an entry");
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            std::fs::create_dir(&target).expect("a folder");
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).expect("a file");
        }
    }
}
