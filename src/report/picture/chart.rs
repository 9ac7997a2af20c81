//! A chart: curves over one axis, each axis linear or logarithmic.

use super::numbers::{power_of_ten, ticks};
use super::page::{DARK, INNER, MARGIN, Page, Sign, TEXT_SIZE};
use super::svg::{Anchor, Paint, Pixel, circle, group, line, path, text};
use crate::report::xml::Element;

const HEIGHT: f64 = 440.0;
/// Room for the labels of the vertical axis.
const LEFT: f64 = 78.0;
const GRID: &str = "#dddddd";

/// Colours that the colour-blind tell apart (M. Okabe, K. Ito, 2008), then repeated.
const COLOURS: [&str; 8] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#222222", "#f0e442"];

/// An axis.
pub struct Axis<'a> {
    /// What is measured, with its unit.
    pub label: &'a str,
    /// Powers of ten at equal distances; values that are not positive are left out.
    pub logarithmic: bool,
}

/// A curve or a set of points.
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// Places on the two axes, finite, in the order in which a line joins them.
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub style: Style,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// A line with a dot at each point.
    Dotted,
    /// A line alone.
    Line,
    /// Dots alone.
    Dots,
    /// Rings, around dots of other series.
    Rings,
}

/// A chart of `series` as a picture, with paragraphs under it.
pub fn chart(title: &str, [x, y]: [Axis; 2], series: &[Series], captions: &[String]) -> String {
    let mut page = Page::new(title);
    page.paragraph(y.label);
    let scales = [Scale::of(&x, series, 0), Scale::of(&y, series, 1)];
    let plot = Plot { scales, top: page.y + 6.0 };
    page.put(plot.grid());
    for (k, series) in series.iter().enumerate() {
        page.put(plot.series(series, COLOURS[k % COLOURS.len()]));
    }
    page.put(text(
        [MARGIN + LEFT + (INNER - LEFT) / 2.0, plot.top + HEIGHT + 40.0],
        TEXT_SIZE,
        Anchor::Middle,
        x.label,
    ));
    page.y = plot.top + HEIGHT + 56.0;
    page.legend(&legend(series));
    captions.iter().for_each(|words| page.paragraph(words));
    page.finish()
}

fn legend(series: &[Series]) -> Vec<(Sign, String)> {
    let sign = |k: usize, style| match style {
        Style::Dots => Sign::Node(COLOURS[k % COLOURS.len()]),
        Style::Rings => Sign::Ring(DARK),
        Style::Line | Style::Dotted => Sign::Edge(COLOURS[k % COLOURS.len()]),
    };
    series.iter().enumerate().map(|(k, s)| (sign(k, s.style), s.name.clone())).collect()
}

/// The range of an axis, in powers of ten where it is logarithmic.
struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Scale {
    fn of(axis: &Axis, series: &[Series], column: usize) -> Self {
        let logarithmic = axis.logarithmic;
        let values = series.iter().flat_map(|s| &s.points).map(|p| p[column]);
        let shown = values.filter(|x| !logarithmic || *x > 0.0);
        let shown = shown.map(|x| if logarithmic { x.log10() } else { x });
        let (low, high) =
            shown.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        if logarithmic {
            let (low, high) = (low.floor(), high.ceil());
            return Scale { low, high: high.max(low + 1.0), logarithmic };
        }
        let room = if high > low { 0.04 * (high - low) } else { 0.5 * high.abs().max(1.0) };
        Scale { low: low - room, high: high + room, logarithmic }
    }

    /// Where a value stands between the ends of the axis, 0 to 1; nothing where a logarithmic axis cannot show it.
    fn fraction(&self, value: f64) -> Option<f64> {
        if self.logarithmic && value <= 0.0 {
            return None;
        }
        let value = if self.logarithmic { value.log10() } else { value };
        Some((value - self.low) / (self.high - self.low))
    }

    /// Values that are marked, each between the ends of the axis, 0 to 1, with its words.
    fn ticks(&self) -> Vec<(f64, String)> {
        let place = |value: f64| (value - self.low) / (self.high - self.low);
        if !self.logarithmic {
            let marked = ticks(self.low, self.high).into_iter();
            return marked.map(|(value, words)| (place(value), words)).collect();
        }
        let (low, high) = (self.low as i32, self.high as i32);
        let step = ((high - low) / 9 + 1) as usize;
        (low..=high).step_by(step).map(|e| (place(f64::from(e)), power_of_ten(e))).collect()
    }
}

