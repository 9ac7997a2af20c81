//! Solution of the linear equations: one matrix, several scalars and solvers.

mod arithmetic;
pub mod cost;
mod dense;
mod error_bound;
mod factors;
mod field;
mod iterative;
mod ldlt;
mod lifting;
mod lu;
pub mod memory;
mod precision;
mod sparse;
mod symbolic;

pub use arithmetic::{Arithmetic, Inputs, ScalarName, Solver};
pub use dense::{DenseCholesky, DenseLu};
pub use error_bound::{error_bound, inverse_norm};
pub use factors::{Factors, Native, Singular};
pub use field::Field;
pub use iterative::{Iterated, NotConverged, conjugate_gradients, refine};
pub use ldlt::Ldlt;
pub use lifting::lift;
pub use lu::solve_dense;
pub use precision::{Rung, Solved, Unsolved};
pub use sparse::{SparseCholesky, SparseSymmetric};
pub use symbolic::FactorSize;
