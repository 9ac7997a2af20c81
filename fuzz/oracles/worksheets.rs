//! A worksheet of Mathcad: it is refused, or executed within its limits to values that are all
//! numbers; and its programs become text and a worksheet again.

use plane_contact::mathcad::Listing;
use plane_contact::mathcad::worksheet::execute;
use plane_contact::mathcad::xmcd::document::{Content, Region, read};
use plane_contact::output::worksheet;

use super::{listing, sound};

pub fn hold(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let sheet = match read(text, "fuzz") {
        Ok(sheet) => sheet,
        Err(error) => return sound::input_error(&error),
    };
    sheet.regions.iter().filter_map(program).for_each(|program| listing::reads_back(&program));
    let checked = execute(&sheet, &listing::limits());
    checked.iter().filter_map(|region| region.value.as_ref()).for_each(listing::is_finite);
    sound::document(&worksheet::json("fuzz", &checked));
    assert!(!worksheet::report(&checked).text(80).is_empty());
}

/// Returns the program of a region, which has one if it can be read in the text notation.
fn program(region: &Region) -> Option<Listing> {
    let text = match &region.content {
        Content::Function { text, .. } => text.clone(),
        Content::Definition { name, entry: None, lines, .. } => {
            format!("{name}() :=\n  {}\n", lines.join("\n  "))
        }
        _ => return None,
    };
    Listing::parse_within("fuzz", &text, &listing::limits()).ok()
}