/// The area inside the axes.
struct Plot {
    scales: [Scale; 2],
    top: f64,
}

impl Plot {
    fn at(&self, x: f64, y: f64) -> Pixel {
        [MARGIN + LEFT + x * (INNER - LEFT), self.top + (1.0 - y) * HEIGHT]
    }

    fn grid(&self) -> Element {
        let mut lines = group().stroke(GRID, 1.0);
        let mut words = group();
        for (x, label) in self.scales[0].ticks() {
            lines.push(line(self.at(x, 0.0), self.at(x, 1.0)));
            let [px, py] = self.at(x, 0.0);
            words.push(text([px, py + 18.0], TEXT_SIZE, Anchor::Middle, &label));
        }
        for (y, label) in self.scales[1].ticks() {
            lines.push(line(self.at(0.0, y), self.at(1.0, y)));
            let [px, py] = self.at(0.0, y);
            words.push(text([px - 8.0, py + 5.0], TEXT_SIZE, Anchor::End, &label));
        }
        let axes = group()
            .stroke(DARK, 1.0)
            .with(line(self.at(0.0, 0.0), self.at(1.0, 0.0)))
            .with(line(self.at(0.0, 0.0), self.at(0.0, 1.0)));
        group().with(lines).with(axes).with(words)
    }

    fn series(&self, series: &Series, colour: &str) -> Element {
        let place = |p: &[f64; 2]| {
            Some(self.at(self.scales[0].fraction(p[0])?, self.scales[1].fraction(p[1])?))
        };
        let points: Vec<Pixel> = series.points.iter().filter_map(place).collect();
        let mut drawn = group();
        if series.style == Style::Rings {
            let rings = points.iter().map(|p| circle(*p, 6.0).fill("none").stroke(DARK, 1.5));
            return drawn.with_all(rings);
        }
        if series.style != Style::Dots && points.len() > 1 {
            drawn.push(path([points.as_slice()]).stroke(colour, 2.0));
        }
        if series.style != Style::Line {
            drawn.push(group().fill(colour).with_all(points.iter().map(|p| circle(*p, 3.0))));
        }
        drawn
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(logarithmic: bool, points: Vec<[f64; 2]>) -> String {
        let axis = |label| Axis { label, logarithmic };
        let series = [Series { name: "s".into(), points, style: Style::Dots }];
        chart("t", [axis("x"), axis("y")], &series, &[])
    }

    #[test]
    fn a_chart_marks_each_point() {
        let text = drawn(false, vec![[0.0, 0.0], [1.0, 2.0], [2.0, -1.0]]);
        let read = roxmltree::Document::parse(&text).unwrap();
        let circles = read.descendants().filter(|n| n.has_tag_name("circle")).count();
        assert_eq!(circles, 3 + 1, "three points and the legend's sign");
    }

    #[test]
    fn a_logarithmic_axis_leaves_out_what_it_cannot_show() {
        let text = drawn(true, vec![[1e-3, 1e-16], [10.0, 0.0]]);
        assert!(text.contains("10⁻³") && text.contains("10⁻¹⁶"), "{text}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }

    #[test]
    fn a_chart_of_nothing_is_a_chart() {
        assert!(drawn(false, vec![]).contains("</svg>"));
        assert!(drawn(true, vec![]).contains("</svg>"));
    }
}
