//! The extremes: the whole table against its golden file, and what must not happen in any of its
//! cells.

use std::sync::LazyLock;

use crate::common::golden_file::assert_text;
use plane_contact::studies::extremes::digit_tables as report;
use plane_contact::studies::extremes::{Column, GENERATORS, Kept, SweepTable, measure};

testing::tolerances! {
    /// The exponent of a breaking point of `extremes`.
    EXTREME_DECADES = 1.0,
        "half a digit more or less moves the point where three are left by half a decade; it is bisected to half of \
         one, and rounded";
    /// Right digits in a cell of `extremes`, before they are cut off to whole ones.
    EXTREME_DIGITS = 0.5,
        "the LU library sums in another order on another processor: an error may be three times larger or smaller by \
         chance";
}

fn text(measured: &[SweepTable]) -> String {
    report::report(measured).text(usize::MAX)
}

static MEASURED: LazyLock<Vec<SweepTable>> =
    LazyLock::new(|| measure(&GENERATORS.iter().collect::<Vec<_>>()));

#[test]
fn the_table_is_the_golden_one() {
    assert_text("golden/extremes/table.snap", &text(&MEASURED), |golden, table| {
        let near = [-1.0, 1.0].map(|side| text(&moved(side * EXTREME_DIGITS.limit)));
        same_table(golden, [table, &near[0], &near[1]])
    });
}

/// What was measured, with `by` more right digits wherever some are right.
fn moved(by: f64) -> Vec<SweepTable> {
    let mut measured = MEASURED.clone();
    for Column { verdicts, below, above, .. } in measured.iter_mut().flat_map(|m| &mut m.columns) {
        let breaks = below.iter_mut().chain(above).map(|at| &mut at.verdict);
        for verdict in verdicts.iter_mut().chain(breaks) {
            if let Kept::Digits(digits) = verdict {
                *digits += by;
            }
        }
    }
    measured
}

/// Whether a table is the golden one. `tables`: it, and what it would be with a little fewer and a
/// little more right digits. Cells are apart by two blanks or more. Each is to the letter that of
/// one of the three, or a power of ten within a tolerance; the first of a line, its name, to the
/// letter.
fn same_table(golden: &str, tables: [&str; 3]) -> bool {
    let lines = |text: &str| text.trim_end().lines().map(cells).collect::<Vec<_>>();
    let (golden, tables) = (lines(golden), tables.map(lines));
    let same_line = |(k, expected): (usize, &Vec<String>)| {
        let lines = tables.each_ref().map(|table| &table[k]);
        let same_cell = |(j, cell): (usize, &String)| {
            lines.iter().any(|line| line[j] == *cell) || j > 0 && same_decade(cell, &lines[0][j])
        };
        let same = expected.len() == lines[0].len() && expected.iter().enumerate().all(same_cell);
        if !same {
            eprintln!("expected {expected:?}\n     got {:?}", lines[0]);
        }
        same
    };
    golden.len() == tables[0].len() && golden.iter().enumerate().all(same_line)
}

/// The cells of a line; rules under headings are as wide as their columns, and no cells.
fn cells(line: &str) -> Vec<String> {
    let cells = line.split("  ").map(str::trim).filter(|cell| !cell.is_empty());
    cells.filter(|cell| !cell.chars().all(|c| c == '-') || *cell == "-").map(String::from).collect()
}

/// Whether two cells are powers of ten within a tolerance.
fn same_decade(expected: &str, value: &str) -> bool {
    let exponent = |cell: &str| cell.strip_prefix("1e").and_then(|text| text.parse::<f64>().ok());
    let exponents = exponent(expected).zip(exponent(value));
    exponents.is_some_and(|(e, v)| (e - v).abs() <= EXTREME_DECADES.limit)
}

#[test]
fn a_table_differs_by_words_and_by_more_than_half_a_digit() {
    let same = |expected: &str, value: &str| same_table(expected, [value; 3]);
    assert!(same_table("a  14", ["a  13", "a  13", "a  14"]), "13.6 digits");
    assert!(!same_table("a  14", ["a  13", "a  12", "a  13"]), "13.4 digits");
    assert!(same("a  14  1e-8", "a  14  1e-7"));
    assert!(!same("a  14  1e-8", "a  14  1e-6"));
    assert!(!same("1e-8  14", "1e-7  14"), "another magnitude");
    for (expected, value) in [
        ("a  2", "a  WRONG"),
        ("a  WRONG", "a  1"),
        ("a  exact", "a  16"),
        ("a  refused (singular)", "a  14"),
        ("a  refused (singular)", "a  WRONG (no digit)"),
        ("a  WRONG (locked)", "a  WRONG (no digit)"),
        ("a  1e-8", "a  -"),
    ] {
        assert!(!same(expected, value), "{expected} {value}");
    }
}

/// A digit and a half off in every cell is another table, and so is a golden one whose kinds are
/// others.
#[test]
fn a_table_that_is_off_is_told() {
    let [fewer, table, more] = [1.0, 1.5, 2.0].map(|by| text(&moved(by)));
    let golden = text(&MEASURED);
    assert!(same_table(&golden, [&golden; 3]));
    assert!(!same_table(&golden, [&table, &fewer, &more]));
    assert!(!same_table(&golden.replacen("WRONG", "1", 1), [&golden; 3]));
}

/// The cells of a generator's way, each with its magnitude.
fn column<'a>(generator: &str, way: &str) -> impl Iterator<Item = (f64, &'a Kept)> {
    let measured = MEASURED.iter().find(|m| m.generator.name == generator).expect("a generator");
    let column = measured.columns.iter().find(|c| c.name == way).expect("a way");
    measured.magnitudes.iter().copied().zip(&column.verdicts)
}

#[test]
fn nothing_is_ever_nan() {
    for of in MEASURED.iter() {
        for column in &of.columns {
            let nan = column.verdicts.contains(&Kept::Wrong("NaN"));
            assert!(!nan, "{} {}", of.generator.name, column.name);
        }
    }
}

/// Whatever the published variants compute in f64 and f64x2 is right or refused.
#[test]
fn published_variants_are_right_or_refused() {
    for of in MEASURED.iter() {
        let published = ["tied", "printed"]
            .iter()
            .flat_map(|variant| ["f64", "f64x2"].map(|scalar| format!("{variant} {scalar}")));
        for name in published {
            for column in of.columns.iter().filter(|column| column.name == name) {
                let wrong = column.verdicts.iter().any(|v| matches!(v, Kept::Wrong(_)));
                assert!(!wrong, "{} {name}", of.generator.name);
            }
        }
    }
}

/// A load that f32 has no number for is refused: zeros are no answer.
#[test]
fn underflow_is_met() {
    for (pressure, verdict) in column("loads", "tied f32").filter(|(p, _)| *p < 1e-39) {
        assert!(matches!(verdict, Kept::Refused(_)), "{pressure:e}: {verdict}");
    }
}

/// C3: near the vertical the printed distance loses a digit a decade, and that along the normal none.
#[test]
fn c3_the_normal_distance_does_not_feel_the_angle() {
    for (angle, verdict) in column("steep-edge", "normal gap f64") {
        assert!(!verdict.breaks_down(14.0), "{angle:e}: {verdict}");
    }
    let lost = column("steep-edge", "yt f64").find(|(angle, _)| *angle == 1e-12);
    assert!(lost.is_some_and(|(_, verdict)| verdict.breaks_down(7.0)), "{lost:?}");
}
