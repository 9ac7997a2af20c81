//! The audit report as a document.

use tempfile::TempDir;

use crate::common::golden_file::assert_text;
use crate::common::program::run;
use crate::common::same_text::same_text;

/// The text of the report of fig1, a line for each line of its page, but for the hash of the program.
#[test]
fn what_a_report_says() {
    let folder = TempDir::new().expect("a folder");
    let made = run(folder.path(), &["report", "fig1", "--out", "r.html"]);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let page = std::fs::read_to_string(folder.path().join("r.html")).expect("it was written");
    let body = page.split_once("<body").expect("a body").1.split("<script").next().expect("text");
    let apart = ["</td>", "</th>", "</li>", "</summary>"]
        .iter()
        .fold(body.to_string(), |text, end| text.replace(end, " | "));
    let words = apart.split('<').map(|part| part.split_once('>').map_or("", |(_, text)| text));
    let text: String = words.collect();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let lines: Vec<&str> = lines.filter(|line| !line.starts_with("program, SHA-256")).collect();
    assert_text("golden/fig1/report.snap", &lines.join("\n"), same_text);
}
