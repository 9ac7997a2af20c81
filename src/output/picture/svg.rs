//! The shapes of SVG that the pictures use, as XML elements. Lengths are in pixels, y downwards.

use base::xml::Element;

/// The fonts to look for, in this order.
const FONTS: &str = "Arial, Helvetica, Liberation Sans, DejaVu Sans, sans-serif";

/// The size of all text but the title, pixels.
pub const TEXT_SIZE: f64 = 14.0;

/// The size of the title, pixels.
pub const TITLE_SIZE: f64 = 20.0;

/// The colour of text, axes and frames.
pub const DARK: &str = "#222222";

/// A point of the picture: x to the right, y downwards, pixels.
pub type Pixel = [f64; 2];

/// Which point of a text stands at its coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Where it starts.
    Start,
    /// Its middle.
    Middle,
    /// Where it ends.
    End,
}

/// Writes the picture as a file: a white page with a title for screen readers, then `content`.
pub fn document([width, height]: [f64; 2], title: &str, content: Element) -> String {
    Element::new("svg")
        .set("xmlns", "http://www.w3.org/2000/svg")
        .set("width", number(width))
        .set("height", number(height))
        .set("viewBox", format!("0 0 {} {}", number(width), number(height)))
        .set("role", "img")
        .set("font-family", FONTS)
        .with(Element::with_text("title", title))
        .with(rect([0.0, 0.0], [width, height]).fill("#ffffff"))
        .with(content)
        .document()
}

/// Makes an empty group.
pub fn group() -> Element {
    Element::new("g")
}

/// Makes a rectangle from its upper left corner.
pub fn rect([x, y]: Pixel, [width, height]: [f64; 2]) -> Element {
    shape("rect", [("x", x), ("y", y), ("width", width), ("height", height)])
}

/// Makes a straight line between two points.
pub fn line([x1, y1]: Pixel, [x2, y2]: Pixel) -> Element {
    shape("line", [("x1", x1), ("y1", y1), ("x2", x2), ("y2", y2)])
}

/// Makes a circle around its centre.
pub fn circle([x, y]: Pixel, radius: f64) -> Element {
    shape("circle", [("cx", x), ("cy", y), ("r", radius)])
}

/// Makes an image from its upper left corner; `source` is where it is found.
pub fn image([x, y]: Pixel, [width, height]: [f64; 2], source: &str) -> Element {
    shape("image", [("x", x), ("y", y), ("width", width), ("height", height)])
        .set("preserveAspectRatio", "none")
        .set("href", source)
}

fn shape<const N: usize>(name: &'static str, lengths: [(&str, f64); N]) -> Element {
    let set = |shape: Element, (name, length)| shape.set(name, number(length));
    lengths.into_iter().fold(Element::new(name), set)
}

/// Makes a polygon from its corners.
pub fn polygon(corners: &[Pixel]) -> Element {
    Element::new("polygon").set("points", places(corners))
}

/// Makes one element of many lines, each a run of points.
pub fn path(lines: impl IntoIterator<Item = impl AsRef<[Pixel]>>) -> Element {
    let runs = lines.into_iter().map(|line| format!("M{}", places(line.as_ref())));
    Element::new("path").set("d", runs.collect::<String>()).set("fill", "none")
}

/// Makes one element of many polygons.
pub fn polygons<const N: usize>(rings: impl IntoIterator<Item = [Pixel; N]>) -> Element {
    let runs = rings.into_iter().map(|ring| format!("M{}Z", places(&ring)));
    Element::new("path").set("d", runs.collect::<String>())
}

/// Makes straight lines with round ends, each between two of `points`.
pub fn segments(ends: &[[usize; 2]], points: &[Pixel]) -> Element {
    path(ends.iter().map(|ends| ends.map(|end| points[end]))).set("stroke-linecap", "round")
}

/// Makes a line of text; `at` is on its base line.
pub fn text(at: Pixel, anchor: Anchor, words: &str) -> Element {
    let element = text_of_size(TEXT_SIZE, at, words);
    match anchor {
        Anchor::Start => element,
        Anchor::Middle => element.set("text-anchor", "middle"),
        Anchor::End => element.set("text-anchor", "end"),
    }
}

/// Makes a line of text from its left end.
pub fn text_of_size(size: f64, [x, y]: Pixel, words: &str) -> Element {
    let element = Element::with_text("text", words).set("x", number(x)).set("y", number(y));
    element.set("font-size", number(size))
}

/// The colours of a shape.
pub trait Coloured {
    /// Fills the shape with `colour`.
    #[must_use]
    fn fill(self, colour: &str) -> Self;

    /// Draws the outline of the shape in `colour`, `width` pixels wide.
    #[must_use]
    fn stroke(self, colour: &str, width: f64) -> Self;
}

impl Coloured for Element {
    fn fill(self, colour: &str) -> Self {
        self.set("fill", colour)
    }
    fn stroke(self, colour: &str, width: f64) -> Self {
        self.set("stroke", colour).set("stroke-width", number(width))
    }
}

/// Writes a length with at most two decimals, without trailing zeros and never as `-0`.
fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".into() } else { short.into() }
}

/// Writes points with a space between two.
fn places(points: &[Pixel]) -> String {
    let places = points.iter().map(|[x, y]| format!("{},{}", number(*x), number(*y)));
    places.collect::<Vec<_>>().join(" ")
}
