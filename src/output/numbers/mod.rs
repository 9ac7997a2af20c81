//! How numbers are written: short and with their units in tables, with the digits that their error
//! leaves them, and typeset in pictures.

mod decimal;
mod digits;
mod typeset;
mod undefined;

pub use decimal::{nearest_round, round_at_most};
pub use digits::{Digits, decimals_of_places, figure, percent};
pub use typeset::{common_exponent, power_of_ten, shifted, significant, ticks};
pub use undefined::reason;

pub use base::plain::six_digits;

/// Writes a whole number as it is, another one with three digits; `-` stands for what is no number.
pub fn short(x: f64) -> String {
    // Added to 0, -0 is 0.
    if x.abs() < 1e9 && x.fract() == 0.0 { format!("{:.0}", x + 0.0) } else { figure(x, None) }
}

/// Writes a whole number as it is, another one with five decimals, and one that is very large or very small
/// in scientific notation; `-` stands for what is no number: an input or a place, of which no digit is to be
/// lost.
pub fn long(x: f64) -> String {
    if !x.is_finite() || x.fract() == 0.0 {
        short(x)
    } else if (1e-3..1e5).contains(&x.abs()) {
        format!("{x:.5}")
    } else {
        format!("{x:.3e}")
    }
}

/// Returns a point as text, `x, y`.
pub fn coordinates([x, y]: [f64; 2], decimals: usize) -> String {
    format!("{}, {}", digits::fixed(x, decimals), digits::fixed(y, decimals))
}

/// Writes what a column or an axis shows and its unit, `arc, mm`; the name alone where the scene
/// names no unit.
pub fn quantity(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.into() } else { format!("{name}, {unit}") }
}

/// Writes a number and its unit, `3 mm`; the number alone where the scene names no unit.
pub fn with_unit(number: &str, unit: &str) -> String {
    if unit.is_empty() { number.into() } else { format!("{number} {unit}") }
}
