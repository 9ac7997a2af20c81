//! What a command reports to people: headings, lines, code, tables with typed cells, figures. Text,
//! CSV, Markdown and HTML are renderings of it (`text`, `csv`, `markdown`, `html`).

use std::fmt::{self, Display, Formatter};

use indexmap::IndexSet;

use super::numbers::{Digits, long, percent};
use problem::model::{NodeId, TriangleId};

/// A report, from its first block to its last.
#[must_use]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Its parts, in their order.
    pub blocks: Vec<Block>,
}

/// A part of a report.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "what is said of each names its fields")]
pub enum Block {
    /// The heading of the report (level 1), of a section (level 2), or of a part of one.
    Heading { level: usize, text: String },
    /// A line of prose; from level 1 on it belongs to what stands above it.
    Line { level: usize, text: String },
    /// Lines that are shown as they are.
    Code(String),
    /// A table under its title, which may be empty.
    Table { title: String, table: Table },
    /// A picture, as a file of SVG, under its title.
    Figure { title: String, svg: String },
}

impl Report {
    /// Starts a report under its heading.
    pub fn titled(text: impl Into<String>) -> Self {
        Report::default().with(Block::Heading { level: 1, text: text.into() })
    }

    fn with(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    /// Returns the report with the heading of a section behind it.
    pub fn heading(self, text: impl Into<String>) -> Self {
        self.with(Block::Heading { level: 2, text: text.into() })
    }

    /// Returns the report with a line of prose behind it.
    pub fn line(self, text: impl Into<String>) -> Self {
        self.with(Block::Line { level: 0, text: text.into() })
    }

    /// Adds a line that belongs to what stands above it.
    pub fn note(self, text: impl Into<String>) -> Self {
        self.with(Block::Line { level: 1, text: text.into() })
    }

    /// Adds a line that belongs to the note above it.
    pub fn detail(self, text: impl Into<String>) -> Self {
        self.with(Block::Line { level: 2, text: text.into() })
    }

    /// Adds notes, or the one note that an option has.
    pub fn notes(self, texts: impl IntoIterator<Item = impl Into<String>>) -> Self {
        texts.into_iter().fold(self, Report::note)
    }

    /// Adds details, or the one detail that an option has.
    pub fn details(self, texts: impl IntoIterator<Item = impl Into<String>>) -> Self {
        texts.into_iter().fold(self, Report::detail)
    }

    /// Returns the report with lines that are shown as they are.
    pub fn code(self, lines: impl Into<String>) -> Self {
        self.with(Block::Code(lines.into()))
    }

    /// Adds a table under its title, whose first words name its CSV file.
    pub fn table<R>(self, title: impl Into<String>, table: Table<R>) -> Self {
        let Table { headings, cells, .. } = table;
        self.with(Block::Table { title: title.into(), table: Table { rows: (), headings, cells } })
    }

    /// Adds a picture, as a file of SVG, whose title's first words name its file.
    pub fn figure(self, title: impl Into<String>, svg: impl Into<String>) -> Self {
        self.with(Block::Figure { title: title.into(), svg: svg.into() })
    }

    /// Returns the report with its headings so many levels deeper, as a part of another one.
    pub fn deeper(mut self, levels: usize) -> Self {
        for block in &mut self.blocks {
            if let Block::Heading { level, .. } = block {
                *level += levels;
            }
        }
        self
    }

    /// Adds all of another report.
    pub fn then(mut self, other: Report) -> Self {
        self.blocks.extend(other.blocks);
        self
    }
}

/// Cells in rows and columns, made column by column of `rows`.
#[must_use]
#[derive(Clone, Debug, PartialEq)]
pub struct Table<R = ()> {
    rows: R,
    /// The headings of the columns.
    pub headings: Vec<String>,
    /// Row by row, a cell for each heading.
    pub cells: Vec<Vec<Cell>>,
}

impl Table {
    /// Makes a table row by row; a row may have fewer cells than there are headings.
    pub fn new(
        headings: impl IntoIterator<Item = impl Display>,
        rows: impl IntoIterator<Item = Vec<Cell>>,
    ) -> Self {
        let headings: Vec<String> =
            headings.into_iter().map(|heading| heading.to_string()).collect();
        let cells = rows.into_iter().map(|mut row| {
            row.resize(headings.len(), Cell::Empty);
            row
        });
        Table { rows: (), cells: cells.collect(), headings }
    }
}

impl<R> Table<R> {
    /// Puts a column before the others that counts the rows from 1.
    pub fn numbered(mut self, heading: &str) -> Self {
        self.headings.insert(0, heading.into());
        self.cells.iter_mut().zip(1_usize..).for_each(|(row, n)| row.insert(0, n.into()));
        self
    }

