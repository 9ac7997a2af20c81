//! Floats that are not finite.

use serde::{Deserialize, Deserializer};

/// Returns a number, None where it is not finite.
pub fn finite(x: f64) -> Option<f64> {
    Some(x).filter(|x| x.is_finite())
}

/// Reads a float, and NaN from null: JSON has no number that is not finite.
pub fn or_nan<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}
