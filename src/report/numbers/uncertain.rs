//! Numbers written with no more digits than their errors leave them.
//!
//! The largest error decides: it is rounded up, to two digits where the first is 1 or 2 and else to
//! one, and the value is rounded to the place of the error's last digit: 41.94 with an error of 2.6
//! is `41.9 +- 2.6`, with one of 3.1 `42 +- 4`. The other errors are rounded up to one digit.

use std::ops::Range;

use super::decimal::{Decimal, decimals, exponent};
use super::with_unit;

/// Digits beyond which an `f64` says nothing.
const DIGITS_OF_A_FLOAT: i32 = 17;

/// Exponents of the errors that are written without a power of ten.
const HANDY_ERRORS: Range<i32> = -3..6;

/// Exponents of the values that are written without a power of ten.
const HANDY_VALUES: Range<i32> = -4..7;

/// Writes `value` with its errors: `42 +- 3 MPa (mesh), +- 2e-12 (arithmetic)`.
///
/// Given are the value; its unit, which may be empty; and each error, in that unit, with its
/// source, at least one. An error that is infinite or no number is told in words, and leaves the
/// value two digits: `about 42 MPa, error unknown (mesh)`.
pub fn uncertain(value: f64, unit: &str, errors: &[(f64, &str)]) -> String {
    let known = value.is_finite() && errors.iter().all(|(error, _)| error.is_finite());
    let largest = errors.iter().map(|(error, _)| error.abs()).fold(0.0, f64::max);
    let told = |(k, (error, source)): (usize, &(f64, &str))| {
        if !error.is_finite() {
            return format!("error unknown ({source})");
        }
        let rounded = Decimal::at_least(error.abs(), known && error.abs() == largest);
        let rounded = rounded.map_or("0".into(), |r| to_place(r.value(), r.place(), HANDY_ERRORS));
        let unit = if known && k == 0 { unit } else { "" };
        format!("+- {} ({source})", with_unit(&rounded, unit))
    };
    let told = errors.iter().enumerate().map(told).collect::<Vec<_>>().join(", ");
    if !known {
        let place = if value == 0.0 { 0 } else { exponent(value) - 1 };
        return format!("about {}, {told}", with_unit(&at_place(value, place), unit));
    }
    let shown = match Decimal::at_least(largest, true) {
        Some(error) => at_place(value, error.place()),
        None => shortest(value),
    };
    format!("{shown} {told}")
}

/// Writes `value` rounded to a multiple of 10^place.
fn at_place(value: f64, place: i32) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    let unit = |digit: u32, place: i32| -> f64 {
        format!("{digit}e{place}").parse().expect("a digit and an exponent are a float")
    };
    let above = exponent(value) - place;
    if value == 0.0 || above < -1 || above == -1 && value.abs() < unit(5, place - 1) {
        let short = (-6..0).contains(&place);
        return format!("{:.*}", if short { decimals(place) } else { 0 }, 0.0);
    }
    if above == -1 {
        return to_place(unit(1, place).copysign(value), place, HANDY_VALUES);
    }
    if above >= DIGITS_OF_A_FLOAT {
        return shortest(value);
    }
    let rounded = format!("{value:.*e}", decimals(-above));
    let value = rounded.parse().expect("what was written as a float reads as one");
    to_place(value, place, HANDY_VALUES)
}

/// Writes a multiple of 10^place without a digit below that place, in scientific notation unless
/// its exponent is one of `handy`.
fn to_place(value: f64, place: i32, handy: Range<i32>) -> String {
    match exponent(value) {
        exponent if handy.contains(&exponent) => format!("{value:.*}", decimals(place)),
        exponent => format!("{value:.*e}", decimals(place - exponent)),
    }
}

/// Writes the digits that read back to the same float.
fn shortest(value: f64) -> String {
    match HANDY_VALUES.contains(&exponent(value)) {
        true => format!("{value}"),
        false => format!("{value:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_decides_the_digits() {
        for (value, error, text) in [
            (41.94, 2.6, "41.9 +- 2.6"),
            (41.94, 2.61, "41.9 +- 2.7"),
            (41.94, 2.99, "42 +- 3"),
            (41.94, 3.1, "42 +- 4"),
            (41.94, 9.5, "42 +- 10"),
            (41.94, 0.1 + 0.2, "41.9 +- 0.3"),
            (41.94, 0.0123, "41.940 +- 0.013"),
            (41.94, 12.3, "42 +- 13"),
            // Errors larger than the value.
            (3.0, 40.0, "0 +- 40"),
            (6.0, 40.0, "10 +- 40"),
            (-6.0, 40.0, "-10 +- 40"),
            (-3.0, 40.0, "0 +- 40"),
            (0.004, 0.05, "0.00 +- 0.05"),
            (1e-300, 1e300, "0 +- 1.0e300"),
            (0.0, 4e-9, "0 +- 4e-9"),
            // Rounding that carries.
            (99.96, 0.4, "100.0 +- 0.4"),
            (9.96e-8, 4e-10, "9.96e-8 +- 4e-10"),
            (9.996e-8, 4e-10, "1.000e-7 +- 4e-10"),
            (1234.0, 400.0, "1200 +- 400"),
            (2.346e9, 4e7, "2.35e9 +- 4e7"),
            // An error of zero leaves the value as it is.
            (41.95, 0.0, "41.95 +- 0"),
            (0.0, 0.0, "0 +- 0"),
            (2.5e-300, 0.0, "2.5e-300 +- 0"),
            // No digit beyond those of a float.
            (0.1, 1e-30, "0.1 +- 1.0e-30"),
            (41.95, 2e-12, "41.9500000000000 +- 2.0e-12"),
            // What is not known is told in words.
            (0.0, f64::NAN, "about 0, error unknown"),
            (f64::INFINITY, 1.0, "about inf, +- 1"),
        ] {
            let written = uncertain(value, "", &[(error, "mesh")]);
            assert_eq!(written, format!("{text} (mesh)"), "{value} {error}");
        }
    }

    #[test]
    fn the_larger_error_decides() {
        for (mesh, text) in [
            (3.0, "42 +- 3 MPa (mesh), +- 2e-12 (arithmetic)"),
            (0.31, "42.0 +- 0.4 MPa (mesh), +- 2e-12 (arithmetic)"),
            (1e-12, "41.9500000000000 +- 1e-12 MPa (mesh), +- 2.0e-12 (arithmetic)"),
            (f64::INFINITY, "about 42 MPa, error unknown (mesh), +- 2e-12 (arithmetic)"),
        ] {
            let errors = [(mesh, "mesh"), (2e-12, "arithmetic")];
            assert_eq!(uncertain(41.95, "MPa", &errors), text);
        }
    }
}
