//! Round numbers, and how the pictures write numbers. Everything holds from 1e-300 to 1e300.

use std::fmt;

/// 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Round {
    digit: u8,
    exponent: i32,
}

impl Round {
    /// 1.
    pub const ONE: Self = Self { digit: 1, exponent: 0 };

    /// The round number nearest to `x` > 0 as a ratio.
    pub fn nearest(x: f64) -> Self {
        Self::with_limits(x, [2.0, 10.0, 50.0].map(f64::sqrt))
    }

    /// The largest round number that is at most `x` > 0.
    pub fn at_most(x: f64) -> Self {
        Self::with_limits(x, [2.0, 5.0, 10.0])
    }

    /// From which mantissa on the next round number is taken: 2, 5 and 10 in turn.
    fn with_limits(x: f64, limits: [f64; 3]) -> Self {
        let (mantissa, exponent) = split(x);
        match limits.iter().filter(|&&limit| mantissa >= limit).count() {
            0 => Self { digit: 1, exponent },
            1 => Self { digit: 2, exponent },
            2 => Self { digit: 5, exponent },
            _ => Self { digit: 1, exponent: exponent + 1 },
        }
    }

    /// The float nearest to the number.
    pub fn value(self) -> f64 {
        format!("{}e{}", self.digit, self.exponent)
            .parse()
            .expect("a digit and an exponent are a float")
    }

    /// The decimals that its multiples need.
    pub fn decimals(self) -> usize {
        usize::try_from(-self.exponent).unwrap_or(0)
    }
}

impl fmt::Display for Round {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&significant(self.value(), 1))
    }
}

/// The multiples of a round number from `low` to `high` (`low` < `high`), four to nine of them, as value and text.
pub fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    let step = Round::at_most((high - low) / 3.2);
    let slack = 1e-9;
    let first = (low / step.value() - slack).ceil() as i64;
    let last = (high / step.value() + slack).floor() as i64;
    let tick = |index: i64| {
        let value = index as f64 * step.value();
        (value, fixed(value, step.decimals()))
    };
    (first..=last).map(tick).collect()
}

/// `x` with a fixed number of decimals, a true minus sign and no minus before zero.
pub fn fixed(x: f64, decimals: usize) -> String {
    minus(&format!("{x:.decimals$}"))
}

/// `x` with so many significant digits, without trailing zeros; very large and small ones as 2.5·10⁻⁷.
pub fn significant(x: f64, digits: usize) -> String {
    let rounded = format!("{x:.*e}", digits - 1);
    let (mantissa, exponent) = parts(&rounded);
    if x == 0.0 || (-3..6).contains(&exponent) {
        let value: f64 = rounded.parse().expect("what was written as a float reads as one");
        return minus(&value.to_string());
    }
    match mantissa {
        1.0 => power_of_ten(exponent),
        -1.0 => format!("−{}", power_of_ten(exponent)),
        _ => minus(&format!("{mantissa}·{}", power_of_ten(exponent))),
    }
}

/// 10⁻³ for −3.
pub fn power_of_ten(exponent: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        _ => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c as usize - '0' as usize).expect("a decimal digit"),
    };
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

/// The exponent to take out of numbers of this size: 0 for handy ones, else a multiple of three.
pub fn common_exponent(largest: f64) -> i32 {
    let (_, exponent) = split(largest);
    let handy = largest == 0.0 || (-2..5).contains(&exponent);
    if handy { 0 } else { exponent.div_euclid(3) * 3 }
}

/// x·10ⁿ in two steps, so that 10ⁿ itself may lie outside the range of floats.
pub fn shifted(x: f64, exponent: i32) -> f64 {
    let half = exponent / 2;
    x * 10_f64.powi(half) * 10_f64.powi(exponent - half)
}

/// Mantissa (1 ≤ |m| < 10) and decimal exponent, exactly as the shortest decimal text has them; zero gives 0 and 0.
fn split(x: f64) -> (f64, i32) {
    parts(&format!("{x:e}"))
}

fn parts(scientific: &str) -> (f64, i32) {
    let (mantissa, exponent) =
        scientific.split_once('e').expect("a finite number in scientific notation");
    (mantissa.parse().expect("a mantissa"), exponent.parse().expect("an exponent"))
}

/// The text with a true minus sign, and without one before zero.
fn minus(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| "0.".contains(c)) => String::from(rest),
        Some(rest) => format!("−{rest}"),
        None => String::from(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(low: f64, high: f64) -> Vec<String> {
        ticks(low, high).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn nearest_round_number() {
        let cases = [
            (1.0, 1.0),
            (1.5, 2.0),
            (120.0, 100.0),
            (0.034, 0.05),
            (8.0, 10.0),
            (3e299, 2e299),
            (3e-300, 2e-300),
        ];
        for (x, expected) in cases {
            assert_eq!(Round::nearest(x).value(), expected, "{x}");
        }
    }

    #[test]
    fn largest_round_number_below() {
        for (x, expected) in
            [(1.99, 1.0), (2.0, 2.0), (12.5, 10.0), (0.7, 0.5), (9.99e-301, 5e-301)]
        {
            assert_eq!(Round::at_most(x).value(), expected, "{x}");
        }
    }

    #[test]
    fn ticks_are_round() {
        assert_eq!(texts(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(texts(-7.0, 12.3), ["−5", "0", "5", "10"]);
        assert_eq!(
            texts(100.001, 100.002),
            ["100.0010", "100.0012", "100.0014", "100.0016", "100.0018", "100.0020"]
        );
    }

    #[test]
    fn tick_count() {
        for tenths in 10..=100 {
            let count = ticks(0.0, f64::from(tenths) / 10.0).len();
            assert!((4..=9).contains(&count), "{count} ticks up to {tenths}/10");
        }
    }

    #[test]
    fn significant_digits() {
        let written = [0.0, -0.0, 12.3456, -250.0, 1e5, 2.5e-7, -1e300, 1e6, 123_456_789.0]
            .map(|x| significant(x, 4));
        assert_eq!(
            written,
            ["0", "0", "12.35", "−250", "100000", "2.5·10⁻⁷", "−10³⁰⁰", "10⁶", "1.235·10⁸"]
        );
    }

    #[test]
    fn common_exponents() {
        let cases = [
            (0.0, 0),
            (0.02, 0),
            (99_999.0, 0),
            (2.1e-4, -6),
            (6.3e6, 6),
            (1e300, 300),
            (1e-300, -300),
        ];
        for (largest, expected) in cases {
            assert_eq!(common_exponent(largest), expected, "{largest}");
        }
    }

    #[test]
    fn shifts_out_of_range() {
        assert!((shifted(3e-300, 300) - 3.0).abs() < 1e-12);
        assert!((shifted(3e-320, 320) - 3.0).abs() < 1e-3);
    }
}
