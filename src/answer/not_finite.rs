//! Floats in files: null stands for one that is not finite, as JSON has none.

use serde::{Deserialize, Deserializer};

/// Reads a float, and NaN from null.
pub fn or_nan<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}
