//! Numbers written with no more digits than their errors leave them.
//!
//! The error is rounded up, to two digits where the first is 1 or 2 and else to one, and the value is
//! rounded to the place of the error's last digit: 41.94 with an error of 2.6 is `41.9 +- 2.6`, with one of
//! 3.1 `42 +- 4`.

use std::ops::Range;

use super::decimal::{Decimal, decimals, exponent};
use super::with_unit;

/// Digits beyond which an `f64` says nothing.
const DIGITS_OF_A_FLOAT: i32 = 17;

/// Exponents of the errors that are written without a power of ten.
const HANDY_ERRORS: Range<i32> = -3..6;

/// Exponents of the values that are written without a power of ten.
const HANDY_VALUES: Range<i32> = -4..7;

/// Writes `value`, in a unit that may be empty, with what rounding may do to it: `42 +- 3 MPa
/// (arithmetic)`. An error of None is unknown, which is said in words and leaves the value two digits:
/// `about 42 MPa, error unknown (arithmetic)`.
pub fn uncertain(value: f64, unit: &str, error: Option<f64>) -> String {
    let Some(error) = error.filter(|_| value.is_finite()) else {
        let place = if value == 0.0 { 0 } else { exponent(value) - 1 };
        let about = with_unit(&at_place(value, place), unit);
        return format!("about {about}, error unknown (arithmetic)");
    };
    let (shown, error) = match Decimal::at_least(error.abs(), true) {
        Some(error) => {
            let place = error.last_place();
            (at_place(value, place), to_place(error.value(), place, HANDY_ERRORS))
        }
        None => (shortest(value), "0".into()),
    };
    format!("{shown} +- {} (arithmetic)", with_unit(&error, unit))
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
