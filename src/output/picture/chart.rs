//! A chart: curves over one axis, each axis linear or logarithmic. A curve has its name at its end.

use super::page::{Page, Sign, text_width};
use super::svg::{Anchor, Coloured, DARK, Pixel, TEXT_SIZE, circle, group, line, path, text};
use crate::numbers::{power_of_ten, ticks};

/// The height of the area inside the axes, of a chart that stands alone and of a small one, pixels.
const HEIGHT: f64 = 340.0;
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

fn put(page: &mut Page, height: f64, axes: [Axis; 2], series: &[Series]) {
    page.paragraph(axes[1].label);
    let scales = [0, 1].map(|column| Scale::new(axes[column].logarithmic, series, column));
    let is_curve = |style| match style {
        Style::Dotted | Style::Line => true,
        Style::Dots | Style::Rings => false,
    };
    let curves = series.iter().filter(|series| is_curve(series.style));
    let names = curves.map(|series| text_width(&series.name, TEXT_SIZE) + 20.0);
    let width = page.inner() - LEFT - names.fold(0.0, f64::max);
    let (left, top) = (page.margin + LEFT, page.y + 6.0);
    let pixel = |x: f64, y: f64| [left + x * width, top + (1.0 - y) * height];

    let (mut lines, mut words) = (group().stroke(GRID, 1.0), group());
    for (x, label) in scales[0].ticks() {
        let [px, py] = pixel(x, 0.0);
        lines.push(line([px, py], pixel(x, 1.0)));
        words.push(text([px, py + 18.0], Anchor::Middle, &label));
    }
    for (y, label) in scales[1].ticks() {
        let [px, py] = pixel(0.0, y);
        lines.push(line([px, py], pixel(1.0, y)));
        words.push(text([px - 8.0, py + 5.0], Anchor::End, &label));
    }
    let both = group()
        .stroke(DARK, 1.0)
        .with(line(pixel(0.0, 0.0), pixel(1.0, 0.0)))
        .with(line(pixel(0.0, 0.0), pixel(0.0, 1.0)));
    page.put(group().with(lines).with(both).with(words));

    // A curve has its name at its end, other series stand in the legend.
    let (mut ends, mut legend) = (Vec::new(), Vec::new());
    for (k, Series { name, points, style }) in series.iter().enumerate() {
        let place = |[x, y]: &[f64; 2]| Some(pixel(scales[0].place(*x)?, scales[1].place(*y)?));
        let points: Vec<Pixel> = points.iter().filter_map(place).collect();
        let colour = if *style == Style::Rings { DARK } else { COLOURS[k % SERIES] };
        let mut drawn = group();
        if is_curve(*style) && points.len() > 1 {
            drawn.push(path([&points]).stroke(colour, if k < SERIES { 2.0 } else { 1.0 }));
        }
        match style {
            Style::Line => {}
            Style::Rings => {
                let rings = points.iter().map(|p| circle(*p, 6.0).fill("none").stroke(DARK, 1.5));
                drawn = drawn.with_all(rings);
            }
            Style::Dotted | Style::Dots => {
                drawn.push(group().fill(colour).with_all(points.iter().map(|p| circle(*p, 3.0))));
            }
        }
        page.put(drawn);
        match style {
            Style::Dotted | Style::Line => {
                ends.extend(points.last().map(|end| (*end, name, colour)));
            }
            Style::Dots => legend.push((Sign::Node(colour), name.clone())),
            Style::Rings => legend.push((Sign::Ring(colour), name.clone())),
        }
    }

    // The names stand in the order of the ends from above, as they are written: of ends that rounding parts,
    // the first curve's name comes first. None stands so low that those after it do not fit above the axis.
    ends.sort_by_key(|(end, ..)| (100.0 * end[1]).round() as i64);
    let [mut y, x] = [top - LINE, pixel(1.0, 0.0)[0] + 14.0];
    let (mut names, count) = (group(), ends.len());
    for (k, (end, name, colour)) in ends.into_iter().enumerate() {
        y = end[1].min(top + height - LINE * (count - 1 - k) as f64).max(y + LINE);
        names.push(line(end, [x - 3.0, y]).stroke(colour, 0.7));
        names.push(text([x, y + 5.0], Anchor::Start, name).fill(colour));
    }
    page.put(names);
    let under = [left + width / 2.0, top + height + 40.0];
    page.put(text(under, Anchor::Middle, axes[0].label));
    page.y = top + height + 56.0;
    page.legend(&legend);
}

/// The range of an axis; of a logarithmic one `low` and `high` are exponents of ten.
struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Scale {
    fn new(logarithmic: bool, series: &[Series], column: usize) -> Self {
        let mut scale = Scale { low: f64::INFINITY, high: f64::NEG_INFINITY, logarithmic };
        for point in series.iter().flat_map(|series| &series.points) {
            if let Some(x) = scale.shown(point[column]) {
                (scale.low, scale.high) = (scale.low.min(x), scale.high.max(x));
            }
        }
        let Scale { low, high, .. } = scale;
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        if logarithmic {
            let low = low.floor();
            return Scale { low, high: high.ceil().max(low + 1.0), logarithmic };
        }
        // Upwards what is nowhere negative begins at 0.
        let begins_at_0 = column == 1 && low >= 0.0;
        let low = if begins_at_0 { 0.0 } else { low };
        let room = if high > low { 0.04 * (high - low) } else { 0.5 * high.abs().max(1.0) };
        Scale { low: if begins_at_0 { 0.0 } else { low - room }, high: high + room, logarithmic }
    }

    /// Returns what a value counts on the axis; nothing where a logarithmic one cannot show it.
    fn shown(&self, value: f64) -> Option<f64> {
        if self.logarithmic { (value > 0.0).then(|| value.log10()) } else { Some(value) }
    }

    /// Returns where a value that is shown stands between the ends of the axis, 0 to 1.
    fn place(&self, value: f64) -> Option<f64> {
        Some((self.shown(value)? - self.low) / (self.high - self.low))
    }

    /// Returns the places that are marked, each with its words.
    fn ticks(&self) -> Vec<(f64, String)> {
        let marked: Vec<(f64, String)> = match self.logarithmic {
            false => ticks(self.low, self.high),
            true => {
                let (low, high) = (self.low as i32, self.high as i32);
                let exponents = (low..=high).step_by(((high - low) / 9 + 1) as usize);
                exponents.map(|exponent| (f64::from(exponent), power_of_ten(exponent))).collect()
            }
        };
        let size = self.high - self.low;
        marked.into_iter().map(|(at, words)| ((at - self.low) / size, words)).collect()
    }
}
