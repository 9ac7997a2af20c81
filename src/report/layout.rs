//! Tables and lists of words.

use std::fmt::Display;

/// A table with a line for each of its rows, made column by column.
pub struct Table<R> {
    rows: Vec<R>,
    lines: Vec<Vec<String>>,
    head: Vec<String>,
}

impl<R> Table<R> {
    pub fn of(rows: impl IntoIterator<Item = R>) -> Self {
        let rows: Vec<R> = rows.into_iter().collect();
        Table { lines: vec![Vec::new(); rows.len()], rows, head: Vec::new() }
    }

    /// Adds a column: its heading, and what it shows of each row.
    pub fn column<D: Display>(mut self, heading: impl Display, cell: impl Fn(&R) -> D) -> Self {
        self.head.push(heading.to_string());
        for (line, row) in self.lines.iter_mut().zip(&self.rows) {
            line.push(cell(row).to_string());
        }
        self
    }

    pub fn text(self) -> String {
        aligned(self.head, self.lines)
    }
}

/// Lays out rows of cells in columns under their headings: numbers to the right, words to the left.
/// A row may have fewer cells than the heading, or more.
pub fn aligned(
    head: impl IntoIterator<Item = impl Display>,
    rows: impl IntoIterator<Item = Vec<String>>,
) -> String {
    let head = head.into_iter().map(|heading| heading.to_string()).collect();
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let column = |j: usize| rows.iter().filter_map(move |row| row.get(j));
    let width = |j| column(j).map(|cell| cell.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let numeric: Vec<bool> =
        (0..columns).map(|j| column(j).skip(1).all(|cell| is_number(cell))).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).zip(&numeric).map(|((cell, &width), numeric)| {
            if *numeric { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
        });
        format!("  {}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
    };
    let rule: Vec<String> = widths.iter().map(|width| "-".repeat(*width)).collect();
    let under_heading = format!("  {}\n", rule.join("  "));
    let lines: String = rows[1..].iter().map(line).collect();
    line(&rows[0]) + &under_heading + &lines
}

/// Returns whether a cell is a number, a percentage, or `-` for none.
fn is_number(cell: &str) -> bool {
    cell == "-" || cell.trim_end_matches(" %").parse::<f64>().is_ok()
}

/// Writes a number of things: `1 matrix`, `2 matrices`.
pub fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// Writes items one behind the other, with a comma between two.
pub fn listed(items: impl IntoIterator<Item = impl Display>) -> String {
    items.into_iter().map(|item| item.to_string()).collect::<Vec<_>>().join(", ")
}

/// Fills lines of at most `width` characters with items, one behind the other: the first line begins
/// with `start`, the others with `hang` blanks. An item longer than a line has one of its own.
pub fn filled(
    start: &str,
    hang: usize,
    width: usize,
    items: impl IntoIterator<Item = impl Display>,
    separator: &str,
) -> String {
    let (mut text, mut line) = (String::new(), start.to_string());
    for (k, item) in items.into_iter().enumerate() {
        let item = item.to_string();
        let length = [&line, separator, &item, separator.trim_end()].map(|s| s.chars().count());
        if k > 0 && length.iter().sum::<usize>() > width {
            text += &format!("{}\n", (line + separator).trim_end());
            line = " ".repeat(hang);
        } else if k > 0 {
            line += separator;
        }
        line += &item;
    }
    text + &line + "\n"
}
