//! The tables of a report as CSV (RFC 4180).

use super::model::{Block, Cell, Report, Table};
use base::plain::controls_a_terminal;

impl Report {
    /// Returns each table as CSV, with the name of its file: the first words of its title.
    pub fn csv(&self) -> Vec<(String, String)> {
        let mut files: Vec<(String, String)> = Vec::new();
        for block in &self.blocks {
            if let Block::Table { title, table } = block {
                let mut name = file_name(title);
                if files.iter().any(|(other, _)| *other == name) {
                    name += &format!("-{}", files.len() + 1);
                }
                files.push((name, table.csv()));
            }
        }
        files
    }
}

/// Returns a file's name of the first words of a title.
pub fn file_name(title: &str) -> String {
    let end = title.find([':', '(', ',']).unwrap_or(title.len());
    let words = title[..end].split(|c: char| !c.is_alphanumeric());
    let words: Vec<_> = words.filter(|word| !word.is_empty()).map(str::to_lowercase).collect();
    if words.is_empty() { "table".into() } else { words.join("-") }
}

impl<R> Table<R> {
    /// Writes the headings and the rows, numbers with all their digits.
    pub fn csv(&self) -> String {
        let field = |cell: &Cell| match cell {
            Cell::Text(text) => words(text),
            cell => cell.exact(),
        };
        let line = |cells: Vec<String>| cells.join(",") + "\r\n";
        let headings = self.headings.iter().map(|heading| words(heading)).collect();
        let rows = self.cells.iter().map(|row| row.iter().map(field).collect());
        std::iter::once(headings).chain(rows).map(line).collect()
    }
}

/// The separators of tables beside the comma, in which a cell is quoted.
const SEPARATORS: [char; 4] = [';', '\t', '\n', '|'];

/// With what a spreadsheet takes a cell for a formula.
const STARTS: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];

/// Returns words as a spreadsheet shows them and no more: an apostrophe stands before what it would take for
/// a formula, also where it has another separator than the comma; U+FFFD in place of what controls a
/// terminal.
fn words(text: &str) -> String {
    let text = text.replace(controls_a_terminal, "\u{fffd}");
    let mut shown = String::from(if text.starts_with(['\t', '\n']) { "'" } else { "" });
    for part in text.split_inclusive(SEPARATORS) {
        let is_number = part.trim_end_matches(SEPARATORS).parse::<f64>().is_ok();
        let is_formula = !is_number && part.trim_start().starts_with(STARTS);
        shown.extend([if is_formula { "'" } else { "" }, part]);
    }
    match shown.contains(['"', ',', '\n', '\r']) {
        true => format!("\"{}\"", shown.replace('"', "\"\"")),
        false => shown,
    }
}
