//! Solution of the linear equations: one matrix, several scalars and solvers.
//!
//! | modules, each using only those above it | what they contain |
//! |---|---|
//! | `arithmetic` | the scalar and the solver that are asked for |
//! | `factors` | what factorisations share |
//! | `dense` | faer's factors of dense matrices |
//! | `inverse_norm` | the norm of an inverse |
//! | `symmetric`, `cholesky` | sparse symmetric matrices; faer's factor of one |
//! | [`cost`] | the time that exact numbers take |
//! | `sparse`, `schur` | factors that tell a singular matrix; what is left of one on its last equations |
//! | `sparse_lu` | factors of a sparse matrix that need not be symmetric |
//! | `elimination`, `ldlt` | elimination in numbers that no library factors |
//! | `precision` | the solution in each scalar by each solver |

mod arithmetic;
mod cholesky;
pub mod cost;
mod dense;
mod elimination;
mod factors;
mod inverse_norm;
mod ldlt;
mod precision;
mod schur;
mod sparse;
mod sparse_lu;
mod symmetric;

pub use arithmetic::{Arithmetic, Inputs, ScalarName, Solver};
pub use dense::{DenseCholesky, DenseLu};
pub use elimination::solve_dense;
pub use factors::{Factors, Singular, backward_error, largest, residual};
pub use inverse_norm::inverse_norm;
pub use ldlt::Ldlt;
pub use precision::{Precision, Solved};
pub use schur::{EliminatedLoad, Schur};
pub use sparse::SparseCholesky;
pub use sparse_lu::SparseLu;
pub use symmetric::{Pattern, SparseSymmetric};

use numbers::scalar::Field;

/// Returns the size of a pivot, relative to what stood in its place before n equations were eliminated, below
/// which it may be rounding alone; `epsilon` is the scalar's.
fn rounding(n: usize, epsilon: f64) -> f64 {
    16.0 * n as f64 * epsilon
}

/// Returns whether a pivot is 0, or may be rounding alone beside what stood in its place `before` n equations were
/// eliminated.
fn is_lost<F: Field>(pivot: &F, before: f64, n: usize) -> bool {
    let size = pivot.size();
    pivot.vanishes() || size.is_nan() || size < rounding(n, F::EPSILON) * before
}

/// Returns the size of a factor of an equation, relative to the largest, below which it may be rounding alone
/// (1e-10 in f64): normals are differences of coordinates, which have few of their digits where nodes are
/// near each other.
pub(crate) fn negligible(epsilon: f64) -> f64 {
    (1 << 19) as f64 * epsilon
}
