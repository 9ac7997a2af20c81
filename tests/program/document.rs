//! The audit report as a document.

use std::path::Path;

use tempfile::TempDir;

use crate::common::golden::assert_golden_by;
use crate::common::program::run;
use crate::texts::same_text;

fn output(folder: &Path, args: &[&str]) -> String {
    let output = run(folder, args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The report of fig1 in a format.
fn report(folder: &Path, format: &str) -> String {
    output(folder, &["report", "fig1", "--format", format, "--out", format]);
    std::fs::read_to_string(folder.join(format)).expect("it was written")
}

/// But for the hash of the program, and each figure is a file.
#[test]
fn a_report_in_markdown() {
    let folder = TempDir::new().expect("a folder");
    let report = report(folder.path(), "markdown");
    for line in report.lines().filter(|line| line.starts_with("![")) {
        let file = line.rsplit_once('(').expect("a link").1.trim_end_matches(')');
        let svg = std::fs::read_to_string(folder.path().join(file)).expect(file);
        roxmltree::Document::parse(&svg).unwrap_or_else(|why| panic!("{file}: {why}"));
    }
    let lines = report.lines().filter(|line| !line.starts_with("| program, SHA-256 |"));
    let lines: Vec<&str> = lines.collect();
    assert_golden_by("fig1", "report", &lines.join("\n"), same_text);
}
