//! Which solvers take the contact states of `tied` and `stepped` as sparse matrices, and how many dense ones
//! the others take.

use numbers::solve::{Arithmetic, ScalarName, Solver};
use problem::modelling::Variant;

/// Returns whether `solver` takes Tᵀ K T as a sparse matrix.
pub(super) fn takes_sparse(solver: Solver) -> bool {
    match solver {
        Solver::SparseCholesky => true,
        Solver::DenseLu | Solver::SparseLu => false,
    }
}

/// Returns the number of dense 2R x 2R matrices of the scalar in memory at once.
pub fn dense_matrices(variant: Variant, arithmetic: Arithmetic) -> usize {
    let solver = arithmetic.solver(variant == Variant::Printed);
    // K beside the matrix of the iteration.
    let beside = usize::from(variant != Variant::Printed);
    if variant == Variant::Unilateral {
        return 0;
    }
    match solver {
        // Factored in its place.
        Solver::DenseLu if arithmetic.scalar == ScalarName::F64 => 1 + beside,
        Solver::DenseLu => 2 + beside,
        Solver::SparseLu => 2 * beside,
        Solver::SparseCholesky => 0,
    }
}
