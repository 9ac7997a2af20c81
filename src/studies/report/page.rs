//! The page of an audit report: the first screen, then the report as a document.

use serde_json::json;

use super::{Contents, first, parts};
use output::json::document;
use output::page::Page;

/// Returns the page of a report.
pub fn html(contents: &Contents) -> String {
    let parts = parts(contents);
    let first = first::html(contents, &first::menu(&parts));
    Page {
        title: &format!("Report: {}", contents.audit.scene.name),
        body: &format!("{first}<main>\n<article>\n{}</article>\n</main>\n", parts.html()),
        style: include_str!("page/report.css"),
        script: &[output::page::TABLE, include_str!("page/report.js")],
        data: document(Some(&contents.audit.scene), &json!({})),
    }
    .html()
}
