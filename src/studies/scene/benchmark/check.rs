//! Checks of the parameters of benchmarks.

use base::error::{InputError, Result};
use base::plain::six_digits;

/// The most divisions of a side: a square of so many is generated and written in 1.8 GB.
const MOST: usize = 1000;

/// Checks that a number of divisions lies in `least ..= MOST`.
pub fn count(parameter: &str, n: usize, least: usize) -> Result<()> {
    if (least..=MOST).contains(&n) {
        return Ok(());
    }
    let what = format!("{n} divisions are outside {least} .. {MOST}");
    Err(InputError::new(parameter, what, format!("give a number from {least} to {MOST}")))
}

/// Checks that a length, load or modulus is positive and finite.
pub fn positive(parameter: &str, x: f64) -> Result<()> {
    if x > 0.0 && x.is_finite() {
        return Ok(());
    }
    Err(InputError::new(
        parameter,
        format!("{} is not positive", six_digits(x)),
        "give a number above 0",
    ))
}

/// Checks that a ratio lies in a range.
pub fn between(parameter: &str, x: f64, [least, most]: [f64; 2]) -> Result<()> {
    if (least..=most).contains(&x) {
        return Ok(());
    }
    let what = format!("{} is outside {least} .. {most}", six_digits(x));
    Err(InputError::new(parameter, what, format!("give a number from {least} to {most}")))
}
