//! The glossary of the guide, as a table of the report.

use output::model::{Cell, Report, Table};

/// Reports each term with its meaning.
pub fn report() -> Report {
    let rows = include_str!("../../guide/glossary.md").lines().filter_map(row).skip(1);
    Report::default().table("Glossary", Table::new(["term", "meaning"], rows))
}

/// Returns the cells of a line that is a row of a table of Markdown.
fn row(line: &str) -> Option<Vec<Cell>> {
    let cells = line.strip_prefix("| ")?.strip_suffix(" |")?;
    Some(cells.split(" | ").map(Cell::from).collect())
}
