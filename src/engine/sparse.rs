//! The contact states of `tied` and `stepped` solved from sparse matrices: no dense matrix of all equations is
//! built.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::DVector;

use super::elimination::{Constraint, Elimination};
use super::fast::condensation::{Bodies, WholeFactors, refined};
use super::residual::error_of_solution;
use super::session::Session;
use super::stiffness::Stiffness;
use numbers::scalar::{Bounded, BoundedDouble, Exact, F64x2, Scalar, WithBound};
use numbers::solve::{
    Arithmetic, Factors, Field, Iterates, Ldlt, Precision, ScalarName, Solved, Solver,
    SparseCholesky, SparseSymmetric, Unsolved, refine,
};
use problem::model::{Model, NodeId};
use problem::modelling::Variant;

/// Tᵀ K T q = f under one contact state.
pub(super) struct StateEquations<'a, T> {
    pub(super) model: &'a Arc<Model>,
    pub(super) stiffness: &'a Stiffness<T>,
    pub(super) constraints: &'a [Constraint<T>],
    pub(super) t: &'a Elimination<T>,
    pub(super) f: &'a DVector<T>,
}

/// What solves the contact states of a run from sparse matrices.
pub(super) struct SparseSolver {
    solver: Solver,
    tol: Option<f64>,
    bodies: Bodies,
    session: Session,
}

/// A scalar in which contact states are solved.
pub(super) trait SparseScalar: Precision {
    /// Solves a state for q.
    ///
    /// # Errors
    /// The matrix is singular, or an iteration does not converge.
    fn solve_state(
        by: &SparseSolver,
        state: &StateEquations<Self>,
    ) -> Result<Solved<Self>, Unsolved>;
}

/// Factors, the x that they give, and its relative residual.
type SolvedByFactors = (Box<dyn Factors<f64>>, DVector<f64>, f64);

impl SparseSolver {
    /// Returns the solver that is asked for.
    pub(super) fn new(arithmetic: Arithmetic, model: &Arc<Model>, session: &Session) -> Self {
        SparseSolver {
            solver: arithmetic.solver(false),
            tol: arithmetic.tol,
            bodies: Bodies::new(model, session),
            session: session.clone(),
        }
    }

    /// Returns the nodes to which the bodies were condensed last; None where they were not.
    pub(super) fn kept(&self) -> Option<BTreeSet<NodeId>> {
        self.bodies.kept()
    }

    /// Solves by an iteration, where one is asked for, else `directly`.
    fn solve<T: Iterates>(
        &self,
        state: &StateEquations<T>,
        directly: impl FnOnce() -> Result<Solved<T>, Unsolved>,
    ) -> Result<Solved<T>, Unsolved> {
        if self.solver.iterates() {
            T::iterate(&state.stiffness.reduced(state.t), state.f, self.solver, self.tol)
        } else {
            directly()
        }
    }

    /// Returns T of a state in `f64`, and its factors on the condensed bodies.
    fn factors<T: Scalar>(
        &self,
        state: &StateEquations<T>,
        stiffness: &Stiffness,
    ) -> (Elimination, Option<WholeFactors>) {
        let constraints: Vec<Constraint> =
            state.constraints.iter().map(|c| c.map(Scalar::to_f64)).collect();
        let t = Elimination::new(&state.model.restrained, &constraints);
        let factors = self.bodies.whole_factors(stiffness, &t, &constraints);
        (t, factors)
    }

    /// Solves a state in `f64` by factors on the condensed bodies; where these do not serve, by those of the
    /// whole matrix. Returns the factors, x and its relative residual.
    fn in_f64<T: Scalar>(
        &self,
        state: &StateEquations<T>,
        stiffness: &Stiffness,
        f: &DVector<f64>,
    ) -> Result<SolvedByFactors, Unsolved> {
        let (t, factors) = self.factors(state, stiffness);
        if let Some(factors) = factors
            && let Ok((x, residual)) = refined(stiffness, &t, &factors, f)
        {
            return Ok((Box::new(factors), x, residual));
        }
        let factors = SparseCholesky::new(state.stiffness.reduced(state.t).map(|x| x.to_f64()))?;
        let x = factors.solve(f);
        let residual = factors.residual(&x, f);
        Ok((Box::new(factors), x, residual))
    }
}

impl SparseScalar for f64 {
    fn solve_state(
        by: &SparseSolver,
        state: &StateEquations<f64>,
    ) -> Result<Solved<f64>, Unsolved> {
        by.solve(state, || {
            let (_, x, residual) = by.in_f64(state, state.stiffness, state.f)?;
            Ok(Solved { x, residual })
        })
    }
}

