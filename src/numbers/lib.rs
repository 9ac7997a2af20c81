//! Numbers: the scalar types that a run may be done in, the largest of several values, numbers that are
//! finite, and what is joined.
#![forbid(unsafe_code)]

pub mod joined;
pub mod largest;
pub mod scalar;

/// Returns a number, None where it is not finite: JSON has no infinity.
pub fn finite(x: f64) -> Option<f64> {
    Some(x).filter(|x| x.is_finite())
}
