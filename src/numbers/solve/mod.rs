//! Solution of the linear equations: one matrix, several rungs of a ladder.

pub mod cost;
mod dense;
mod error_bound;
mod field;
mod iterative;
mod ladder;
mod ldlt;
mod lifting;
mod lu;
pub mod memory;
mod sparse;
mod symbolic;

pub use dense::{DenseCholesky, DenseLu, Factors, Native, Singular};
pub use error_bound::{error_bound, inverse_norm};
pub use field::Field;
pub use iterative::{Iterated, NotConverged, conjugate_gradients, refine};
pub use ladder::{Arithmetic, Inputs, Rung, ScalarName, Solved, Solver, Unsolved};
pub use ldlt::Ldlt;
pub use lifting::lift;
pub use lu::solve_dense;
pub use sparse::{SparseCholesky, SparseSymmetric};
pub use symbolic::FactorSize;
