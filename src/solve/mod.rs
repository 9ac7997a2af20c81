//! Solution of the linear equations.

mod dense;
pub mod memory;
mod sparse;

pub use dense::{DenseLu, Singular};
pub use sparse::{SparseCholesky, SparseSymmetric};