impl SparseScalar for f32 {
    /// Solves by LDLᵀ.
    fn solve_state(
        by: &SparseSolver,
        state: &StateEquations<f32>,
    ) -> Result<Solved<f32>, Unsolved> {
        by.solve(state, || {
            let matrix = state.stiffness.reduced(state.t);
            let x = DVector::from_vec(Ldlt::new(&matrix)?.solve(state.f.as_slice()));
            Ok(Solved { residual: matrix.residual(&x, state.f), x })
        })
    }
}

impl SparseScalar for Bounded {
    /// Solves as in `f64`, with a bound on the error of the solution.
    fn solve_state(
        by: &SparseSolver,
        state: &StateEquations<Bounded>,
    ) -> Result<Solved<Bounded>, Unsolved> {
        let (f, stiffness) = (state.f.map(Scalar::to_f64), by.session.stiffness(state.model));
        let (factors, x, residual) = by.in_f64(state, &stiffness, &f)?;
        let error = error_of_solution((state.stiffness, state.t), &*factors, state.f, &x);
        Ok(Solved { x: x.map(|x| Bounded::new(x, error)), residual })
    }
}

impl SparseScalar for F64x2 {
    fn solve_state(
        by: &SparseSolver,
        state: &StateEquations<F64x2>,
    ) -> Result<Solved<F64x2>, Unsolved> {
        by.solve(state, || {
            let matrix = state.stiffness.reduced(state.t);
            let factors = by.factors(state, &by.session.stiffness(state.model)).1;
            let (x, _) = in_double(&matrix, state.f, factors)?;
            Ok(Solved { residual: matrix.residual(&x, state.f), x })
        })
    }
}

impl SparseScalar for BoundedDouble {
    /// Solves as in double-double, with a bound on the error of the solution.
    fn solve_state(
        by: &SparseSolver,
        state: &StateEquations<BoundedDouble>,
    ) -> Result<Solved<BoundedDouble>, Unsolved> {
        let matrix = state.stiffness.reduced(state.t).map(|x| x.value());
        let f = state.f.map(WithBound::value);
        let factors = by.factors(state, &by.session.stiffness(state.model)).1;
        let (x, condensed) = in_double(&matrix, &f, factors)?;
        let factors: Box<dyn Factors<f64>> = match condensed {
            Some(factors) => Box::new(factors),
            None => Box::new(SparseCholesky::new(matrix.map(|x| x.to_f64()))?),
        };
        let error = error_of_solution((state.stiffness, state.t), &*factors, state.f, &x);
        let residual = matrix.residual(&x, &f);
        Ok(Solved { residual, x: x.map(|x| BoundedDouble::new(x, error)) })
    }
}

impl SparseScalar for Exact {
    fn solve_state(_: &SparseSolver, _: &StateEquations<Exact>) -> Result<Solved<Exact>, Unsolved> {
        unreachable!("exact numbers are solved from a dense matrix")
    }
}

/// Refines the solution of A x = `f` by factors in `f64`, and returns those; where that does not
/// converge, solves by LDLᵀ factors.
fn in_double(
    matrix: &SparseSymmetric<F64x2>,
    f: &DVector<F64x2>,
    factors: Option<WholeFactors>,
) -> Result<(DVector<F64x2>, Option<WholeFactors>), Unsolved> {
    /// The relative residual at which refinement ends, in units of the scalar's epsilon.
    const TOL: f64 = 4.0;
    // Far more digits than are shown, whatever |A| hides.
    let limits = [TOL * <F64x2 as Field>::EPSILON, f64::INFINITY];
    if let Some(factors) = factors
        && let Ok(x) = refine(&factors, matrix, f, limits)
    {
        return Ok((x, Some(factors)));
    }
    Ok((DVector::from_vec(Ldlt::new(matrix)?.solve(f.as_slice())), None))
}

/// Returns whether `solver` takes Tᵀ K T as a sparse matrix in numbers of a scalar.
pub(super) fn takes_sparse(solver: Solver, scalar: ScalarName) -> bool {
    scalar.properties().sparse.contains(&solver)
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
        Solver::DenseLu | Solver::DenseCholesky => 2 + beside,
        Solver::SparseLu => 2 * beside,
        Solver::SparseCholesky | Solver::Cg | Solver::Refined => {
            let is_sparse = beside == 1 && takes_sparse(solver, arithmetic.scalar);
            if is_sparse { 0 } else { 1 + beside }
        }
    }
}
