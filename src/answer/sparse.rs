//! The sparse solvers of `tied` and `stepped`, which build no dense matrix.

use nalgebra::DVector;

use crate::numbers::scalar::{Bounded, F64x2, Scalar};
use crate::numbers::solve::{
    Arithmetic, Ldlt, Native, ScalarName, Solved, Solver, SparseCholesky, SparseSymmetric,
    Unsolved, error_bound,
};
use crate::problem::modelling::Variant;

/// Solves A x = b with factors of a sparse A.
pub(super) type Sparse<T> = fn(SparseSymmetric<T>, &DVector<T>) -> Result<Solved<T>, Unsolved>;

/// Solves by Cholesky factors.
pub(super) fn cholesky<T: Native>(
    a: SparseSymmetric<T>,
    b: &DVector<T>,
) -> Result<Solved<T>, Unsolved> {
    let factors = SparseCholesky::new(a)?;
    let x = factors.solve(b);
    Ok(Solved { residual: factors.residual(&x, b), x })
}

/// Solves by Cholesky factors, with a bound on the error of the solution.
pub(super) fn bounded(
    a: SparseSymmetric<Bounded>,
    b: &DVector<Bounded>,
) -> Result<Solved<Bounded>, Unsolved> {
    let (values, f) = (a.map(|x| x.to_f64()), b.map(Scalar::to_f64));
    let factors = SparseCholesky::new(values)?;
    let x = factors.solve(&f);
    let residual = factors.residual(&x, &f);
    let error = error_bound(&factors, a.both_triangles(), b, &x);
    Ok(Solved { residual, x: x.map(|x| Bounded::new(x, error)) })
}

/// Solves by LDLᵀ factors.
pub(super) fn ldlt(
    a: SparseSymmetric<F64x2>,
    b: &DVector<F64x2>,
) -> Result<Solved<F64x2>, Unsolved> {
    let x = DVector::from_vec(Ldlt::new(&a)?.solve(b.as_slice()));
    Ok(Solved { residual: a.residual(&x, b), x })
}

/// Returns the number of dense 2R x 2R matrices of the scalar in memory at once.
pub fn dense_matrices(variant: Variant, arithmetic: Arithmetic) -> usize {
    let sparse =
        arithmetic.solver() == Solver::SparseCholesky && arithmetic.scalar != ScalarName::Exact;
    match (variant, arithmetic.solver()) {
        (Variant::Unilateral, _) => 0,
        (Variant::Printed, Solver::DenseLu) => 3,
        // K beside the matrix of the iteration and its two factors.
        (_, Solver::DenseLu) => 4,
        (Variant::Printed, Solver::DenseCholesky) => 2,
        (_, Solver::DenseCholesky) => 3,
        (Variant::Printed, _) => 1,
        _ if sparse => 0,
        _ => 2,
    }
}
