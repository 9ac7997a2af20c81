//! A picture's layout: what stands under what. Each part is put below the one before.

use super::colour::{ColourScale, unit_in_words};
use super::numbers::Round;
use super::svg::{Anchor, Paint, Pixel, circle, clip, document, group, line, rect, text};
use super::view::{Bounds, Frame, View};
use crate::report::xml::Element;

/// The size of all text but the title.
pub const TEXT_SIZE: f64 = 14.0;

const TITLE_SIZE: f64 = 20.0;
const WIDTH: f64 = 1100.0;
pub(super) const MARGIN: f64 = 40.0;
pub(super) const INNER: f64 = WIDTH - 2.0 * MARGIN;
const GAP: f64 = 24.0;
const PANEL_HEIGHT: [f64; 2] = [300.0, 600.0];
const BAR_WIDTH: f64 = 640.0;
/// A scale bar is up to a quarter as long as its panel is wide, and as one this wide at least.
const SCALE_BAR: f64 = 240.0;
pub(super) const DARK: &str = "#222222";

/// A sign of the legend.
pub enum Sign {
    /// A body of this colour.
    Body(&'static str),
    /// A node of this colour.
    Node(&'static str),
    /// An edge of this colour.
    Edge(&'static str),
    /// A ring of this colour.
    Ring(&'static str),
}

/// What the panels show.
pub struct Panels<'a> {
    /// The box of all that is drawn.
    pub whole: Bounds,
    /// The box to enlarge, and its name.
    pub part: Option<(Bounds, &'a str)>,
    /// What the scale bars count in.
    pub length_unit: &'a str,
}

/// A picture in the making.
pub struct Page {
    title: String,
    content: Element,
    /// Where the next part begins, pixels from the top.
    pub(super) y: f64,
}

impl Page {
    /// A page that has its title only.
    pub fn new(title: &str) -> Self {
        let mut page =
            Self { title: String::from(title), content: group().fill(DARK), y: MARGIN - 10.0 };
        for words in wrap(title, TITLE_SIZE, INNER) {
            page.y += TITLE_SIZE * 1.3;
            page.put(
                text([MARGIN, page.y - 6.0], TITLE_SIZE, Anchor::Start, &words)
                    .set("font-weight", "bold"),
            );
        }
        page.y += 10.0;
        page
    }

    /// Lines of text.
    pub fn paragraph(&mut self, words: &str) {
        for words in wrap(words, TEXT_SIZE, INNER) {
            self.y += TEXT_SIZE * 1.45;
            self.put(text([MARGIN, self.y - 5.0], TEXT_SIZE, Anchor::Start, &words));
        }
        self.y += 3.0;
    }

    /// The whole, and beside it the part; `draw` fills a panel.
    pub fn panels(&mut self, panels: &Panels, draw: impl Fn(&View) -> Element) {
        let views = self.views(panels);
        if let ([whole, enlarged], Some((_, name))) = (views.as_slice(), panels.part) {
            self.panel_headings(whole, enlarged, name);
        }
        for view in &views {
            self.panel(view, draw(view));
            self.put(scale_bar(view, panels.length_unit));
        }
        if let [whole, enlarged] = views.as_slice() {
            self.put(window(whole, enlarged));
        }
        self.y = views[0].frame.corner[1] + views[0].frame.size[1] + 44.0;
    }

    /// The colour bar under its heading.
    pub fn colour_bar(&mut self, scale: &ColourScale, quantity: &str, unit: &str) {
        self.paragraph(&scale.heading(quantity, unit));
        // Indented: half of a tick's label stands out at either end.
        self.y = self.y.round();
        self.put(scale.bar([MARGIN + 10.0, self.y + 2.0], BAR_WIDTH));
        self.y += ColourScale::HEIGHT + 6.0;
    }

    /// Signs with their words, in as many rows as needed.
    pub fn legend(&mut self, entries: &[(Sign, String)]) {
        let mut x = MARGIN;
        for (sign, words) in entries {
            let width = 34.0 + text_width(words, TEXT_SIZE);
            if x > MARGIN && x + width > WIDTH - MARGIN {
                x = MARGIN;
                self.y += 24.0;
            }
            self.put(draw_sign(sign, [x, self.y + 9.0]));
            self.put(text([x + 30.0, self.y + 14.0], TEXT_SIZE, Anchor::Start, words));
            x += width + GAP;
        }
        self.y += 30.0;
    }

    /// The picture as a file.
    pub fn finish(self) -> String {
        document(WIDTH, (self.y + MARGIN / 2.0).ceil(), &self.title, self.content)
    }

    pub(super) fn put(&mut self, element: Element) {
        self.content.push(element);
    }

    /// The views of the whole and, if there is a part, of that part grown to the shape of its panel.
    fn views(&self, panels: &Panels) -> Vec<View> {
        let [width, height] = panels.whole.size();
        let frame =
            |x: f64, y: f64, size: [f64; 2]| Frame { corner: [MARGIN + x, self.y + y], size };
        let Some((part, _)) = &panels.part else {
            let scale = (INNER / width).min(PANEL_HEIGHT[1] / height);
            let size = [width * scale, height * scale];
            return vec![View::whole(&panels.whole, frame((INNER - size[0]) / 2.0, 6.0, size))];
        };
        let panel = (INNER - GAP) / 2.0;
        let size = [panel, (panel * (height / width)).clamp(PANEL_HEIGHT[0], PANEL_HEIGHT[1])];
        let right = frame(panel + GAP, 30.0, size);
        vec![
            View::whole(&panels.whole, frame(0.0, 30.0, size)),
            View::enlarged(&part.with_ratio(size[0] / size[1]), right),
        ]
    }

    fn panel_headings(&mut self, whole: &View, enlarged: &View, name: &str) {
        let times = enlarged.scale / whole.scale;
        let right = format!("b: {name}, enlarged {times:.1} times (the frame in a)");
        for (view, words) in [(whole, "a: the whole"), (enlarged, right.as_str())] {
            self.put(text([view.frame.corner[0], self.y + 18.0], TEXT_SIZE, Anchor::Start, words));
        }
    }

    /// What is drawn, cut at the panel's edge; an enlargement has a frame.
    fn panel(&mut self, view: &View, drawn: Element) {
        let Frame { corner, size } = view.frame;
        if !view.enlarged {
            self.put(drawn);
            return;
        }
        // The title keeps names apart where several pictures stand in one web page.
        let id = format!("clip-{}", self.title.replace(|c: char| !c.is_alphanumeric(), "-"));
        self.put(clip(&id, corner, size));
        self.put(group().set("clip-path", format!("url(#{id})")).with(drawn));
        self.put(rect(corner, size).fill("none").stroke(DARK, 1.5));
    }
}

/// The frame in the whole that shows where the enlargement is.
fn window(whole: &View, enlarged: &View) -> Element {
    let ratio = whole.scale / enlarged.scale;
    let size = enlarged.frame.size.map(|side| side * ratio);
    let centre = whole.at(enlarged.centre);
    let corner = [0, 1].map(|axis| centre[axis] - size[axis] / 2.0);
    let line = |colour, width| rect(corner, size).fill("none").stroke(colour, width);
    // White under the line: it stands out from any colour.
    group().with(line("#ffffff", 3.5)).with(line(DARK, 1.5))
}

/// A bar of round length under the panel's lower left corner.
fn scale_bar(view: &View, unit: &str) -> Element {
    let Frame { corner, size } = view.frame;
    let length = Round::at_most(size[0].max(SCALE_BAR) / 4.0 / view.scale);
    let [x, y] = [corner[0], corner[1] + size[1] + 20.0];
    let end = x + length.value() * view.scale;
    let upright = |x: f64| line([x, y - 4.0], [x, y + 4.0]);
    let words = match unit {
        "" => format!("{length} ({})", unit_in_words(unit)),
        _ => format!("{length} {}", unit_in_words(unit)),
    };
    group()
        .with(
            group()
                .stroke(DARK, 1.5)
                .with(line([x, y], [end, y]))
                .with(upright(x))
                .with(upright(end)),
        )
        .with(text([end + 8.0, y + 5.0], TEXT_SIZE, Anchor::Start, words.trim()))
}

/// A sign of the legend, `at` the left end of its middle line.
fn draw_sign(sign: &Sign, at: Pixel) -> Element {
    match sign {
        Sign::Body(colour) => {
            rect([at[0], at[1] - 7.0], [22.0, 14.0]).fill(colour).stroke(DARK, 0.5)
        }
        Sign::Node(colour) => circle([at[0] + 11.0, at[1]], 3.5).fill(colour),
        Sign::Ring(colour) => circle([at[0] + 11.0, at[1]], 6.0).fill("none").stroke(colour, 1.5),
        Sign::Edge(colour) => line(at, [at[0] + 22.0, at[1]]).stroke(colour, 3.0),
    }
}

/// Breaks text at spaces into lines that fit.
fn wrap(words: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split(' ') {
        match lines.last_mut() {
            Some(line) if text_width(line, size) + text_width(word, size) < width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(String::from(word)),
        }
    }
    lines
}

/// A width that running text does not exceed in the usual fonts.
fn text_width(words: &str, size: f64) -> f64 {
    0.58 * size * words.chars().count() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrap_keeps_every_word() {
        let words = "largest 12.3 MPa at the rim of the hole";
        let lines = wrap(words, 10.0, 100.0);
        assert!(
            lines.len() > 2 && lines.iter().all(|line| text_width(line, 10.0) <= 100.0),
            "{lines:?}"
        );
        assert_eq!(lines.join(" "), words);
    }

    #[test]
    fn enlargement_fills_its_panel() {
        let whole = Bounds::of(&[[0.0, 0.0], [50.0, 50.0]]);
        let part = Bounds::of(&[[20.0, 20.0], [30.0, 25.0]]);
        let views =
            Page::new("t").views(&Panels { whole, part: Some((part, "p")), length_unit: "mm" });
        let right = views[1];
        assert_eq!(views[0].frame.size, right.frame.size);
        assert!((right.scale * 10.0 - right.frame.size[0]).abs() < 1e-9);
    }
}
