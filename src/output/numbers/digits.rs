//! How many digits a number is written with: those that its error leaves. Files have all.

use super::decimal::{decimals, exponent};

/// The digits of a number whose error is not known.
const UNKNOWN: i32 = 3;

/// The least digits, and the most, that are written for people.
const LEAST: i32 = 2;
const MOST: i32 = 6;

/// The exponents of numbers that are written without a power of ten.
const HANDY: std::ops::Range<i32> = -3..6;

/// How the numbers of a column are written, or one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// With so many decimals.
    Decimals(usize),
    /// With so many decimals before a power of ten.
    Scientific(usize),
}

impl Digits {
    /// Returns how numbers up to `largest` are written that are known to the part `error` of it: down to the
    /// place of the first digit of the error, and with three digits where that is not known.
    ///
    /// ```text
    /// 36.77, error 0.17 -> 37        36.77, error 0.012 -> 36.8        36.77, error unknown -> 36.8
    /// ```
    pub fn of(largest: f64, error: Option<f64>) -> Self {
        let size = exponent(largest);
        let known = error.map_or(UNKNOWN, |error| match error * largest.abs() {
            0.0 => MOST,
            error => size - exponent(error) + 1,
        });
        let digits = known.clamp(LEAST, MOST);
        let place = size - digits + 1;
        // Without a power of ten at most one digit stands below the place.
        match HANDY.contains(&size) && place <= 1 {
            true => Digits::Decimals(decimals(place)),
            false => Digits::Scientific(decimals(1 - digits)),
        }
    }

    /// Writes a number so; what is rounded to nothing has no sign.
    pub fn write(self, x: f64) -> String {
        if x == 0.0 {
            return "0".into();
        }
        match self {
            Digits::Decimals(n) => fixed(x, n),
            Digits::Scientific(n) => format!("{x:.n$e}"),
        }
    }
}

/// Returns the decimals of places in bodies of a size: four digits of it.
pub fn decimals_of_places(size: f64) -> usize {
    (4.0 - size.log10()).ceil().clamp(0.0, 12.0) as usize
}

/// Writes a number with so many decimals; what is rounded to nothing has no sign.
pub fn fixed(x: f64, decimals: usize) -> String {
    let shown = format!("{x:.decimals$}");
    let is_zero = shown.chars().all(|c| "-0.".contains(c));
    if is_zero { shown.trim_start_matches('-').into() } else { shown }
}

/// Writes a number with the digits that its relative error leaves ([`Digits::of`]); `-` stands for what is no
/// number.
pub fn figure(x: f64, error: Option<f64>) -> String {
    if x.is_finite() { Digits::of(x, error).write(x) } else { "-".into() }
}

/// Writes a part of 1 in per cent, with two digits and at most two decimals: 0.125 is `13 %`; `-` stands for
/// what is no number.
pub fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    if !percent.is_finite() {
        return "-".into();
    }
    let digits = Digits::Decimals(decimals(exponent(percent) - 1).min(2));
    format!("{} %", digits.write(percent))
}
