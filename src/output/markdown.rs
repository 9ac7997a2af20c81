//! A report as Markdown.

use super::model::{Block, Cell, Report, Table};
use base::plain::{controls_a_terminal, is_hidden};

impl Report {
    /// Writes the report as a page of Markdown, without its figures.
    pub fn markdown(&self) -> String {
        let blocks = self.blocks.iter().map(|block| match block {
            Block::Heading { level, text } => format!("{} {}\n", "#".repeat(*level), escaped(text)),
            Block::Line { level: 0, text } => format!("{}\n", escaped(text)),
            Block::Line { level, text } => {
                format!("{}- {}\n", "  ".repeat(level - 1), escaped(text))
            }
            Block::Code(lines) => {
                // A fence longer than any in the lines.
                let fences = lines.split(|c| c != '`').map(str::len);
                let fence = "`".repeat(fences.max().unwrap_or(0).max(2) + 1);
                let lines = lines.trim_end().replace(controls_a_terminal, "\u{fffd}");
                format!("{fence}text\n{lines}\n{fence}\n")
            }
            Block::Table { title, table } => {
                let title = (!title.is_empty()).then(|| format!("## {}\n\n", escaped(title)));
                let reasons =
                    table.reasons().into_iter().map(|why| format!("\n- -: {}\n", escaped(why)));
                title.unwrap_or_default() + &table.markdown() + &reasons.collect::<String>()
            }
            Block::Figure { .. } => String::new(),
        });
        blocks.collect::<Vec<_>>().join("\n")
    }
}

impl<R> Table<R> {
    /// Returns the report as Markdown.
    pub fn markdown(&self) -> String {
        let row = |cells: Vec<String>| {
            cells.iter().map(|cell| format!("| {} ", escaped(cell))).collect::<String>() + "|\n"
        };
        let rows = self.cells.iter().map(|cells| row(cells.iter().map(Cell::to_string).collect()));
        let rule = "|---".repeat(self.headings.len()) + "|\n";
        row(self.headings.clone()) + &rule + &rows.collect::<String>()
    }
}

/// Returns a text that stands in a line of Markdown or a cell of a table as it is.
fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '&' => "&amp;".into(),
        '<' => "&lt;".into(),
        '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '~' | '#' | '$' => format!("\\{c}"),
        c if is_hidden(c) => " ".into(),
        c => c.to_string(),
    };
    text.chars().map(escape).collect()
}
