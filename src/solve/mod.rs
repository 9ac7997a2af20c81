//! Solution of the linear equations.

mod dense;
pub mod memory;

pub use dense::{DenseLu, Singular};
