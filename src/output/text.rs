//! A report as text, fitted to a width, with nothing in it that controls a terminal.

use super::layout::filled;
use super::model::{Block, Cell, Report, Table};
use base::plain::controls_a_terminal;

/// The most characters of a line of a table.
pub const COLUMNS: usize = 100;

/// The most lines of a cell that stands in its column; longer prose reads better in a record of its own.
const LINES: usize = 4;

impl Report {
    /// Writes the report in lines of at most `width` characters: prose is broken between words, a table has
    /// at most [`COLUMNS`].
    pub fn text(&self, width: usize) -> String {
        let mut text = String::new();
        let mut previous = None;
        for block in &self.blocks {
            if previous.is_some_and(|previous| is_apart(previous, block)) {
                text += "\n";
            }
            text += &match block {
                Block::Heading { text, .. } => fitted(text, width),
                Block::Line { level, text } => fitted(&indented(text, *level), width),
                Block::Code(lines) => fitted(&indented(lines, 1), width),
                Block::Table { title, table } if title.is_empty() => table.text(width),
                Block::Table { title, table } => fitted(title, width) + &table.text(width),
                Block::Figure { title, .. } => fitted(title, width),
            };
            previous = Some(block);
        }
        text
    }
}

/// Whether a blank line stands between two blocks.
fn is_apart(previous: &Block, next: &Block) -> bool {
    match (previous, next) {
        (_, Block::Heading { .. } | Block::Figure { .. }) => true,
        (_, Block::Table { title, .. }) if !title.is_empty() => true,
        (Block::Table { .. }, Block::Table { .. }) => true,
        (Block::Heading { .. } | Block::Line { level: 0, .. }, _) => false,
        (_, Block::Line { level, .. }) => *level == 0,
        (_, Block::Code(_) | Block::Table { .. }) => false,
    }
}

fn indented(text: &str, level: usize) -> String {
    text.lines().map(|line| format!("{}{line}\n", "  ".repeat(level))).collect()
}

/// Returns text as it is shown in lines of at most `width` characters: a line is broken between
/// words, a word that is longer than a line too, and what controls a terminal becomes U+FFFD.
pub fn fitted(text: &str, width: usize) -> String {
    let text = text.replace(controls_a_terminal, "\u{fffd}");
    let text: String = text.lines().map(|line| prose(line, width)).collect();
    text.lines().map(|line| broken(line, width)).collect()
}

fn length(line: &str) -> usize {
    line.chars().count()
}

/// Fills a line between words; where it is longer than `width`, the next ones stand two further in.
fn prose(line: &str, width: usize) -> String {
    if length(line) <= width {
        return format!("{line}\n");
    }
    let words = line.trim_start();
    let blanks = line.len() - words.len();
    filled(&" ".repeat(blanks), blanks + 2, width, words)
}

/// Breaks a line within its words where it is longer than `width`, after a slash where there is one.
fn broken(line: &str, width: usize) -> String {
    let (mut text, mut rest) = (String::new(), line.to_string());
    let indent = line.len() - line.trim_start_matches(' ').len();
    while length(&rest) > width {
        let fits: String = rest.chars().take(width).collect();
        let slash = fits.rfind('/').map(|place| place + 1).filter(|place| *place > indent + 1);
        let (start, end) = rest.split_at(slash.unwrap_or(fits.len()));
        text += &format!("{}\n", start.trim_end());
        rest = " ".repeat(indent) + end.trim_start();
    }
    text + &rest + "\n"
}

impl Table {
    /// Writes the rows in columns, or as records where these are too wide; then why numbers are missing,
    /// each reason once.
    fn text(&self, width: usize) -> String {
        let width = width.min(COLUMNS);
        let shown = |cell: &Cell| cell.to_string().replace(char::is_whitespace, " ");
        let rows: Vec<Vec<String>> =
            self.cells.iter().map(|row| row.iter().map(shown).collect()).collect();
        let rows = self.columns(&rows, width).unwrap_or_else(|| self.records(&rows, width));
        let notes = self.reasons().into_iter().map(|reason| format!("  -: {reason}\n"));
        fitted(&(rows + &notes.collect::<String>()), width)
    }

