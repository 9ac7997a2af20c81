//! Golden files, `golden/<scene>/<name>.snap`, exact for integers and words, toleranced for floats.

use crate::golden::assert_golden_by;
use crate::tolerances::Tolerance;

/// Floats of golden files, relative to the largest float of their line.
const GOLDEN: Tolerance = Tolerance {
    limit: 1e-9,
    reason: "the LU library sums in another order on another processor: 1e-16 times a condition \
         number of 1e5 (strand), and two decades of room; integers and statuses are exact",
};

/// Floats of golden files, absolute, in the scene's length unit.
const GOLDEN_FLOOR: Tolerance = Tolerance {
    limit: 1e-13,
    reason: "yt is a difference of coordinates of order 10, each rounded at 2e-15: on the strand it \
         is 0 but for that where a stamp node lies on its target edge",
};

/// Compares `text` with `golden/<folder>/<name>.snap`; `cargo insta review` (or
/// INSTA_UPDATE=always) changes it.
#[track_caller]
pub fn assert_golden(folder: &str, name: &str, text: &str) {
    assert_golden_by(folder, name, text, same_text);
}

/// Words equal to the letter, floats (a `.` or an exponent in them) within `GOLDEN` of the largest
/// float of their line, or within `GOLDEN_FLOOR`.
pub fn same_text(expected: &str, value: &str) -> bool {
    let (expected, value) = (expected.trim_end(), value.trim_end());
    expected.lines().count() == value.lines().count()
        && expected.lines().zip(value.lines()).all(|(e, v)| same_line(e, v))
}

fn same_line(expected: &str, value: &str) -> bool {
    let scale = expected.split_whitespace().filter_map(float).fold(0.0, |m: f64, x| m.max(x.abs()));
    expected.split_whitespace().count() == value.split_whitespace().count()
        && expected
            .split_whitespace()
            .zip(value.split_whitespace())
            .all(|(e, v)| same_word(e, v, scale))
}

fn same_word(expected: &str, value: &str, scale: f64) -> bool {
    if expected == value {
        return true;
    }
    // A float that came out as exactly 0 is printed without a point.
    let number = |word: &str| if word == "0" { Some(0.0) } else { float(word) };
    let (Some(e), Some(v)) = (number(expected), number(value)) else { return false };
    let (error, limit) = ((e - v).abs(), GOLDEN_FLOOR.limit.max(GOLDEN.limit * scale));
    if error > limit {
        eprintln!(
            "value {v:e}, expected {e:e}, error {error:e}, limit {limit:e} ({})",
            GOLDEN.reason
        );
    }
    error <= limit
}

fn float(word: &str) -> Option<f64> {
    if word.contains(['.', 'e']) { word.parse().ok() } else { None }
}
