//! Stability at the extremes, for people, for machines and for the eye.

use super::picture::{Axis, Series, Style, chart};
use super::tables::aligned;
use crate::studies::extremes::{Break, Column, Generator, Measured, Verdict};

/// The generators' names.
pub fn list(generators: &[Generator]) -> String {
    aligned_with(
        &["generator", "what is swept", ""],
        generators.iter().map(|g| vec![g.name.into(), g.magnitude.into(), g.title.into()]),
    )
}

/// For each generator where its ways give, then what came of every magnitude.
pub fn text(measured: &[Measured]) -> String {
    let of = |m: &Measured| format!("{}: {}\n\n{}\n{}", m.name, m.title, breaks(m), sweep(m));
    measured.iter().map(of).collect::<Vec<_>>().join("\n\n")
}

/// The measurement as JSON.
pub fn json(measured: &[Measured]) -> String {
    serde_json::to_string(measured).expect("string keys only") + "\n"
}

/// Digits kept against magnitude.
pub fn picture(measured: &Measured) -> String {
    let series: Vec<Series> =
        measured.columns.iter().map(|column| curve(measured, column)).collect();
    let label = match measured.logarithmic {
        true => measured.magnitude.into(),
        false => {
            let names = measured.labels.iter().enumerate();
            names.map(|(k, name)| format!("{}: {name}", k + 1)).collect::<Vec<_>>().join("; ")
        }
    };
    let axes = [
        Axis {
            label: if measured.logarithmic { measured.magnitude } else { "case" },
            logarithmic: measured.logarithmic,
        },
        Axis { label: "digits kept", logarithmic: false },
    ];
    let captions = [
        "A curve has a gap where a run is refused; 0 is an answer without a right digit.".into(),
        label,
    ];
    chart(measured.title, axes, &series, &captions)
}

fn curve(measured: &Measured, column: &Column) -> Series {
    let points = measured.magnitudes.iter().zip(&column.verdicts);
    let points = points.filter_map(|(x, v)| Some([*x, v.digits(column.carried)?])).collect();
    Series { name: column.name.clone(), points, style: Style::Dotted }
}

/// A row a way: digits where the sweep is kindest, and where it gives.
fn breaks(measured: &Measured) -> String {
    if !measured.logarithmic {
        return String::new();
    }
    aligned_with(
        &["way", "best", "gives below", "there", "gives above", "there"],
        measured.columns.iter().map(|column| {
            let [below, above] = [&column.below, &column.above].map(broken);
            [vec![column.name.clone(), best(column)], below, above].concat()
        }),
    )
}

fn best(column: &Column) -> String {
    let digits = column.verdicts.iter().filter_map(|v| v.digits(column.carried));
    format!("{:.0}", digits.fold(0.0, f64::max).floor())
}

fn broken(at: &Option<Break>) -> Vec<String> {
    match at {
        None => vec!["-".into(), "-".into()],
        Some(at) => vec![format!("1e{:.0}", at.exponent.round()), at.verdict.to_string()],
    }
}

/// A row a magnitude, a column a way, under numbers that the legend explains.
fn sweep(measured: &Measured) -> String {
    let numbers = (1..=measured.columns.len()).map(|k| format!("({k})"));
    let head: Vec<String> =
        std::iter::once(measured.magnitude.to_string()).chain(numbers).collect();
    let rows = measured.labels.iter().enumerate().map(|(k, label)| {
        let cell = |verdict: &Verdict| match measured.logarithmic {
            true => short(verdict),
            false => verdict.to_string(),
        };
        let cells = measured.columns.iter().map(|column| cell(&column.verdicts[k]));
        std::iter::once(label.clone()).chain(cells).collect()
    });
    let names = measured.columns.iter().enumerate();
    let names: Vec<String> = names.map(|(k, c)| format!("  ({}) {}", k + 1, c.name)).collect();
    format!(
        "{}\n{}",
        names.join("\n"),
        aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
    )
}

/// A verdict without the place of the error: the table of breaking points has it.
fn short(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Refused(_) => "refused".into(),
        Verdict::Wrong(_) => "WRONG".into(),
        other => other.to_string(),
    }
}

fn aligned_with(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let head = head.iter().map(|cell| cell.to_string()).collect();
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}
