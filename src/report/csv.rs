//! The tables of a report as CSV (RFC 4180).

use super::model::{Block, Cell, Report, Table};
use super::text::controls_a_terminal;

impl Report {
    /// Returns each table as CSV, with the name of its file: the first words of its title.
    pub fn csv(&self) -> Vec<(String, String)> {
        let mut files: Vec<(String, String)> = Vec::new();
        for block in &self.blocks {
            match block {
                Block::Table { title, table } => {
                    let mut name = file_name(title);
                    if files.iter().any(|(other, _)| *other == name) {
                        name += &format!("-{}", files.len() + 1);
                    }
                    files.push((name, table.csv()));
                }
                Block::Heading { .. }
                | Block::Line { .. }
                | Block::Code(_)
                | Block::Figure { .. } => {}
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
            Cell::Empty
            | Cell::Missing(_)
            | Cell::Integer(_)
            | Cell::Number { .. }
            | Cell::Percent(_) => cell.exact(),
        };
        let rows = self.cells.iter().map(|row| row.iter().map(field).collect());
        let headings = self.headings.iter().map(|heading| words(heading)).collect();
        std::iter::once(headings).chain(rows).map(line).collect()
    }
}

/// Returns words as a spreadsheet shows them and no more: an apostrophe stands before what it would take for
/// a formula, also where it has another separator than the comma; U+FFFD in place of what controls a terminal.
fn words(text: &str) -> String {
    let text = text.replace(controls_a_terminal, "\u{fffd}");
    let start = if text.starts_with(['\t', '\n']) { "'" } else { "" };
    start.to_string() + &text.split_inclusive(SEPARATORS).map(guarded).collect::<String>()
}

/// The separators of tables beside the comma, in which a cell is quoted.
const SEPARATORS: [char; 4] = [';', '\t', '\n', '|'];

fn guarded(part: &str) -> String {
    const STARTS: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];
    let is_number = part.trim_end_matches(SEPARATORS).parse::<f64>().is_ok();
    let is_formula = !is_number && part.trim_start().starts_with(STARTS);
    if is_formula { format!("'{part}") } else { part.into() }
}

fn line(cells: Vec<String>) -> String {
    let quoted = |cell: String| match cell.contains(['"', ',', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell,
    };
    cells.into_iter().map(quoted).collect::<Vec<_>>().join(",") + "\r\n"
}
