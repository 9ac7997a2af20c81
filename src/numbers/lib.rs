//! Numbers: the scalar types that a run may be done in, sparse matrices and their factors, the largest of
//! several values, numbers that are finite, and what is joined.
#![forbid(unsafe_code)]

pub mod joined;
pub mod largest;
#[cfg(feature = "sparse")]
pub mod ordering;
pub mod scalar;
#[cfg(feature = "sparse")]
pub mod sparse_lu;
pub mod square;

/// Returns a number, None where it is not finite: JSON has no infinity.
pub fn finite(x: f64) -> Option<f64> {
    Some(x).filter(|x| x.is_finite())
}
