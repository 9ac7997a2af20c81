//! Checks of the parameters of benchmarks.

use base::error::{InputError, Result};
use base::memory;
use base::plain::six_digits;

/// More divisions of a side than anybody has memory for.
const MOST: usize = 2000;

/// The bytes of a triangle of a mesh that is generated and written.
const TRIANGLE: f64 = 900.0;

/// Checks that a number of divisions lies in `least ..= MOST`, and that a square of so many fits in
/// memory.
pub fn count(parameter: &str, n: usize, least: usize) -> Result<()> {
    if (least..=MOST).contains(&n) {
        let bytes = TRIANGLE * 2.0 * (n * n) as f64;
        let whose = format!("{n} divisions");
        return memory::check_bytes(bytes, parameter, &whose, "give a smaller number");
    }
    let what = format!("{n} divisions are outside {least} .. {MOST}");
    Err(InputError::new(parameter, what, format!("give a number from {least} to {MOST}")))
}

/// Checks that a number of divisions is even too: a node must stand in the middle.
///
/// # Errors
/// It is odd, or outside the range of [`count`].
pub fn even(parameter: &str, n: usize) -> Result<()> {
    count(parameter, n, 2)?;
    if n.is_multiple_of(2) {
        return Ok(());
    }
    let what = format!("{n} divisions leave no node in the middle, where the body is restrained");
    Err(InputError::new(parameter, what, format!("give an even number, such as {}", n + 1)))
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
