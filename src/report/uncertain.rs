//! Numbers printed with no more digits than their error bars leave them.
//!
//! The largest bar decides: it is rounded up, to two digits where the first is 1 or 2 and else to one, and the value is rounded to
//! the place of the bar's last digit: 41.94 with a bar of 2.6 is `41.9 +- 2.6`, with one of 3.1 `42 +- 4`. The other bars are
//! rounded up to one digit.

/// Digits beyond which an `f64` says nothing.
const DIGITS_OF_A_FLOAT: i32 = 17;

/// `value` with its bars: `42 +- 3 MPa (mesh), +- 2e-12 (arithmetic)`.
///
/// Given: the value; its unit, which may be empty; each bar with what it is for, at least one. A bar that is infinite or no number is
/// told in words, and leaves the value two digits: `about 42 MPa, error unknown (mesh)`.
pub fn uncertain(value: f64, unit: &str, bars: &[(f64, &str)]) -> String {
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    if !value.is_finite() || bars.iter().any(|(bar, _)| !bar.is_finite()) {
        let words: Vec<String> =
            bars.iter().map(|(bar, name)| named(*bar, false, "", name)).collect();
        let place = if value == 0.0 { 0 } else { exponent(value) - 1 };
        return format!("about {}{unit}, {}", at_place(value, place), words.join(", "));
    }
    let largest = bars.iter().map(|(bar, _)| bar.abs()).fold(0.0, f64::max);
    let shown = match Rounded::up(largest, true) {
        Some(bar) => at_place(value, bar.place),
        None => shortest(value),
    };
    let unit_once = |k: usize| if k == 0 { unit.as_str() } else { "" };
    let words = bars
        .iter()
        .enumerate()
        .map(|(k, (bar, name))| named(*bar, bar.abs() == largest, unit_once(k), name));
    format!("{shown} {}", words.collect::<Vec<_>>().join(", "))
}

fn named(bar: f64, decides: bool, unit: &str, name: &str) -> String {
    if !bar.is_finite() {
        return format!("error unknown ({name})");
    }
    let bar = Rounded::up(bar.abs(), decides).map_or("0".into(), |bar| bar.text());
    format!("+- {bar}{unit} ({name})")
}

/// digits · 10^place.
struct Rounded {
    digits: u32,
    place: i32,
}

impl Rounded {
    /// The smallest such number that is not below `bar` (to six digits, so that 0.1 + 0.2 is 0.3); nothing for 0. Two digits
    /// where it decides and starts with 1 or 2, else one.
    fn up(bar: f64, decides: bool) -> Option<Self> {
        if bar == 0.0 {
            return None;
        }
        let text = format!("{bar:.5e}");
        let (mantissa, exponent) = split(&text);
        let digits: u32 = mantissa.replace('.', "").parse().expect("six digits");
        let tenths = digits.div_ceil(10_000);
        Some(if decides && tenths < 30 {
            Rounded { digits: tenths, place: exponent - 1 }
        } else {
            Rounded { digits: tenths.div_ceil(10), place: exponent }
        })
    }

    fn text(&self) -> String {
        let value = float(self.digits, self.place);
        let exponent = exponent(value);
        if (-3..6).contains(&exponent) {
            format!("{value:.*}", decimals(self.place))
        } else {
            format!("{value:.*e}", decimals(self.place - exponent))
        }
    }
}

/// `value` rounded to a multiple of 10^place.
fn at_place(value: f64, place: i32) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    let above = exponent(value) - place;
    if value == 0.0 || above < -1 || above == -1 && value.abs() < float(5, place - 1) {
        return zero(place);
    }
    if above == -1 {
        return written(float(1, place).copysign(value), place);
    }
    if above >= DIGITS_OF_A_FLOAT {
        return shortest(value);
    }
    let rounded = format!("{value:.*e}", decimals(-above));
    written(rounded.parse().expect("what was written as a float reads as one"), place)
}

/// 0 down to the place, where that is short.
fn zero(place: i32) -> String {
    format!("{:.*}", if (-6..0).contains(&place) { decimals(place) } else { 0 }, 0.0)
}

/// A multiple of 10^place, without a digit below that place.
fn written(value: f64, place: i32) -> String {
    let exponent = exponent(value);
    if (-4..7).contains(&exponent) {
        format!("{value:.*}", decimals(place))
    } else {
        format!("{value:.*e}", decimals(place - exponent))
    }
}

