//! Stability at the extremes, for people, for machines and as a picture.

use serde_json::json;

use crate::extremes::{Break, Column, Kept, SweepTable};
use output::json;
use output::model::{Cell, Report, Table};
use output::picture::{Axis, Series, Style, chart};

/// Returns the content of `extremes.json`: a row for each generator.
pub fn json(measured: &[SweepTable]) -> String {
    json::line(None, &json!({ "rows": measured }))
}

/// Reports for each generator where its methods break down, then what came of every magnitude.
pub fn report(measured: &[SweepTable]) -> Report {
    measured.iter().fold(Report::default(), |report, measured| {
        report
            .heading(format!("{}: {}", measured.generator.name, measured.generator.title))
            .table(format!("Limits of {}", measured.generator.name), breaks(measured))
            .then(sweep(measured))
    })
}

/// Draws the digits that each method keeps against the magnitude.
pub fn picture(measured: &SweepTable) -> String {
    let curve = |column: &Column| {
        let points = measured.magnitudes.iter().zip(&column.verdicts);
        let points = points.filter_map(|(x, v)| Some([*x, v.digits(column.carried)?])).collect();
        Series { name: column.name.clone(), points, style: Style::Dotted }
    };
    let series: Vec<Series> = measured.columns.iter().map(curve).collect();
    let axes = [
        Axis { label: measured.generator.magnitude, logarithmic: true },
        Axis { label: "digits kept", logarithmic: false },
    ];
    let caption = "A curve has a gap where a run is refused; 0 is an answer without a right digit.";
    chart(measured.generator.title, axes, &series, &[caption.into()])
}

/// Returns a row for each method: the digits where the sweep is kindest, and where it breaks down.
fn breaks(measured: &SweepTable) -> Table<Vec<&Column>> {
    let magnitude = |found: &Option<Break>| {
        found.as_ref().map(|found| format!("1e{:.0}", found.exponent.round()))
    };
    let verdict = |found: &Option<Break>| found.as_ref().map(|found| found.verdict.to_string());
    Table::from_rows(&measured.columns)
        .column("method", |column| column.name.clone())
        .column("most digits", |column| {
            let digits = column.verdicts.iter().filter_map(|v| v.digits(column.carried));
            Cell::decimals(digits.fold(0.0, f64::max).floor(), 0)
        })
        .column("breaks down below", |column| magnitude(&column.below))
        .column("verdict below", |column| verdict(&column.below))
        .column("breaks down above", |column| magnitude(&column.above))
        .column("verdict above", |column| verdict(&column.above))
}

/// Reports a row for each magnitude and a column for each method.
fn sweep(measured: &SweepTable) -> Report {
    let rows = measured.magnitudes.iter().enumerate().map(|(k, magnitude)| {
        let cell = |column: &Column| match &column.verdicts[k] {
            // The table above says what was refused or wrong.
            Kept::Refused(_) => "refused".into(),
            Kept::Wrong(_) => "WRONG".into(),
            verdict => verdict.to_string().into(),
        };
        let label = format!("{magnitude:e}").into();
        std::iter::once(label).chain(measured.columns.iter().map(cell)).collect()
    });
    let numbers = (1..=measured.columns.len()).map(|k| format!("({k})"));
    let head = std::iter::once(measured.generator.magnitude.to_string()).chain(numbers);
    let methods = measured.columns.iter().zip(1..).map(|(c, k)| format!("({k}) {}", c.name));
    let unknown = measured.columns.iter().any(|c| c.verdicts.contains(&Kept::Unknown));
    Report::default()
        .table(
            format!("Digits of {} kept by each method", measured.generator.name),
            Table::new(head, rows),
        )
        .notes(methods)
        .notes(unknown.then_some(
            "?: an answer that no exact one stands beside: under unilateral a node opens",
        ))
}
