//! A picture's layout: what stands under what. Each part is put below the one before.

use super::colour::{ColourScale, with_unit};
use super::svg::{
    Anchor, Coloured, DARK, TEXT_SIZE, TITLE_SIZE, circle, document, group, line, rect, text,
    text_of_size,
};
use super::view::{Bounds, Frame, View};
use crate::numbers::{round_at_most, significant};
use base::xml::Element;

/// The width of a picture that stands alone, and of one of several on a screen, pixels. Printed at 2/3, they
/// fill a page and a column of A4, and their text has 7 pt.
const WIDTH: f64 = 1000.0;
const SMALL: f64 = 490.0;

/// The room that such pictures leave free at each side, pixels.
const MARGIN: f64 = 40.0;
const SMALL_MARGIN: f64 = 4.0;

/// The room between two panels or two signs of the legend, pixels.
const GAP: f64 = 24.0;

/// The least and the largest height of a panel, over the width of one of two.
const PANEL_HEIGHT: [f64; 2] = [0.6, 1.2];

/// The width of the colour bar, pixels.
const BAR_WIDTH: f64 = 640.0;

/// A scale bar is up to a quarter as long as its panel is wide, or as one of this width, pixels.
const SCALE_BAR: f64 = 240.0;

/// An entry of a legend, with its colour.
pub enum Sign {
    /// A filled area.
    Body(&'static str),
    /// A dot, for a node or a point of a chart.
    Node(&'static str),
    /// A line.
    Edge(&'static str),
    /// A circle.
    Ring(&'static str),
}

/// A picture of several panels, one below the other.
pub struct Page {
    title: String,
    width: f64,
    /// The room that is left free at each side, pixels.
    pub margin: f64,
    content: Element,
    /// Where the next part begins, pixels from the top.
    pub y: f64,
}

impl Page {
    /// Begins a page that has its title only.
    pub fn new(words: &str) -> Self {
        let mut page =
            Self { width: WIDTH, margin: MARGIN, y: MARGIN - 10.0, ..Page::small(words) };
        for words in wrap(words, TITLE_SIZE, page.inner()) {
            page.y += TITLE_SIZE * 1.3;
            let title = text_of_size(TITLE_SIZE, [page.margin, page.y - 6.0], &words);
            page.put(title.set("font-weight", "bold"));
        }
        page.y += 10.0;
        page
    }

    /// Begins a page of a picture among others, whose title stands outside it.
    pub fn small(title: &str) -> Self {
        let content = group().fill(DARK);
        Self { title: title.into(), width: SMALL, margin: SMALL_MARGIN, content, y: 0.0 }
    }

    /// The width between the margins, pixels.
    pub fn inner(&self) -> f64 {
        self.width - 2.0 * self.margin
    }

    /// Writes a paragraph below what is there.
    pub fn paragraph(&mut self, words: &str) {
        for words in wrap(words, TEXT_SIZE, self.inner()) {
            self.y += TEXT_SIZE * 1.45;
            self.put(text([self.margin, self.y - 5.0], Anchor::Start, &words));
        }
        self.y += 3.0;
    }

    /// Puts the whole, and beside it the contact zone where that is enlarged, grown to the shape of its
    /// panel; `draw` fills a panel, and `unit` is that of lengths.
    pub fn panels(
        &mut self,
        whole: &Bounds,
        zone: Option<&Bounds>,
        unit: &str,
        draw: impl Fn(&View) -> Element,
    ) {
        let (top, inner, [width, height]) = (self.y, self.inner(), whole.size());
        let frame =
            |x: f64, y: f64, size: [f64; 2]| Frame { corner: [self.margin + x, top + y], size };
        let panel = (inner - GAP) / 2.0;
        let [lowest, highest] = PANEL_HEIGHT.map(|ratio| ratio * panel);
        let Some(zone) = zone else {
            let scale = (inner / width).min(highest / height);
            let size = [width * scale, height * scale];
            let view = View::new(whole, frame((inner - size[0]) / 2.0, 6.0, size), false);
            self.put(draw(&view));
            return self.scale_bar(&view, unit);
        };
        let size = [panel, (panel * (height / width)).clamp(lowest, highest)];
        let right = frame(panel + GAP, 38.0, size);
        let whole = View::new(whole, frame(0.0, 38.0, size), false);
        let enlarged = View::new(&with_ratio(zone, size[0] / size[1]), right, true);
        let times = enlarged.scale / whole.scale;
        let words = format!("b: the frame in a, × {times:.1}");
        self.put(text([whole.frame.corner[0], top + 18.0], Anchor::Start, "a: the whole"));
        self.put(text([right.corner[0], top + 18.0], Anchor::Start, &words));
        self.put(draw(&whole));
        self.scale_bar(&whole, unit);
        // The enlargement is cut at the panel's edge and has a frame. The title keeps names apart where
        // several pictures stand in one web page.
        let id = format!("clip-{}", self.title.replace(|c: char| !c.is_alphanumeric(), "-"));
        self.put(Element::new("clipPath").set("id", &id).with(rect(right.corner, size)));
        self.put(group().set("clip-path", format!("url(#{id})")).with(draw(&enlarged)));
        self.put(rect(right.corner, size).fill("none").stroke(DARK, 1.5));
        self.scale_bar(&enlarged, unit);
        // The frame in the whole; white under its line stands out from any colour.
        let ratio = whole.scale / enlarged.scale;
        let size = size.map(|side| side * ratio);
        let centre = whole.pixel(enlarged.centre);
        let corner = [0, 1].map(|axis| centre[axis] - size[axis] / 2.0);
        let line = |colour, width| rect(corner, size).fill("none").stroke(colour, width);
        self.put(group().with(line("#ffffff", 3.5)).with(line(DARK, 1.5)));
    }

    /// Puts a bar of round length under a panel's lower left corner; the next part begins below it.
    fn scale_bar(&mut self, view: &View, unit: &str) {
        let Frame { corner: [x, top], size } = view.frame;
        let length = round_at_most(size[0].max(SCALE_BAR) / 4.0 / view.scale);
        let (y, end) = (top + size[1] + 20.0, x + length * view.scale);
        let upright = |x: f64| line([x, y - 4.0], [x, y + 4.0]);
        let bar = group().stroke(DARK, 1.5).with(line([x, y], [end, y]));
        let unit = if unit.is_empty() { "(unit of the scene)" } else { unit };
        let words = with_unit(&significant(length, 1), unit);
        let words = text([end + 8.0, y + 5.0], Anchor::Start, &words);
        self.put(group().with(bar.with(upright(x)).with(upright(end))).with(words));
        self.y = top + size[1] + 44.0;
    }

    /// Draws the colours of a quantity with their values.
    pub fn colour_bar(&mut self, scale: &ColourScale, quantity: &str, unit: &str) {
        self.paragraph(&scale.heading(quantity, unit));
        // Indented: half of a tick's label stands out at either end.
        self.y = self.y.round();
        let width = BAR_WIDTH.min(self.inner() - 20.0);
        self.put(scale.bar([self.margin + 10.0, self.y + 2.0], width));
        self.y += ColourScale::HEIGHT + 6.0;
    }

    /// Puts signs with their words, in as many rows as needed.
    pub fn legend(&mut self, entries: &[(Sign, String)]) {
        if entries.is_empty() {
            return;
        }
        let mut x = self.margin;
        for (sign, words) in entries {
            let width = 34.0 + text_width(words, TEXT_SIZE);
            if x > self.margin && x + width > self.width - self.margin {
                x = self.margin;
                self.y += 24.0;
            }
            let y = self.y + 9.0;
            self.put(match sign {
                Sign::Body(colour) => {
                    rect([x, y - 7.0], [22.0, 14.0]).fill(colour).stroke(DARK, 0.5)
                }
                Sign::Node(colour) => circle([x + 11.0, y], 3.5).fill(colour),
                Sign::Ring(colour) => circle([x + 11.0, y], 6.0).fill("none").stroke(colour, 1.5),
                Sign::Edge(colour) => line([x, y], [x + 22.0, y]).stroke(colour, 3.0),
            });
            self.put(text([x + 30.0, self.y + 14.0], Anchor::Start, words));
            x += width + GAP;
        }
        self.y += 30.0;
    }

    /// Returns the text of the SVG file.
    pub fn finish(self) -> String {
        document([self.width, (self.y + self.margin / 2.0).ceil()], &self.title, self.content)
    }

    /// Puts an element where its own coordinates say.
    pub fn put(&mut self, element: Element) {
        self.content.push(element);
    }

    /// Returns the views of a whole that stands `count` times side by side, under a line of words.
    pub fn repeated(&self, whole: &Bounds, count: usize) -> Vec<View> {
        let width = (self.inner() - GAP * (count - 1) as f64) / count as f64;
        let [across, high] = whole.size();
        let size = [width, (width * high / across).min(width)];
        let corner = |k: usize| [self.margin + (width + GAP) * k as f64, self.y + 24.0];
        (0..count).map(|k| View::new(whole, Frame { corner: corner(k), size }, false)).collect()
    }
}

/// Returns a box grown about its centre until width : height is `ratio`.
fn with_ratio(bounds: &Bounds, ratio: f64) -> Bounds {
    let ([width, height], centre) = (bounds.size(), bounds.centre());
    let size = [width.max(height * ratio), height.max(width / ratio)];
    let side = |sign: f64| [0, 1].map(|axis| centre[axis] + sign * (size[axis] / 2.0));
    Bounds { low: side(-1.0), high: side(1.0) }
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

/// Returns a width that running text does not exceed in the usual fonts, pixels.
pub fn text_width(words: &str, size: f64) -> f64 {
    0.58 * size * words.chars().count() as f64
}
