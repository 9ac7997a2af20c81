//! A report as Markdown.

use super::csv::file_name;
use super::model::{Block, Cell, Report, Table};
use base::plain::{controls_a_terminal, is_hidden};

impl Report {
    /// Returns the report as that of a page of this name, in whose folder its figures are.
    pub fn of_page(self, page: &str) -> Self {
        Report { figures: figures_of(page) + "/", ..self }
    }

    /// Writes the report as a page of Markdown, whose figures are the files of
    /// [`figures`](Report::figures) beside it.
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
            Block::Figure { title, .. } => {
                format!("![{0}]({1})\n\n{0}\n", escaped(title), self.figure_file(title))
            }
        });
        blocks.collect::<Vec<_>>().join("\n")
    }

    /// Returns each figure, a file of SVG, with the name of its file.
    pub fn figures(&self) -> Vec<(String, &str)> {
        let figures = self.blocks.iter().filter_map(|block| {
            let Block::Figure { title, svg } = block else { return None };
            Some((self.figure_file(title), svg.as_str()))
        });
        figures.collect()
    }

    fn figure_file(&self, title: &str) -> String {
        format!("{}{}.svg", self.figures, file_name(title))
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

/// Returns the folder of the figures of a page, beside it, so that those of another page stay: a name that is
/// a link as it stands.
pub fn figures_of(page: &str) -> String {
    page.replace(|c: char| !c.is_alphanumeric() && !"_-".contains(c), "-") + "-figures"
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
