//! A chart: curves over one axis, each axis linear or logarithmic. A curve has its name at its end.

use super::page::{MARGIN, Page, Sign, text_width};
use super::svg::{Anchor, Coloured, DARK, Pixel, TEXT_SIZE, circle, group, line, path, text};
use crate::numbers::{power_of_ten, ticks};
use base::xml::Element;

/// The height of the area inside the axes, of a chart that stands alone and of a small one, pixels.
const HEIGHT: f64 = 440.0;
const SMALL: f64 = 156.0;

/// The room for the labels of the vertical axis, pixels.
const LEFT: f64 = 78.0;

/// The colour of the lines across the area.
const GRID: &str = "#dddddd";

/// The number of colours that can be told apart: a chart of more series has them again, in thin lines.
pub const SERIES: usize = 8;

/// The least distance between the base lines of two names, pixels.
const LINE: f64 = 17.0;

/// Colours that the colour-blind tell apart (M. Okabe, K. Ito, 2008).
const COLOURS: [&str; SERIES] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#222222", "#f0e442"];

/// An axis: what it shows, and how.
pub struct Axis<'a> {
    /// The quantity along the axis, with its unit.
    pub label: &'a str,
    /// Whether powers of ten stand at equal distances; other than positive values are left out.
    pub logarithmic: bool,
}

/// A series of points of a chart.
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// The places on the two axes, finite, in the order in which a line joins them.
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub style: Style,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// By dots alone.
    Dotted,
    /// A line without dots.
    Line,
    /// Dots without a line.
    Dots,
    /// Rings, around dots of other series.
    Rings,
}

impl Style {
    fn is_curve(self) -> bool {
        match self {
            Style::Dotted | Style::Line => true,
            Style::Dots | Style::Rings => false,
        }
    }
}

/// Draws a chart of `series`, with paragraphs under it.
pub fn chart(title: &str, axes: [Axis; 2], series: &[Series], captions: &[String]) -> String {
    let mut page = Page::new(title);
    put(&mut page, HEIGHT, axes, series);
    captions.iter().for_each(|words| page.paragraph(words));
    page.finish()
}

/// Draws a chart of `series` among other pictures.
pub fn small_chart(title: &str, axes: [Axis; 2], series: &[Series]) -> String {
    let mut page = Page::small(title);
    put(&mut page, SMALL, axes, series);
    page.y -= 10.0;
    page.finish()
}

fn put(page: &mut Page, height: f64, [x, y]: [Axis; 2], series: &[Series]) {
    page.paragraph(y.label);
    let scales = [Scale::from_series(&x, series, 0), Scale::from_series(&y, series, 1)];
    let curves = series.iter().filter(|series| series.style.is_curve());
    let names = curves.map(|series| text_width(&series.name, TEXT_SIZE) + 20.0);
    let width = page.inner() - LEFT - names.fold(0.0, f64::max);
    let plot = Plot { scales, top: page.y + 6.0, width, height };
    page.put(plot.grid());
    for (k, series) in series.iter().enumerate() {
        page.put(plot.series(k, series));
    }
    page.put(plot.names(series));
    let under = [MARGIN + LEFT + plot.width / 2.0, plot.top + height + 40.0];
    page.put(text(under, Anchor::Middle, x.label));
    page.y = plot.top + height + 56.0;
    page.legend(&legend(series));
}

/// Returns the colour of the series at place `k`; rings have that of text.
fn colour(k: usize, style: Style) -> &'static str {
    if style == Style::Rings { DARK } else { COLOURS[k % SERIES] }
}

/// Returns the signs of the series without a line, whose names stand under the chart.
fn legend(series: &[Series]) -> Vec<(Sign, String)> {
    let sign = |(k, series): (usize, &Series)| {
        let colour = colour(k, series.style);
        let sign = match series.style {
            Style::Rings => Sign::Ring(colour),
            Style::Dotted | Style::Line | Style::Dots => Sign::Node(colour),
        };
        (sign, series.name.clone())
    };
    series.iter().enumerate().filter(|(_, series)| !series.style.is_curve()).map(sign).collect()
}