fn shortest(value: f64) -> String {
    if value == 0.0 || (-4..7).contains(&exponent(value)) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Decimals down to a place: 2 for −2.
fn decimals(place: i32) -> usize {
    usize::try_from(-place).unwrap_or(0)
}

/// The float nearest to digits · 10^place.
fn float(digits: u32, place: i32) -> f64 {
    format!("{digits}e{place}").parse().expect("digits and an exponent are a float")
}

/// Decimal exponent of a number, 0 for 0 and what is not finite.
fn exponent(x: f64) -> i32 {
    if x.is_finite() { split(&format!("{x:e}")).1 } else { 0 }
}

fn split(scientific: &str) -> (&str, i32) {
    let (mantissa, exponent) = scientific.split_once('e').expect("scientific notation");
    (mantissa, exponent.parse().expect("an exponent"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(value: f64, bar: f64) -> String {
        uncertain(value, "", &[(bar, "mesh")]).replace(" (mesh)", "")
    }

    #[test]
    fn the_larger_bar_decides() {
        let bars = [(3.0, "mesh"), (2e-12, "arithmetic")];
        assert_eq!(uncertain(41.95, "MPa", &bars), "42 +- 3 MPa (mesh), +- 2e-12 (arithmetic)");
        let bars = [(2e-12, "arithmetic"), (0.31, "mesh")];
        assert_eq!(uncertain(41.95, "MPa", &bars), "42.0 +- 2e-12 MPa (arithmetic), +- 0.4 (mesh)");
    }

    #[test]
    fn bars_are_rounded_up_to_one_digit_or_two() {
        let cases = [
            (2.6, "41.9 +- 2.6"),
            (2.61, "41.9 +- 2.7"),
            (2.99, "42 +- 3"),
            (3.1, "42 +- 4"),
            (9.5, "42 +- 10"),
            (0.1 + 0.2, "41.9 +- 0.3"),
            (0.0123, "41.940 +- 0.013"),
            (12.3, "42 +- 13"),
        ];
        for (bar, text) in cases {
            assert_eq!(one(41.94, bar), text, "{bar}");
        }
    }

    #[test]
    fn bars_larger_than_the_value() {
        let cases = [
            (3.0, 40.0, "0 +- 40"),
            (6.0, 40.0, "10 +- 40"),
            (-6.0, 40.0, "-10 +- 40"),
            (-3.0, 40.0, "0 +- 40"),
            (0.004, 0.05, "0.00 +- 0.05"),
            (1e-300, 1e300, "0 +- 1.0e300"),
            (0.0, 4e-9, "0 +- 4e-9"),
        ];
        for (value, bar, text) in cases {
            assert_eq!(one(value, bar), text, "{value} {bar}");
        }
    }

    #[test]
    fn rounding_that_carries() {
        assert_eq!(one(99.96, 0.4), "100.0 +- 0.4");
        assert_eq!(one(9.96e-8, 4e-10), "9.96e-8 +- 4e-10");
        assert_eq!(one(9.996e-8, 4e-10), "1.000e-7 +- 4e-10");
        assert_eq!(one(1234.0, 400.0), "1200 +- 400");
        assert_eq!(one(2.346e9, 4e7), "2.35e9 +- 4e7");
    }

    #[test]
    fn bars_of_zero_leave_the_value_as_it_is() {
        assert_eq!(one(41.95, 0.0), "41.95 +- 0");
        assert_eq!(one(0.0, 0.0), "0 +- 0");
        assert_eq!(one(2.5e-300, 0.0), "2.5e-300 +- 0");
    }

    #[test]
    fn no_digit_beyond_those_of_a_float() {
        assert_eq!(one(0.1, 1e-30), "0.1 +- 1.0e-30");
        assert_eq!(one(41.95, 2e-12), "41.9500000000000 +- 2.0e-12");
    }

    #[test]
    fn an_unknown_error_is_told_in_words() {
        let bars = [(f64::INFINITY, "mesh"), (2e-12, "arithmetic")];
        let text = "about 42 MPa, error unknown (mesh), +- 2e-12 (arithmetic)";
        assert_eq!(uncertain(41.95, "MPa", &bars), text);
        assert_eq!(one(0.0, f64::NAN), "about 0, error unknown");
        assert_eq!(one(f64::INFINITY, 1.0), "about inf, +- 1");
    }
}
