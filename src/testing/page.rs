//! Pages that tests make, of tables in Markdown.

use crate::golden_file::assert_file;

/// Asserts that `golden/tables/<name>.md` has a title, where its numbers come from (a command that prints them, or a
/// test), and a table.
#[track_caller]
pub fn assert_table(name: &str, title: &str, source: &str, table: &str) {
    let text = format!("**{title}** {source}.\n\n{table}");
    assert_file(format!("golden/tables/{name}.md"), &text);
}

/// A table, from its head and its rows, the cells of each apart by `|`.
pub fn markdown(head: &str, rows: impl IntoIterator<Item = String>) -> String {
    let rule = "---|".repeat(head.split('|').count());
    let rows: String = rows.into_iter().map(|row| format!("| {row} |\n")).collect();
    format!("| {head} |\n|{rule}\n{rows}")
}

/// A row of texts, which may have that sign in them.
pub fn row(cells: &[&str]) -> String {
    cells.iter().map(|cell| cell.replace('|', "\\|")).collect::<Vec<_>>().join(" | ")
}

/// A share in per cent; what is rounding alone is 0.
pub fn percent(share: f64, decimals: usize) -> String {
    if share.abs() < 1e-9 { "0".into() } else { format!("{:.decimals$} %", 100.0 * share) }
}
