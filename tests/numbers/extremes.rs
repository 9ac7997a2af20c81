//! The extremes: the whole table against its golden file, and what must not happen in any of its cells.

use std::sync::LazyLock;

use crate::common::golden::assert_golden_by;
use crate::common::tolerances::{EXTREME_DECADES, EXTREME_DIGITS};
use plane_contact::report::extremes as report;
use plane_contact::studies::extremes::{Measured, Verdict, generators, measure};

static MEASURED: LazyLock<Vec<Measured>> = LazyLock::new(|| measure(&generators()));

#[test]
fn the_table_is_the_golden_one() {
    assert_golden_by("extremes", "table", &report::text(&MEASURED), same_table);
}

/// Cells are apart by two blanks or more: digits within a tolerance, powers of ten within another, words to the letter.
fn same_table(expected: &str, value: &str) -> bool {
    let lines = |text: &str| text.trim_end().lines().map(cells).collect::<Vec<_>>();
    let (expected, value) = (lines(expected), lines(value));
    expected.len() == value.len()
        && expected.iter().zip(&value).all(|(e, v)| {
            let same = e.len() == v.len() && e.iter().zip(v).all(|(e, v)| same_cell(e, v));
            if !same {
                eprintln!("expected {e:?}\n     got {v:?}");
            }
            same
        })
}

/// The cells of a line; rules under headings are as wide as their columns, and no cells.
fn cells(line: &str) -> Vec<String> {
    let cells = line.split("  ").map(str::trim).filter(|cell| !cell.is_empty());
    cells.filter(|cell| !cell.chars().all(|c| c == '-') || *cell == "-").map(String::from).collect()
}

fn same_cell(expected: &str, value: &str) -> bool {
    let within = |parse: &dyn Fn(&str) -> Option<f64>, limit: f64| matches!((parse(expected), parse(value)), (Some(e), Some(v)) if (e - v).abs() <= limit);
    expected == value
        || within(&digits, EXTREME_DIGITS.limit)
        || within(&decade, EXTREME_DECADES.limit)
}

/// A number of digits; none where an answer has no right one.
fn digits(cell: &str) -> Option<f64> {
    match cell {
        "WRONG" | "WRONG (no digit)" | "WRONG (locked)" => Some(0.0),
        _ => cell.parse::<usize>().ok().map(|digits| digits as f64),
    }
}

/// The exponent of a power of ten.
fn decade(cell: &str) -> Option<f64> {
    cell.strip_prefix("1e").and_then(|exponent| exponent.parse().ok())
}

#[test]
fn a_table_differs_by_words_and_by_more_than_a_few_digits() {
    assert!(same_table("a  14  1e-8", "a  13  1e-7"));
    assert!(!same_table("a  14  1e-8", "a  9  1e-8"));
    assert!(!same_table("a  14  1e-8", "a  14  1e-2"));
    assert!(!same_table("a  refused (singular)", "a  14"));
    assert!(same_table("a  WRONG", "a  1"));
}

/// The cells of a generator's way, each with its magnitude.
fn column<'a>(generator: &str, way: &str) -> impl Iterator<Item = (f64, &'a Verdict)> {
    let measured = MEASURED.iter().find(|m| m.name == generator).expect("a generator");
    let column = measured.columns.iter().find(|c| c.name == way).expect("a way");
    measured.magnitudes.iter().copied().zip(&column.verdicts)
}

#[test]
fn nothing_is_ever_nan() {
    for of in MEASURED.iter() {
        for column in &of.columns {
            let nan = column.verdicts.contains(&Verdict::Wrong("NaN"));
            assert!(!nan, "{} {}", of.name, column.name);
        }
    }
}

/// Whatever the published variants compute in f64 and f64x2 is right or refused, but where a duplicate inflates weights and where a
/// tolerance of the bodies' own size pairs nodes with edges that they do not face.
#[test]
fn published_variants_are_right_or_refused() {
    for of in MEASURED.iter().filter(|of| !["tolerance", "surfaces"].contains(&of.name)) {
        let published = ["tied", "printed", "stepped"]
            .iter()
            .flat_map(|variant| ["f64", "f64x2"].map(|scalar| format!("{variant} {scalar}")));
        for name in published {
            for column in of.columns.iter().filter(|column| column.name == name) {
                let wrong = column.verdicts.iter().any(|v| matches!(v, Verdict::Wrong(_)));
                assert!(!wrong, "{} {name}", of.name);
            }
        }
    }
}

/// A load that f32 has no number for is refused: zeros are no answer.
#[test]
fn underflow_is_met() {
    for (pressure, verdict) in column("loads", "tied f32").filter(|(p, _)| *p < 1e-39) {
        assert!(matches!(verdict, Verdict::Refused(_)), "{pressure:e}: {verdict}");
    }
}

/// C3: near the vertical the printed formulas lose a digit a decade, and projection on the edge loses none.
#[test]
fn c3_projection_does_not_feel_the_angle() {
    for (angle, verdict) in column("steep-edge", "projected weight f64") {
        assert!(!verdict.breaks_down(14.0), "{angle:e}: {verdict}");
    }
    let lost = column("steep-edge", "weight f64").find(|(angle, _)| *angle == 1e-12);
    assert!(lost.is_some_and(|(_, verdict)| verdict.breaks_down(7.0)), "{lost:?}");
}

/// Lengths and loads in units of their own size are never refused.
#[test]
fn scaling_reaches_every_magnitude() {
    for (generator, way) in
        [("lengths", "tied f64, lengths scaled"), ("loads", "tied f64, loads scaled")]
    {
        for (magnitude, verdict) in column(generator, way) {
            assert!(!verdict.breaks_down(12.0), "{generator} {magnitude:e}: {verdict}");
        }
    }
}
