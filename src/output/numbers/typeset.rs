//! Numbers as the pictures write them: a true minus sign, and powers of ten raised.

use super::decimal::{decimals, exponent, round_at_most, split};

/// Returns the multiples of a round number from `low` to `high` (`low` < `high`), four to nine of
/// them, as value and text.
pub fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    const SLACK: f64 = 1e-9;
    let step = round_at_most((high - low) / 3.2);
    let first = (low / step - SLACK).ceil() as i64;
    let last = (high / step + SLACK).floor() as i64;
    let tick = |index: i64| {
        let value = index as f64 * step;
        (value, minus(&format!("{value:.*}", decimals(exponent(step)))))
    };
    (first..=last).map(tick).collect()
}

/// Writes `x` with so many significant digits, without trailing zeros; a very large or a very small
/// one as 2.5·10⁻⁷.
pub fn significant(x: f64, digits: usize) -> String {
    let rounded = format!("{x:.*e}", digits - 1);
    let (mantissa, exponent) = split(&rounded);
    if x == 0.0 || (-3..6).contains(&exponent) {
        let value: f64 = rounded.parse().expect("what was written as a float reads as one");
        return minus(&value.to_string());
    }
    let mantissa: f64 = mantissa.parse().expect("a mantissa");
    match mantissa {
        1.0 => power_of_ten(exponent),
        -1.0 => format!("−{}", power_of_ten(exponent)),
        _ => minus(&format!("{mantissa}·{}", power_of_ten(exponent))),
    }
}

/// Writes 10⁻³ for −3.
pub fn power_of_ten(exponent: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        _ => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c as usize - '0' as usize).expect("a decimal digit"),
    };
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

/// Returns the exponent to take out of numbers of this size: 0 if handy, else a multiple of 3.
pub fn common_exponent(largest: f64) -> i32 {
    let exponent = exponent(largest);
    if (-2..5).contains(&exponent) { 0 } else { exponent.div_euclid(3) * 3 }
}

/// Returns x·10ⁿ, in two steps: 10ⁿ itself may lie outside the range of floats.
pub fn shifted(x: f64, exponent: i32) -> f64 {
    let half = exponent / 2;
    x * 10_f64.powi(half) * 10_f64.powi(exponent - half)
}

/// Returns the text with a true minus sign, and without one before zero.
fn minus(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| "0.".contains(c)) => String::from(rest),
        Some(rest) => format!("−{rest}"),
        None => String::from(text),
    }
}
