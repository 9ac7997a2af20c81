//! A report as HTML: what a page contains, readable without a script.

use std::ops::RangeInclusive;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

/// The name of a place on a page: `p1` of `P1: nothing penetrates`.
pub use super::csv::file_name as anchor;
use super::model::{Block, Cell, Report, Table};
use base::xml::escape;

/// The levels of the headings that unfold what stands under them.
const UNFOLDING: RangeInclusive<usize> = 2..=3;

impl Report {
    /// Writes the report as the content of a page: sections and their parts unfold, notes are lists, a table
    /// has a caption and the scope of its headings, a figure is an image that nothing of the page reaches.
    pub fn html(&self) -> String {
        let (mut html, mut previous) = (String::new(), 0);
        // The levels of the headings that are unfolded where the text has got to.
        let mut unfolded: Vec<usize> = Vec::new();
        for block in &self.blocks {
            let (depth, content) = match block {
                Block::Heading { level, text } => {
                    html += &items(std::mem::take(&mut previous), 0);
                    while unfolded.pop_if(|open| *open >= *level).is_some() {
                        html += "</details>\n";
                    }
                    let mut heading = format!("<h{level}>{}</h{level}>", prose(text));
                    if UNFOLDING.contains(level) {
                        unfolded.push(*level);
                        let id = anchor(text);
                        heading = format!("<details id=\"{id}\"><summary>{heading}</summary>");
                    }
                    (0, heading)
                }
                Block::Line { level: 0, text } => (0, format!("<p>{}</p>", prose(text))),
                Block::Line { level, text } => (*level, prose(text)),
                Block::Code(lines) => (0, format!("<pre>{}</pre>", escape(lines.trim_end()))),
                Block::Table { title, table } => (0, table.html(title)),
                Block::Figure { title, svg } => (0, figure(title, svg)),
            };
            html += &(items(previous, depth) + &content + "\n");
            previous = depth;
        }
        html + &items(previous, 0) + &"</details>\n".repeat(unfolded.len())
    }

    /// Returns the sections, each with its place on the page.
    pub fn sections(&self) -> impl Iterator<Item = (String, &str)> {
        self.blocks.iter().filter_map(|block| {
            let Block::Heading { level: 2, text } = block else { return None };
            Some((anchor(text), text.as_str()))
        })
    }
}

/// Ends and begins items of lists between two blocks, which stand so many lists deep.
fn items(previous: usize, depth: usize) -> String {
    match depth {
        _ if previous < depth => "<ul><li>".repeat(depth - previous),
        0 => "</li></ul>\n".repeat(previous),
        _ => "</li></ul>\n".repeat(previous - depth) + "</li>\n<li>",
    }
}

/// Writes a text, in which what stands between two backquotes is code.
pub fn prose(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return escape(text);
    }
    let part = |(k, part): (usize, &&str)| match k % 2 {
        0 => escape(part),
        _ => format!("<code>{}</code>", escape(part)),
    };
    parts.iter().enumerate().map(part).collect()
}

/// Returns a picture under its title.
pub fn figure(title: &str, svg: &str) -> String {
    format!(
        "<figure><img src=\"data:image/svg+xml;base64,{}\" alt=\"{}\">\n<figcaption>{}</figcaption></figure>",
        BASE64_STANDARD.encode(svg),
        escape(title),
        prose(title)
    )
}

impl Table {
    /// Writes the table under its title, and why numbers are missing. A cell that does not show all
    /// digits of its number has them in `data-exact`.
    fn html(&self, title: &str) -> String {
        let heading = |(j, heading): (usize, &String)| {
            let class = if self.is_numeric(j) { " class=\"number\"" } else { "" };
            format!("<th scope=\"col\"{class}>{}</th>", prose(heading))
        };
        let headings: String = self.headings.iter().enumerate().map(heading).collect();
        let cell = |cell: &Cell| {
            let (shown, exact) = (cell.to_string(), cell.exact());
            let class = if cell.is_numeric() { " class=\"number\"" } else { "" };
            let is_cut = matches!(cell, Cell::Number { .. }) && exact != shown;
            let digits = if is_cut { format!(" data-exact=\"{exact}\"") } else { String::new() };
            format!("<td{class}{digits}>{}</td>", prose(&shown))
        };
        let row =
            |row: &Vec<Cell>| format!("<tr>{}</tr>\n", row.iter().map(cell).collect::<String>());
        let rows: String = self.cells.iter().map(row).collect();
        let reasons = self.reasons().into_iter().map(|why| format!("\n<p>-: {}</p>", escape(why)));
        format!(
            "<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table><caption>{}</caption>\n\
             <thead><tr>{headings}</tr></thead>\n<tbody>\n{rows}</tbody></table></div>{}",
            escape(title),
            prose(title),
            reasons.collect::<String>()
        )
    }
}
