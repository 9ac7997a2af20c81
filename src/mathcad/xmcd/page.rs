//! A worksheet's page: regions one below the other, and the settings around them.
//!
//! Every element and attribute here occurs in a file that Mathcad saved: a test holds that.

use super::write;
use crate::listing::Listing;
use crate::settings::Settings;
use base::xml::Element;

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
        let rows = |line: &str| line.chars().count() / CHARACTERS + 1;
        let height = LINE * text.lines().map(rows).sum::<usize>() as f64;
        let paragraph = |line| Element::with_text("p", line).set("style", style);
        let words = Element::new("text")
            .set("use-page-width", "false")
            .set("lock-width", "true")
            .with_all(text.lines().map(paragraph));
        self.region(words, height, height.min(LINE), "")
    }

    /// Adds the definition of a listing's function.
    pub fn program(&mut self, listing: &Listing) -> &mut Self {
        // A fraction takes two lines.
        let rows = |line: &str| 1 + usize::from(line.contains('/'));
        let lines: usize = listing.lines().iter().map(|line| rows(&line.text)).sum();
        self.math(write::definition(listing), lines, "")
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

    /// Writes the worksheet.
    pub fn finish(self, title: &str, settings: &Settings) -> String {
        let user = Element::new("userData").with(Element::with_text("title", title));
        Element::new("worksheet")
            .set("version", "3.0.3")
            .set("xmlns", "http://schemas.mathsoft.com/worksheet30")
            .set("xmlns:ws", "http://schemas.mathsoft.com/worksheet30")
            .set("xmlns:ml", "http://schemas.mathsoft.com/math30")
            .with(
                Element::new("metadata")
                    .with(Element::with_text("generator", "plane-contact"))
                    .with(user),
            )
            .with(around(settings))
            .with(Element::new("regions").with_all(self.regions))
            .document()
    }
}

/// Writes listings as a worksheet, with `ORIGIN` 1.
pub fn listings(listings: &[Listing]) -> String {
    let mut page = Page::default();
    for listing in listings {
        page.program(listing);
    }
    let names: Vec<_> = listings.iter().map(Listing::function).collect();
    page.finish(&names.join(", "), &Settings::default())
}

/// Writes the settings of a blank worksheet, but for those that concern calculation.
fn around(settings: &Settings) -> Element {
    let calculation = Element::new("calculation")
        .with(
            Element::new("builtInVariables")
                .set("array-origin", settings.origin.to_string())
                .set("convergence-tolerance", "0.001")
                .set("constraint-tolerance", "0.001"),
        )
        .with(
            Element::new("calculationBehavior")
                .set("automatic-recalculation", "true")
                .set("exact-boolean", settings.exact_boolean.to_string())
                .set("zero-over-zero", if settings.zero_over_zero_is_zero { "0" } else { "error" }),
        )
        .with(Element::new("units").with(Element::new("currentUnitSystem").set("name", "si")));
    let editor = Element::new("editor")
        .with(Element::new("ruler").set("ruler-unit", "in"))
        .with(Element::new("grid").set("granularity-x", "6").set("granularity-y", "6"));
    let file = Element::new("fileFormat")
        .set("image-type", "none")
        .set("save-numeric-results", "true")
        .set("exclude-large-results", "false")
        .set("screen-dpi", "96");
    Element::new("settings")
        .with(presentation())
        .with(calculation)
        .with(editor)
        .with(file)
        .with(Element::new("miscellaneous").with(Element::new("handbook")))
}

fn presentation() -> Element {
    let style = |(name, size, weight): (&str, &str, &str)| {
        let block = Element::new("blockAttr")
            .set("margin-left", "0")
            .set("margin-right", "0")
            .set("text-align", "left");
        let inline = font(Element::new("inlineAttr"), "Arial", size, weight);
        Element::new("textStyle").set("name", name).with(block).with(inline)
    };
    let styles = [("Normal", "10", "normal"), ("Heading 1", "14", "bold")].map(style);
    let users = (1..=7).map(|k| format!("User {k}"));
    let names = ["Variables", "Constants"].map(String::from).into_iter().chain(users);
    let names = names.chain(["Math Text Font".into()]);
    let math = |name: String| {
        font(Element::new("mathStyle").set("name", name), "Times New Roman", "10", "normal")
    };
    let operators = [
        ("multiplication", "narrow-dot"),
        ("derivative", "derivative"),
        ("literal-subscript", "large"),
        ("definition", "colon-equal"),
        ("global-definition", "triple-equal"),
        ("local-definition", "left-arrow"),
        ("equality", "bold-equal"),
        ("symbolic-evaluation", "right-arrow"),
    ];
    let operators = operators.iter().fold(Element::new("operators"), |e, (k, v)| e.set(k, *v));
    // Seventeen digits, so that a shown number reads back.
    let results = Element::new("results")
        .with(Element::new("general").set("precision", "17"))
        .with(Element::new("matrix").set("display-style", "matrix"));
    let rendering = Element::new("mathRendering")
        .set("equation-color", "#000")
        .with(operators)
        .with(Element::new("mathStyles").with_all(names.map(math)))
        .with(Element::new("dimensionNames"))
        .with(Element::new("symbolics"))
        .with(results);
    let margins = ["left", "right", "top", "bottom"];
    let margins = margins.iter().fold(Element::new("margins"), |e, side| e.set(side, "36"));
    let page = Element::new("pageModel").set("paper-code", "9").set("orientation", "portrait");
    let colours = Element::new("colorModel")
        .set("background-color", "#fff")
        .set("default-highlight-color", "#ffff80");
    Element::new("presentation")
        .with(Element::new("textRendering").with(Element::new("textStyles").with_all(styles)))
        .with(rendering)
        .with(page.with(margins))
        .with(colours)
        .with(Element::new("language").set("math", "ru").set("UI", "ru"))
}

fn font(element: Element, family: &str, size: &str, weight: &str) -> Element {
    element
        .set("font-family", family)
        .set("font-charset", "0")
        .set("font-size", size)
        .set("font-weight", weight)
        .set("font-style", "normal")
}
