//! What a command prints for people: without what commands a terminal, fitted to a width; and its
//! tables as CSV.
//!
//! A table is what `layout` lays out: a heading, a rule of hyphens that shows where
//! the columns stand, and the rows under it. All other lines are prose.

use super::layout::filled;

/// A part of a printed text.
enum Part<'t> {
    Prose(&'t str),
    Table(Printed<'t>),
}

/// A table, cell by cell, and its lines.
struct Printed<'t> {
    head: Vec<String>,
    rows: Vec<Vec<String>>,
    lines: Vec<&'t str>,
}

/// Returns the text as it is shown: what commands a terminal becomes U+FFFD, and no line is longer
/// than `width` characters: a table that is wider becomes a record a row, prose is broken between
/// words, and a word that is longer than a line is broken too.
pub fn fitted(text: &str, width: usize) -> String {
    let text = text.replace(commands_a_terminal, "\u{fffd}");
    let part = |part| match part {
        Part::Prose(line) => prose(line, width),
        Part::Table(table) if table.lines.iter().all(|line| length(line) <= width) => {
            table.lines.iter().map(|line| format!("{line}\n")).collect()
        }
        Part::Table(table) => table.records(width),
    };
    let text: String = parts(&text).into_iter().map(part).collect();
    text.lines().map(|line| broken(line, width)).collect()
}

/// Breaks a line within its words where it is longer than `width`, after a slash where there is one.
fn broken(line: &str, width: usize) -> String {
    let (mut text, mut rest) = (String::new(), line.to_string());
    let indent = line.len() - line.trim_start_matches(' ').len();
    while length(&rest) > width {
        let fits: String = rest.chars().take(width).collect();
        let slash = fits.rfind('/').map(|at| at + 1).filter(|at| *at > indent + 1);
        let (start, end) = rest.split_at(slash.unwrap_or(fits.len()));
        text += &format!("{}\n", start.trim_end());
        rest = " ".repeat(indent) + end.trim_start();
    }
    text + &rest + "\n"
}

/// Whether a character is a control character that is not of a line's layout, or changes the
/// direction of the text behind it.
fn commands_a_terminal(c: char) -> bool {
    let turns = matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    turns || c.is_control() && !['\n', '\t'].contains(&c)
}

/// Returns the tables of a text as CSV (RFC 4180), each with a name made of the line above it.
pub fn tables(text: &str) -> Vec<(String, String)> {
    let (mut tables, mut title) = (Vec::<(String, String)>::new(), String::new());
    for part in parts(text) {
        match part {
            Part::Prose(line) if line.trim().is_empty() => {}
            Part::Prose(line) => title = name(line),
            Part::Table(table) => {
                let mut name = if title.is_empty() { "table".into() } else { title.clone() };
                if tables.iter().any(|(other, _)| *other == name) {
                    name += &format!("-{}", tables.len() + 1);
                }
                tables.push((name, table.csv()));
            }
        }
    }
    tables
}

/// Makes a file's name of the first words of a title.
fn name(title: &str) -> String {
    let end = title.find([':', '(', ',']).unwrap_or(title.len());
    let words = title[..end].split(|c: char| !c.is_ascii_alphanumeric());
    words.filter(|word| !word.is_empty()).map(str::to_lowercase).collect::<Vec<_>>().join("-")
}

fn parts(text: &str) -> Vec<Part<'_>> {
    let lines: Vec<&str> = text.lines().collect();
    let (mut parts, mut at) = (Vec::new(), 0);
    while at < lines.len() {
        match lines.get(at + 1).and_then(|rule| columns(rule)) {
            Some(columns) => {
                let rows = lines[at + 2..].iter().take_while(|line| is_row(line, &columns)).count();
                let lines = lines[at..at + 2 + rows].to_vec();
                let row = |line: &&str| cells(line, &columns);
                let rows = lines[2..].iter().map(row).collect();
                at += lines.len();
                parts.push(Part::Table(Printed { head: row(&lines[0]), rows, lines }));
            }
            None => {
                parts.push(Part::Prose(lines[at]));
                at += 1;
            }
        }
    }
    parts
}

/// Returns where the columns of a table begin, if a line is the rule under its heading.
fn columns(rule: &str) -> Option<Vec<usize>> {
    let rule = rule.strip_prefix("  ")?;
    let is_rule = rule.starts_with('-')
        && rule.split("  ").all(|part| !part.is_empty() && part.bytes().all(|b| b == b'-'));
    let starts = rule.split("  ").scan(2, |at, part| {
        let start = *at;
        *at += part.len() + 2;
        Some(start)
    });
    is_rule.then(|| starts.collect())
}

/// Whether a line keeps the blanks in front of every column.
fn is_row(line: &str, columns: &[usize]) -> bool {
    let line: Vec<char> = line.chars().collect();
    let blank = |at: usize| line.get(at).is_none_or(|c| *c == ' ');
    line.len() > 2 && columns.iter().all(|start| blank(start - 2) && blank(start - 1))
}

fn cells(line: &str, columns: &[usize]) -> Vec<String> {
    let line: Vec<char> = line.chars().collect();
    let ends = columns.iter().skip(1).copied().chain([usize::MAX]);
    let cell = |(start, end): (&usize, usize)| {
        let end = end.min(line.len());
        line[(*start).min(end)..end].iter().collect::<String>().trim().to_string()
    };
    columns.iter().zip(ends).map(cell).collect()
}

fn length(line: &str) -> usize {
    line.chars().count()
}

fn prose(line: &str, width: usize) -> String {
    if length(line) <= width {
        return format!("{line}\n");
    }
    let words = line.trim_start();
    let blanks = line.len() - words.len();
    filled(&" ".repeat(blanks), blanks + 2, width, words.split(' '), " ")
}

impl Printed<'_> {
    /// Writes a record a row: its first cell, then each other cell beside its heading, or behind it
    /// where that would be too wide.
    fn records(&self, width: usize) -> String {
        let headings = self.head.iter().skip(1).map(|heading| length(heading)).max().unwrap_or(0);
        let beside = self.records_by(width, |heading, cell| {
            let start = format!("    {heading:<headings$}  ");
            filled(&start, headings + 6, width, cell.split(' '), " ")
        });
        if beside.lines().all(|line| length(line) <= width) {
            return beside;
        }
        self.records_by(width, |heading, cell| {
            let words = format!("{heading}: {cell}");
            prose(&format!("    {}", words.trim_start_matches(": ")), width)
        })
    }

    /// Writes a record a row: its first cell, then what `line` makes of a heading and another cell.
    fn records_by(&self, width: usize, line: impl Fn(&str, &str) -> String) -> String {
        let record = |row: &Vec<String>| {
            let first = format!("{} {}", self.head[0], row[0]);
            let first = filled("  ", 4, width, first.trim().split(' '), " ");
            let cells = self.head.iter().zip(row).skip(1).filter(|(_, cell)| !cell.is_empty());
            first + &cells.map(|(heading, cell)| line(heading, cell)).collect::<String>()
        };
        self.rows.iter().map(record).collect()
    }

    fn csv(&self) -> String {
        let quoted = |cell: &String| match cell.contains(['"', ',', '\n']) {
            true => format!("\"{}\"", cell.replace('"', "\"\"")),
            false => cell.clone(),
        };
        let line =
            |cells: &Vec<String>| cells.iter().map(quoted).collect::<Vec<_>>().join(",") + "\r\n";
        std::iter::once(&self.head).chain(&self.rows).map(line).collect()
    }
}
