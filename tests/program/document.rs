//! The audit report as a document: its two formats and the commands that explain a claim or a finding
//! say the same sentences.

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

/// A text on one line, without marks of code.
fn words(text: &str) -> String {
    text.replace('`', "").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What a page of HTML says: its article without tags.
fn said(html: &str) -> String {
    let (_, article) = html.split_once("<article>").expect("an article");
    let (article, _) = article.split_once("</article>").expect("its end");
    let text = article.split('<').map(|part| part.split_once('>').map_or(part, |(_, text)| text));
    let text: String = text.collect();
    let entities = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&amp;", "&")];
    words(&entities.iter().fold(text, |text, (entity, c)| text.replace(entity, c)))
}

/// The sentences of a line of Markdown: the cells of a row, or what follows the marks of a heading, an
/// item or a figure; none of a fence or of a rule under headings.
fn sentences(line: &str) -> Vec<String> {
    let plain = |text: &str| {
        let text = text.replace("&lt;", "<").replace("&amp;", "&");
        words(&text.replace("\\\\", "\u{0}").replace('\\', "").replace('\u{0}', "\\"))
    };
    if line.starts_with("```") || line.starts_with("|---") || line.starts_with("![") {
        return Vec::new();
    }
    if let Some(row) = line.strip_prefix("| ") {
        let row = row.trim_end_matches(" |").replace("\\|", "\u{1}");
        return row.split(" | ").map(|cell| plain(&cell.replace('\u{1}', "|"))).collect();
    }
    let line = line.trim_start();
    let line = line.trim_start_matches('#').trim_start();
    vec![plain(line.strip_prefix("- ").unwrap_or(line))]
}

#[test]
fn html_markdown_and_the_texts_of_audit_say_the_same() {
    let folder = TempDir::new().expect("a folder");
    let [html, markdown] = ["html", "markdown"].map(|format| report(folder.path(), format));
    let html = said(&html);
    let of_markdown =
        markdown.strip_prefix("<!-- plane-contact -->\n").expect("the mark of its folder");
    let of_markdown = of_markdown.lines().flat_map(sentences);
    // The command names its own format.
    let of_markdown: Vec<String> =
        of_markdown.filter(|sentence| !sentence.ends_with("--format markdown")).collect();
    assert!(of_markdown.len() > 500, "{}", of_markdown.len());
    let explained = ["P1", "P12", "P13"].map(|id| ["audit", "fig1", "--claim", id]);
    let explained = explained
        .into_iter()
        .chain(["C4", "C8", "K1"].map(|id| ["audit", "fig1", "--finding", id]));
    let texts = explained.flat_map(|args| {
        let text = output(folder.path(), &args);
        // The verdicts under other readings are a table of their own.
        let lines = text.lines().take_while(|line| !line.starts_with("Under other readings"));
        let lines = lines.filter(|line| !line.starts_with("On scene fig1 ("));
        lines.map(words).collect::<Vec<_>>()
    });
    for sentence in of_markdown.iter().cloned().chain(texts) {
        assert!(html.contains(&sentence), "{sentence}");
    }
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

/// What stays English are names, commands, quotations, and what stops a run.
#[test]
fn a_report_in_russian() {
    let folder = TempDir::new().expect("a folder");
    let args = ["report", "fig1", "--lang", "ru", "--format", "markdown", "--out", "markdown"];
    output(folder.path(), &args);
    let report = std::fs::read_to_string(folder.path().join("markdown")).expect("it was written");
    let lines = report.lines().filter(|line| !line.starts_with("| программа, SHA-256 |"));
    assert_golden_by("fig1", "report-ru", &lines.collect::<Vec<_>>().join("\n"), same_text);
}
