//! Solution of the linear equations.

mod dense;

pub use dense::{DenseLu, Singular};
