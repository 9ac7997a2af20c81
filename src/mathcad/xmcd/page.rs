//! A worksheet's page: regions one below the other, and the settings around them.
//!
//! Every element and attribute here occurs in a file that Mathcad saved: a test holds that.

use super::write;
use crate::listing::Listing;
use crate::settings::Settings;
use base::xml::{Element, escape};

/// A blank worksheet, with places for what concerns its calculation. Seventeen digits, so that a
/// shown number reads back.
const BLANK: &str = include_str!("worksheet.xml");
/// The height of a line, in points.
const LINE: f64 = 19.5;
/// The space between two regions.
const GAP: f64 = 12.0;
/// The width of a region.
const WIDTH: f64 = 480.0;
/// The characters of a line of text of that width.
const CHARACTERS: usize = 80;

/// A worksheet that grows downwards.
pub struct Page {
    regions: Vec<Element>,
    top: f64,
}

impl Default for Page {
    fn default() -> Self {
        Page { regions: vec![], top: GAP }
    }
}

impl Page {
    /// Adds a heading.
    pub fn heading(&mut self, text: &str) -> &mut Self {
        self.paragraphs("Heading 1", text)
    }

    /// Adds text, a paragraph for each line.
    pub fn text(&mut self, text: &str) -> &mut Self {
        self.paragraphs("Normal", text)
    }

    fn paragraphs(&mut self, style: &str, text: &str) -> &mut Self {
        let rows: usize = text.lines().map(|line| line.chars().count() / CHARACTERS + 1).sum();
        let height = LINE * rows as f64;
        let words = Element::new("text")
            .set("use-page-width", "false")
            .set("lock-width", "true")
            .with_all(text.lines().map(|line| Element::with_text("p", line).set("style", style)));
        self.region(words, height, height.min(LINE), "")
    }

    /// Adds the definition of a listing's function.
    pub fn program(&mut self, listing: &Listing) -> &mut Self {
        // A fraction takes two lines.
        let fractions = listing.lines().iter().filter(|line| line.text.contains('/')).count();
        self.math(write::definition(listing), listing.lines().len() + fractions, "")
    }

    /// Adds `name := value`, `rows` lines high.
    pub fn define(&mut self, name: &str, value: Element, rows: usize) -> &mut Self {
        self.math(Element::new("ml:define").with(write::id(name)).with(value), rows, "")
    }

    /// Adds `expression =`, with room for a result of so many rows.
    pub fn evaluate(&mut self, expression: Element, rows: usize, tag: &str) -> &mut Self {
        self.math(Element::new("ml:eval").with(expression), rows, tag)
    }

    fn math(&mut self, inside: Element, rows: usize, tag: &str) -> &mut Self {
        let height = LINE * (rows + 1) as f64;
        let math = Element::new("math").set("disable-calc", "false").with(inside);
        self.region(math, height, height / 2.0, tag)
    }

    fn region(&mut self, content: Element, height: f64, axis: f64, tag: &str) -> &mut Self {
        let region = Element::new("region")
            .set("region-id", (self.regions.len() + 1).to_string())
            .set("left", "0")
            .set("top", self.top.to_string())
            .set("width", WIDTH.to_string())
            .set("height", height.to_string())
            .set("align-x", "0")
            .set("align-y", (self.top + axis).to_string())
            .set("show-border", "false")
            .set("is-protected", "false")
            .set("tag", tag)
            .with(content);
        self.regions.push(region);
        self.top += height + GAP;
        self
    }

    /// Returns the file of the worksheet.
    pub fn finish(self, title: &str, settings: &Settings) -> String {
        let regions = Element::new("regions").with_all(self.regions).text();
        let zero_over_zero = if settings.zero_over_zero_is_zero { "0" } else { "error" };
        BLANK
            .replace("{title}", &escape(title))
            .replace("{origin}", &settings.origin.to_string())
            .replace("{exact-boolean}", &settings.exact_boolean.to_string())
            .replace("{zero-over-zero}", zero_over_zero)
            .replace("{regions}", &regions)
    }
}
