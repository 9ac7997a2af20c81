//! Which solvers take the contact states of `tied` and `stepped` as sparse matrices, and whether
//! the others hold dense ones.

use crate::linear::{Arithmetic, Solver};
use problem::modelling::Variant;

/// Returns whether `solver` takes Tᵀ K T as a sparse matrix.
pub(super) fn takes_sparse(solver: Solver) -> bool {
    match solver {
        Solver::SparseCholesky => true,
        Solver::DenseLu | Solver::SparseLu => false,
    }
}

/// Returns whether a run holds dense 2R x 2R matrices of the scalar.
pub fn is_dense(variant: Variant, arithmetic: Arithmetic) -> bool {
    if variant == Variant::Unilateral {
        return false;
    }
    match arithmetic.solver(variant == Variant::Printed) {
        Solver::DenseLu => true,
        Solver::SparseLu => variant != Variant::Printed,
        Solver::SparseCholesky => false,
    }
}
