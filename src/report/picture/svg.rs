//! The shapes of SVG that the pictures use, as XML elements. Lengths in pixels, y downwards.

use crate::report::xml::Element;

/// The fonts to look for, in this order.
const FONTS: &str = "Arial, Helvetica, Liberation Sans, DejaVu Sans, sans-serif";

/// A point of the picture.
pub type Pixel = [f64; 2];

/// Where a text stands with respect to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    /// Its right end stands there.
    End,
}

/// The picture as a file: a white page with a title for screen readers, then `content`.
pub fn document(width: f64, height: f64, title: &str, content: Element) -> String {
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

/// A group.
pub fn group() -> Element {
    Element::new("g")
}

/// A rectangle from its upper left corner.
pub fn rect(corner: Pixel, size: [f64; 2]) -> Element {
    place(Element::new("rect"), corner).set("width", number(size[0])).set("height", number(size[1]))
}

/// A straight line.
pub fn line(from: Pixel, to: Pixel) -> Element {
    Element::new("line")
        .set("x1", number(from[0]))
        .set("y1", number(from[1]))
        .set("x2", number(to[0]))
        .set("y2", number(to[1]))
}

/// A circle.
pub fn circle(centre: Pixel, radius: f64) -> Element {
    Element::new("circle")
        .set("cx", number(centre[0]))
        .set("cy", number(centre[1]))
        .set("r", number(radius))
}

/// A closed polygon.
pub fn polygon(corners: &[Pixel]) -> Element {
    let corners: Vec<_> = corners.iter().map(pair).collect();
    Element::new("polygon").set("points", corners.join(" "))
}

/// Many lines in one element: each of `lines` is one run of points.
pub fn path<'a>(lines: impl IntoIterator<Item = &'a [Pixel]>) -> Element {
    let run = |line: &[Pixel]| format!("M{}", line.iter().map(pair).collect::<Vec<_>>().join(" "));
    let runs: Vec<_> = lines.into_iter().map(run).collect();
    Element::new("path").set("d", runs.join("")).set("fill", "none")
}

/// Straight lines with round ends, each between two of `points`.
pub fn segments(ends: &[[usize; 2]], points: &[Pixel]) -> Element {
    let lines: Vec<_> = ends.iter().map(|ends| ends.map(|end| points[end])).collect();
    path(lines.iter().map(<[Pixel; 2]>::as_slice)).set("stroke-linecap", "round")
}

/// A line of text; `at` is on its base line.
pub fn text(at: Pixel, size: f64, anchor: Anchor, words: &str) -> Element {
    let element = place(Element::with_text("text", words), at).set("font-size", number(size));
    match anchor {
        Anchor::Start => element,
        Anchor::Middle => element.set("text-anchor", "middle"),
        Anchor::End => element.set("text-anchor", "end"),
    }
}

/// A clip path under the name `id`: what refers to it shows inside the rectangle only.
pub fn clip(id: &str, corner: Pixel, size: [f64; 2]) -> Element {
    Element::new("clipPath").set("id", id).with(rect(corner, size))
}

/// How shapes are painted.
pub trait Paint {
    /// Fills with `colour`.
    #[must_use]
    fn fill(self, colour: &str) -> Self;

    /// Draws the outline in `colour`, `width` pixels wide.
    #[must_use]
    fn stroke(self, colour: &str, width: f64) -> Self;
}

impl Paint for Element {
    fn fill(self, colour: &str) -> Self {
        self.set("fill", colour)
    }
    fn stroke(self, colour: &str, width: f64) -> Self {
        self.set("stroke", colour).set("stroke-width", number(width))
    }
}

/// A length in pixels with at most two decimals, without trailing zeros and never `-0`.
pub fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => String::from("0"),
        trimmed => String::from(trimmed),
    }
}

fn pair(point: &Pixel) -> String {
    format!("{},{}", number(point[0]), number(point[1]))
}

fn place(element: Element, at: Pixel) -> Element {
    element.set("x", number(at[0])).set("y", number(at[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let written = [0.0, -0.001, 1.0, 100.0, -2.5, 0.126].map(number);
        assert_eq!(written, ["0", "0", "1", "100", "-2.5", "0.13"]);
    }

    #[test]
    fn path_keeps_its_lines_apart() {
        let lines = [[[0.0, 0.0], [1.0, 2.0]], [[3.0, 4.0], [5.0, 6.0]]];
        let written = path(lines.iter().map(<[Pixel; 2]>::as_slice)).document();
        assert!(written.contains("d=\"M0,0 1,2M3,4 5,6\""), "{written}");
    }

    #[test]
    fn document_is_well_formed() {
        let written = document(
            10.0,
            20.0,
            "a < b",
            group().with(text([1.0, 2.0], 14.0, Anchor::Middle, "x & y")),
        );
        let read = roxmltree::Document::parse(&written).unwrap();
        assert_eq!(read.root_element().attribute("viewBox"), Some("0 0 10 20"));
    }
}