    /// Lays out the rows in columns under their headings: numbers to the right, words to the left, both
    /// broken between words where they are wide; nothing where that takes too many lines.
    fn columns(&self, rows: &[Vec<String>], width: usize) -> Option<String> {
        let numeric: Vec<bool> = (0..self.headings.len()).map(|j| self.is_numeric(j)).collect();
        let longest = |j: usize, of: fn(&str) -> usize, of_number: fn(&str) -> usize| {
            let of_cell = if numeric[j] { of_number } else { of };
            let cells = rows.iter().map(|row| of_cell(&row[j]));
            cells.chain([of(&self.headings[j])]).max().unwrap_or(0)
        };
        let word = |text: &str| text.split(' ').map(length).max().unwrap_or(0);
        let bounds: Vec<[usize; 2]> = (0..numeric.len())
            .map(|j| [longest(j, word, length), longest(j, length, length)])
            .collect();
        // The widest column that is allowed: as wide as all together leave room for.
        let at_most = |most: usize| -> Vec<usize> {
            bounds.iter().map(|[least, natural]| most.clamp(*least, *natural)).collect()
        };
        let widths = (0..=width)
            .rev()
            .map(at_most)
            .find(|widths| widths.iter().map(|width| width + 2).sum::<usize>() <= width)?;
        let broken = |cells: &Vec<String>| -> Vec<Vec<String>> {
            let lines = |(cell, width): (&String, &usize)| -> Vec<String> {
                let text = filled("", 0, *width, cell);
                text.lines().map(String::from).collect()
            };
            cells.iter().zip(&widths).map(lines).collect()
        };
        let rows: Vec<Vec<Vec<String>>> = rows.iter().map(broken).collect();
        if rows.iter().flatten().any(|lines| lines.len() > LINES) {
            return None;
        }
        let padded = |text: &str, j: usize| {
            // A width of `format!` ends at 65,535.
            let blanks = " ".repeat(widths[j] - length(text));
            if numeric[j] { blanks + text } else { text.to_string() + &blanks }
        };
        let row = |cells: &Vec<Vec<String>>| -> String {
            let line = |k: usize| {
                let cell = |(j, lines): (usize, &Vec<String>)| {
                    padded(lines.get(k).map_or("", String::as_str), j)
                };
                let cells: Vec<String> = cells.iter().enumerate().map(cell).collect();
                format!("  {}\n", cells.join("  ").trim_end())
            };
            (0..cells.iter().map(Vec::len).max().unwrap_or(0)).map(line).collect()
        };
        let rule: Vec<String> = widths.iter().map(|width| "-".repeat(*width)).collect();
        let rows: String = rows.iter().map(row).collect();
        Some(format!("{}  {}\n{rows}", row(&broken(&self.headings)), rule.join("  ")))
    }

    /// Writes a record for each row: its first cell, then each other cell beside its heading, or
    /// behind it where that would be too wide.
    fn records(&self, rows: &[Vec<String>], width: usize) -> String {
        let headings = self.headings.iter().skip(1).map(|heading| length(heading)).max();
        let headings = headings.unwrap_or(0);
        let records = |beside: bool| {
            let mut text = String::new();
            for row in rows {
                let first = format!("{} {}", self.headings[0], row[0]);
                text += &filled("  ", 4, width, first.trim());
                let cells = self.headings.iter().zip(row).skip(1);
                for (heading, cell) in cells.filter(|(_, cell)| !cell.is_empty()) {
                    text += &if beside {
                        let blanks = " ".repeat(headings - length(heading));
                        let start = format!("    {heading}{blanks}  ");
                        filled(&start, headings + 6, width, cell)
                    } else {
                        let words = format!("{heading}: {cell}");
                        prose(&format!("    {}", words.trim_start_matches(": ")), width)
                    };
                }
            }
            text
        };
        let beside = records(true);
        let fits = beside.lines().all(|line| length(line) <= width);
        if fits { beside } else { records(false) }
    }
}