    /// Whether a column stands to the right: it has numbers alone, or nothing in place of one.
    pub fn is_numeric(&self, column: usize) -> bool {
        self.cells.iter().all(|row| row[column].is_numeric())
    }

    /// Returns why numbers are missing, each reason once.
    pub fn reasons(&self) -> IndexSet<&'static str> {
        let reason = |cell| if let &Cell::Missing(reason) = cell { reason } else { None };
        self.cells.iter().flatten().filter_map(reason).collect()
    }
}

impl<R> Table<Vec<R>> {
    /// Starts a table with a row for each of `rows`.
    pub fn from_rows(rows: impl IntoIterator<Item = R>) -> Self {
        let rows: Vec<R> = rows.into_iter().collect();
        Table { cells: vec![Vec::new(); rows.len()], rows, headings: Vec::new() }
    }

    /// Adds a column: its heading, and its cell of each row.
    pub fn column<C: Into<Cell>>(mut self, heading: impl Display, cell: impl Fn(&R) -> C) -> Self {
        self.headings.push(heading.to_string());
        for (cells, row) in self.cells.iter_mut().zip(&self.rows) {
            cells.push(cell(row).into());
        }
        self
    }
}

/// A cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Nothing belongs here.
    Empty,
    /// There is no number, and why.
    Missing(Option<&'static str>),
    /// Words.
    Text(String),
    /// A whole number.
    Integer(i128),
    /// A finite number, and how it is shown.
    #[expect(missing_docs, reason = "said of both")]
    Number { value: f64, shown: String },
}

impl Cell {
    /// Shows a number with all its digits.
    pub fn plain(value: f64) -> Self {
        Cell::number(value, |x| x.to_string())
    }

    /// Shows a number with so many decimals.
    pub fn decimals(value: f64, decimals: usize) -> Self {
        Cell::of_digits(value, Digits::Decimals(decimals))
    }

    /// Shows a number with so many decimals before a power of ten.
    pub fn scientific(value: f64, decimals: usize) -> Self {
        Cell::of_digits(value, Digits::Scientific(decimals))
    }

    /// Shows a number with the digits that an error leaves.
    pub fn of_digits(value: f64, digits: Digits) -> Self {
        Cell::number(value, |x| digits.write(x))
    }

    /// Shows a part of 1 in per cent.
    pub fn percent(part: f64) -> Self {
        Cell::number(part, percent)
    }

    fn number(value: f64, written: impl Fn(f64) -> String) -> Self {
        match value.is_finite() {
            true => Cell::Number { value, shown: written(value) },
            false => Cell::Missing(None),
        }
    }

    /// Says why there is no number, where there is none.
    pub fn because(self, reason: &'static str) -> Self {
        match self {
            Cell::Missing(_) => Cell::Missing(Some(reason)),
            cell => cell,
        }
    }

    /// Whether a column of such cells stands to the right.
    pub fn is_numeric(&self) -> bool {
        match self {
            Cell::Missing(_) | Cell::Integer(_) | Cell::Number { .. } => true,
            Cell::Empty | Cell::Text(_) => false,
        }
    }

    /// Writes a cell for machines: numbers with all their digits, none as nothing.
    pub fn exact(&self) -> String {
        match self {
            Cell::Empty | Cell::Missing(_) => String::new(),
            Cell::Text(text) => text.clone(),
            Cell::Integer(n) => n.to_string(),
            Cell::Number { value, .. } => format!("{value:?}"),
        }
    }
}

/// Writes a cell for people; a number that is missing as `-`.
impl Display for Cell {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Cell::Empty => Ok(()),
            Cell::Missing(_) => out.write_str("-"),
            Cell::Integer(n) => write!(out, "{n}"),
            Cell::Text(text) | Cell::Number { shown: text, .. } => out.write_str(text),
        }
    }
}

/// Shows a number as [`long`] writes it.
impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Cell::number(value, long)
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        if text.is_empty() { Cell::Empty } else { Cell::Text(text) }
    }
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        text.to_string().into()
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Cell::Missing(None), T::into)
    }
}

macro_rules! integers {
    ($($of:ty: $number:expr),+) => {
        $(impl From<$of> for Cell {
            fn from(number: $of) -> Self {
                Cell::Integer(($number)(number) as i128)
            }
        })+
    };
}

integers!(
    u8: |n| n,
    u32: |n| n,
    u64: |n| n,
    usize: |n| n,
    NodeId: NodeId::number,
    TriangleId: TriangleId::number
);
