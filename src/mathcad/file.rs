//! A file of listings: one after another, each from its first line to the next line that is not
//! indented.

use super::failure::ParseError;
use super::listing::{Line, Listing};
use super::settings::Limits;

/// Reads all listings of a file, in order; messages call the file `name`.
///
/// # Errors
/// The first place at which the text leaves the notation, or that it holds no listing.
pub fn listings(name: &str, text: &str, limits: &Limits) -> Result<Vec<Listing>, ParseError> {
    let text = text.trim_start_matches('\u{feff}');
    let mut starts = Vec::new();
    for (k, line) in text.lines().enumerate() {
        if !line.starts_with([' ', '#']) && !line.trim().is_empty() {
            starts.push(k);
        }
    }
    // What stands above the first listing goes with it, so that it is refused where it stands.
    let first = starts.iter_mut().take(1);
    first.for_each(|start| *start = 0);
    if starts.is_empty() {
        starts.push(0);
    }
    let lines: Vec<&str> = text.lines().collect();
    let ends = starts.iter().skip(1).copied().chain([lines.len()]);
    let part = |(&start, end): (&usize, usize)| {
        Listing::from_lines(name, Line::all(&lines[start..end], start), limits)
    };
    starts.iter().zip(ends).map(part).collect()
}
