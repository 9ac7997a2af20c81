//! Alternative readings of a listing, as edits of its text.
//!
//! `listings/readings/README.md` describes the format. An edit names every line by its printed
//! number: also a line that it moves, indents anew or repeats, so that messages about the edited
//! listing point at the print.

use thiserror::Error;

use super::failure::ParseError;
use super::listing::{Line, Listing};
use super::settings::Limits;

/// A reading: ranges of printed lines, and the lines that stand in their place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// Why the print can be read so: the lines that start with `#`, without it.
    pub reason: String,
    changes: Vec<Change>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Change {
    listing: String,
    first: usize,
    last: usize,
    /// Whether the lines stay and only stand one level deeper.
    deeper: bool,
    lines: Vec<Line>,
}

/// An edit that cannot be read, or does not fit its listing.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the message of each says what its values are")]
pub enum EditError {
    #[error("line {line} of the edit: found {found:?}, expected {expected}")]
    Format {
        /// The line of the edit, from 1.
        line: usize,
        found: String,
        expected: &'static str,
    },
    #[error("{listing} has no lines {first}-{last} of {wanted} in order")]
    NoSuchLines { listing: String, wanted: String, first: usize, last: usize },
    #[error(transparent)]
    Parse(#[from] ParseError),
}

impl Edit {
    /// Reads an edit from its text.
    ///
    /// # Errors
    /// The text is no edit: says in which line.
    pub fn parse(text: &str) -> Result<Self, EditError> {
        let mut edit = Edit { reason: String::new(), changes: vec![] };
        for (k, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
            edit.take(line, k + 1).map_err(|expected| EditError::Format {
                line: k + 1,
                found: line.into(),
                expected,
            })?;
        }
        Ok(edit)
    }

    fn take(&mut self, line: &str, in_file: usize) -> Result<(), &'static str> {
        if let Some(reason) = line.strip_prefix('#') {
            self.reason.push_str(reason.strip_prefix(' ').unwrap_or(reason));
            self.reason.push('\n');
        } else if line.ends_with(':') {
            self.changes.push(parse_range(line).ok_or("`c_cnt lines 14-30:` or `Km line 7:`")?);
        } else {
            let change = self.changes.last_mut().filter(|change| !change.deeper);
            let change = change.ok_or("`c_cnt lines 14-30:` above the first line")?;
            // The printed number, two spaces, and the line with its indentation.
            let numbered = line.trim_start().split_once("  ");
            let line = numbered
                .and_then(|(number, line)| Some(Line::new(number.parse().ok()?, in_file, line)));
            change.lines.push(line.ok_or("a printed number, two spaces, and the line")?);
        }
        Ok(())
    }

    /// Returns the lines that the edit replaces, such as `c_cnt 14-30`.
    #[must_use]
    pub fn places(&self) -> Vec<String> {
        let places = self.changes.iter().map(|change| match change {
            Change { listing, first, last, .. } if first == last => format!("{listing} {first}"),
            Change { listing, first, last, .. } => format!("{listing} {first}-{last}"),
        });
        places.collect()
    }

    /// Returns what the edit changes in the listing of that name.
    #[must_use]
    pub fn of(mut self, listing: &str) -> Self {
        self.changes.retain(|change| change.listing == listing);
        self
    }

    /// Returns the listing under this reading.
    ///
    /// # Errors
    /// Names a range that the listing does not have, or why the edited listing cannot be
    /// read.
    pub fn apply(&self, listing: &Listing) -> Result<Listing, EditError> {
        let lines = self.applied(listing.name(), listing.lines().to_vec())?;
        Ok(Listing::from_lines(listing.name(), lines, &Limits::default())?)
    }

    /// Returns the lines of the listing of that name under this reading.
    ///
    /// # Errors
    /// Names a range that the listing does not have.
    pub fn applied(&self, name: &str, mut lines: Vec<Line>) -> Result<Vec<Line>, EditError> {
        for Change { listing: wanted, first, last, deeper, lines: own } in &self.changes {
            // Where the lines to be replaced stand, if they are there, all and in order.
            let start = lines.iter().position(|line| line.printed == *first);
            let range = start
                .zip(last.checked_sub(*first))
                .and_then(|(start, more)| Some(start..start.checked_add(more)?.checked_add(1)?));
            let ordered = |found: &[Line]| found.iter().zip(*first..).all(|(l, n)| l.printed == n);
            let range = range
                .filter(|range| wanted == name && lines.get(range.clone()).is_some_and(ordered));
            let Some(range) = range else {
                let (listing, wanted) = (name.into(), wanted.clone());
                let (first, last) = (*first, *last);
                return Err(EditError::NoSuchLines { listing, wanted, first, last });
            };
            if *deeper {
                lines[range].iter_mut().for_each(|line| line.level += 1);
            } else {
                lines.splice(range, own.iter().cloned());
            }
        }
        Ok(lines)
    }
}

/// Reads `c_cnt lines 14-30:`, `Km line 7:` or `c_cnt lines 14-30, one level deeper:`.
fn parse_range(text: &str) -> Option<Change> {
    let text = text.strip_suffix(':')?;
    let replaced = text.strip_suffix(", one level deeper");
    let (listing, range) = replaced.unwrap_or(text).split_once(" line")?;
    let range = range.strip_prefix('s').unwrap_or(range).strip_prefix(' ')?;
    let (first, last) = range.split_once('-').unwrap_or((range, range));
    Some(Change {
        listing: listing.into(),
        first: first.parse().ok()?,
        last: last.parse().ok()?,
        deeper: replaced.is_some(),
        lines: vec![],
    })
}