/// The range of an axis; of a logarithmic one `low` and `high` are exponents of ten.
struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Scale {
    fn from_series(axis: &Axis, series: &[Series], column: usize) -> Self {
        let logarithmic = axis.logarithmic;
        let points = series.iter().flat_map(|series| &series.points);
        let shown = points.filter_map(|point| on_axis(point[column], logarithmic));
        let nothing = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = shown.fold(nothing, |(low, high), x| (low.min(x), high.max(x)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        if logarithmic {
            let (low, high) = (low.floor(), high.ceil());
            return Scale { low, high: high.max(low + 1.0), logarithmic };
        }
        let room = if high > low { 0.04 * (high - low) } else { 0.5 * high.abs().max(1.0) };
        Scale { low: low - room, high: high + room, logarithmic }
    }

    /// Returns where a number of the range stands between the ends of the axis, 0 to 1.
    fn fraction(&self, number: f64) -> f64 {
        (number - self.low) / (self.high - self.low)
    }

    /// Returns the places that are marked, each with its words.
    fn ticks(&self) -> Vec<(f64, String)> {
        if !self.logarithmic {
            let marked = ticks(self.low, self.high).into_iter();
            return marked.map(|(value, words)| (self.fraction(value), words)).collect();
        }
        let (low, high) = (self.low as i32, self.high as i32);
        let step = ((high - low) / 9 + 1) as usize;
        let marked = (low..=high).step_by(step);
        marked.map(|e| (self.fraction(f64::from(e)), power_of_ten(e))).collect()
    }
}

/// Returns what a value counts on an axis; nothing where a logarithmic one cannot show it.
fn on_axis(value: f64, logarithmic: bool) -> Option<f64> {
    if logarithmic { (value > 0.0).then(|| value.log10()) } else { Some(value) }
}

/// The area inside the axes, `top` pixels from the upper end of the picture.
struct Plot {
    scales: [Scale; 2],
    top: f64,
    width: f64,
    height: f64,
}

impl Plot {
    fn pixel(&self, x: f64, y: f64) -> Pixel {
        [MARGIN + LEFT + x * self.width, self.top + (1.0 - y) * self.height]
    }

    fn grid(&self) -> Element {
        let mut lines = group().stroke(GRID, 1.0);
        let mut words = group();
        for (x, label) in self.scales[0].ticks() {
            lines.push(line(self.pixel(x, 0.0), self.pixel(x, 1.0)));
            let [px, py] = self.pixel(x, 0.0);
            words.push(text([px, py + 18.0], Anchor::Middle, &label));
        }
        for (y, label) in self.scales[1].ticks() {
            lines.push(line(self.pixel(0.0, y), self.pixel(1.0, y)));
            let [px, py] = self.pixel(0.0, y);
            words.push(text([px - 8.0, py + 5.0], Anchor::End, &label));
        }
        let axes = group()
            .stroke(DARK, 1.0)
            .with(line(self.pixel(0.0, 0.0), self.pixel(1.0, 0.0)))
            .with(line(self.pixel(0.0, 0.0), self.pixel(0.0, 1.0)));
        group().with(lines).with(axes).with(words)
    }

    /// Returns the points of a series that the axes can show.
    fn points(&self, series: &Series) -> Vec<Pixel> {
        let place = |scale: &Scale, value| Some(scale.fraction(on_axis(value, scale.logarithmic)?));
        let [scale_x, scale_y] = &self.scales;
        let place = |[x, y]: &[f64; 2]| Some(self.pixel(place(scale_x, *x)?, place(scale_y, *y)?));
        series.points.iter().filter_map(place).collect()
    }

    /// Draws the names of the curves on the right, each joined to its curve's end, in the order of
    /// these ends from above.
    fn names(&self, series: &[Series]) -> Element {
        let mut ends: Vec<(Pixel, &str, &str)> = Vec::new();
        for (k, series) in series.iter().enumerate().filter(|(_, s)| s.style.is_curve()) {
            ends.extend(
                self.points(series)
                    .last()
                    .map(|end| (*end, &*series.name, colour(k, series.style))),
            );
        }
        // As they are written: of ends that rounding parts, the first curve's name comes first.
        ends.sort_by_key(|(end, ..)| (100.0 * end[1]).round() as i64);
        // No name stands so low that those after it do not fit above the axis.
        let lowest = self.top + self.height;
        let [mut y, x] = [self.top - LINE, self.pixel(1.0, 0.0)[0] + 14.0];
        let mut names = group();
        let count = ends.len();
        for (k, (end, name, colour)) in ends.into_iter().enumerate() {
            y = end[1].min(lowest - LINE * (count - 1 - k) as f64).max(y + LINE);
            names.push(line(end, [x - 3.0, y]).stroke(colour, 0.7));
            names.push(text([x, y + 5.0], Anchor::Start, name).fill(colour));
        }
        names
    }

    /// Draws the series at place `k`.
    fn series(&self, k: usize, series: &Series) -> Element {
        let colour = colour(k, series.style);
        let width = if k < SERIES { 2.0 } else { 1.0 };
        let points = self.points(series);
        let mut drawn = group();
        if series.style == Style::Rings {
            let rings = points.iter().map(|p| circle(*p, 6.0).fill("none").stroke(DARK, 1.5));
            return drawn.with_all(rings);
        }
        if series.style != Style::Dots && points.len() > 1 {
            drawn.push(path([points.as_slice()]).stroke(colour, width));
        }
        if series.style != Style::Line {
            drawn.push(group().fill(colour).with_all(points.iter().map(|p| circle(*p, 3.0))));
        }
        drawn
    }
}
