//! Stability at the extremes, for people, for machines and as a picture.

use schemars::JsonSchema;
use serde::Serialize;

use super::json::headed;
use super::layout::{Table, aligned};
use super::picture::{Axis, SERIES, Series, Style, chart};
use studies::extremes::{Break, Column, Generator, Measured, Verdict};

/// The content of `extremes.json`: a row for each generator.
#[derive(Serialize, JsonSchema)]
pub struct Document<'a> {
    rows: &'a [Measured],
}

/// Returns the content of `extremes.json`.
pub fn json(measured: &[Measured]) -> String {
    headed(&Document { rows: measured })
}

pub fn list(generators: &[Generator]) -> String {
    Table::of(generators)
        .column("generator", |generator| generator.name)
        .column("what is swept", |generator| generator.magnitude)
        .column("title", |generator| generator.title)
        .text()
}

/// Lays out for each generator where its methods break down, then what came of every magnitude.
pub fn text(measured: &[Measured]) -> String {
    let of = |m: &Measured| format!("{}: {}\n\n{}\n{}", m.name, m.title, breaks(m), sweep(m));
    measured.iter().map(of).collect::<Vec<_>>().join("\n\n")
}

/// Draws the digits that each method keeps against the magnitude, in as many pictures as its curves
/// need.
pub fn pictures(measured: &Measured) -> Vec<String> {
    measured.columns.chunks(SERIES).map(|columns| picture(measured, columns)).collect()
}

fn picture(measured: &Measured, columns: &[Column]) -> String {
    let series: Vec<Series> = columns.iter().map(|column| curve(measured, column)).collect();
    let (label, magnitudes) = match measured.logarithmic {
        true => (measured.magnitude, measured.magnitude.into()),
        false => {
            let names = measured.labels.iter().enumerate();
            let names = names.map(|(k, name)| format!("{}: {name}", k + 1));
            ("case", names.collect::<Vec<_>>().join("; "))
        }
    };
    let axes = [
        Axis { label, logarithmic: measured.logarithmic },
        Axis { label: "digits kept", logarithmic: false },
    ];
    let captions = [
        "A curve has a gap where a run is refused; 0 is an answer without a right digit.".into(),
        magnitudes,
    ];
    chart(measured.title, axes, &series, &captions)
}

fn curve(measured: &Measured, column: &Column) -> Series {
    let points = measured.magnitudes.iter().zip(&column.verdicts);
    let points = points.filter_map(|(x, v)| Some([*x, v.digits(column.carried)?])).collect();
    Series { name: column.name.clone(), points, style: Style::Dotted }
}

/// Lays out a line for each method: the digits where the sweep is kindest, and where it breaks
/// down. Nothing where the magnitudes are no numbers.
fn breaks(measured: &Measured) -> String {
    if !measured.logarithmic {
        return String::new();
    }
    let exponent = |at: &Break| format!("1e{:.0}", at.exponent.round());
    let at = |at: &Option<Break>| at.as_ref().map_or("-".into(), exponent);
    let there = |at: &Option<Break>| at.as_ref().map_or("-".into(), |at| at.verdict.to_string());
    Table::of(&measured.columns)
        .column("method", |column| column.name.clone())
        .column("most digits", |column| {
            let digits = column.verdicts.iter().filter_map(|v| v.digits(column.carried));
            format!("{:.0}", digits.fold(0.0, f64::max).floor())
        })
        .column("breaks down below", |column| at(&column.below))
        .column("there", |column| there(&column.below))
        .column("breaks down above", |column| at(&column.above))
        .column("there", |column| there(&column.above))
        .text()
}

/// Lays out a line for each magnitude and a column for each method, and a legend above them.
fn sweep(measured: &Measured) -> String {
    let numbered = || measured.columns.iter().zip(1..);
    let names: Vec<String> = numbered().map(|(c, k)| format!("  ({k}) {}", c.name)).collect();
    let numbers = numbered().map(|(_, k)| format!("({k})"));
    let rows = measured.labels.iter().enumerate().map(|(k, label)| {
        let cell = |column: &Column| match (&column.verdicts[k], measured.logarithmic) {
            // The table above tells what was refused or wrong.
            (Verdict::Refused(_), true) => "refused".into(),
            (Verdict::Wrong(_), true) => "WRONG".into(),
            (verdict, _) => verdict.to_string(),
        };
        std::iter::once(label.clone()).chain(measured.columns.iter().map(cell)).collect()
    });
    let head = std::iter::once(measured.magnitude.to_string()).chain(numbers);
    let unknown = measured.columns.iter().any(|c| c.verdicts.contains(&Verdict::Unknown));
    let note = match unknown {
        true => "  ?: an answer that no exact one stands beside: under unilateral a node opens\n",
        false => "",
    };
    format!("{}\n{}{note}", names.join("\n"), aligned(head, rows))
}
