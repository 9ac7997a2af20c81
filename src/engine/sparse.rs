//! The sparse solvers of `tied` and `stepped`, which build no dense matrix of all equations.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::DVector;

use super::elimination::{Constraint, Elimination};
use super::fast::condensation::{Bodies, Bound, refined};
use super::request::Request;
use super::residual::error_of_solution;
use super::session::Session;
use super::stiffness::Stiffness;
use numbers::scalar::{Bounded, BoundedDouble, F64x2, Scalar, WithBound};
use numbers::solve::{
    Arithmetic, Factors, Field, Iterates, Ldlt, ScalarName, Solved, Solver, SparseCholesky,
    SparseSymmetric, Unsolved, refine,
};
use problem::model::{Model, NodeId};
use problem::modelling::Variant;

/// Tᵀ K T q = f under one contact state.
pub(super) struct State<'a, T> {
    pub(super) model: &'a Arc<Model>,
    pub(super) stiffness: &'a Stiffness<T>,
    pub(super) constraints: &'a [Constraint<T>],
    pub(super) t: &'a Elimination<T>,
    pub(super) f: &'a DVector<T>,
}

/// A solver of the contact states of a run.
pub(super) trait Sparse<T> {
    /// Solves for q.
    ///
    /// # Errors
    /// The matrix is singular.
    fn solve(&self, state: &State<T>) -> Result<Solved<T>, Unsolved>;

    /// Returns the nodes to which the bodies were condensed last; None where they were not.
    fn kept(&self) -> Option<BTreeSet<NodeId>> {
        None
    }
}

/// Makes the solver of a run on a model.
pub(super) type MakeSparse<T> = fn(&Request, &Arc<Model>, &Session) -> Box<dyn Sparse<T>>;

/// Factors of the whole matrix of each state: Cholesky's, in `f32` LDLᵀ.
pub(super) struct Whole;

impl Sparse<f64> for Whole {
    fn solve(&self, state: &State<f64>) -> Result<Solved<f64>, Unsolved> {
        let factors = SparseCholesky::new(state.stiffness.reduced(state.t))?;
        let x = factors.solve(state.f);
        Ok(Solved { residual: factors.residual(&x, state.f), x })
    }
}

impl Sparse<f32> for Whole {
    fn solve(&self, state: &State<f32>) -> Result<Solved<f32>, Unsolved> {
        let matrix = state.stiffness.reduced(state.t);
        let x = DVector::from_vec(Ldlt::new(&matrix)?.solve(state.f.as_slice()));
        Ok(Solved { residual: matrix.residual(&x, state.f), x })
    }
}

/// What solves the whole equations of each state to a tolerance.
pub(super) struct Iterating {
    pub(super) solver: Solver,
    pub(super) tol: Option<f64>,
}

impl<T: Iterates> Sparse<T> for Iterating {
    fn solve(&self, state: &State<T>) -> Result<Solved<T>, Unsolved> {
        T::iterate(&state.stiffness.reduced(state.t), state.f, self.solver, self.tol)
    }
}

/// The factors of the condensed bodies, in `f64`; where they do not serve, those of the whole matrix.
pub(super) struct Condensing {
    bodies: Bodies,
    session: Session,
}

impl Condensing {
    pub(super) fn new(model: &Arc<Model>, session: &Session) -> Self {
        Condensing { bodies: Bodies::new(model, session), session: session.clone() }
    }

    /// Returns T of a state in `f64`, and its factors.
    fn factors<T: Scalar>(
        &self,
        state: &State<T>,
        stiffness: &Stiffness,
    ) -> (Elimination, Option<Bound>) {
        let constraints: Vec<Constraint> =
            state.constraints.iter().map(|c| c.map(Scalar::to_f64)).collect();
        let t = Elimination::new(&state.model.restrained, &constraints);
        let bound = self.bodies.bound(stiffness, &t, &constraints);
        (t, bound)
    }
}

impl Sparse<f64> for Condensing {
    fn solve(&self, state: &State<f64>) -> Result<Solved<f64>, Unsolved> {
        let (t, bound) = self.factors(state, state.stiffness);
        let refined = |bound: Bound| {
            let (x, residual) = refined(state.stiffness, &t, &bound, state.f).ok()?;
            Some(Solved { x, residual })
        };
        bound.and_then(refined).map_or_else(|| Whole.solve(state), Ok)
    }

    fn kept(&self) -> Option<BTreeSet<NodeId>> {
        self.bodies.kept()
    }
}

impl Sparse<Bounded> for Condensing {
    /// Solves as in `f64`, with a bound on the error of the solution.
    fn solve(&self, state: &State<Bounded>) -> Result<Solved<Bounded>, Unsolved> {
        let (f, stiffness) = (state.f.map(Scalar::to_f64), self.session.stiffness(state.model));
        let (t, bound) = self.factors(state, &stiffness);
        let refined = |bound: Bound| {
            let (x, residual) = refined(&stiffness, &t, &bound, &f).ok()?;
            Some((bound, x, residual))
        };
        let with_error = |factors: &dyn Factors<f64>, x: DVector<f64>, residual: f64| {
            let error = error_of_solution((state.stiffness, state.t), factors, state.f, &x);
            Solved { x: x.map(|x| Bounded::new(x, error)), residual }
        };
        if let Some((bound, x, residual)) = bound.and_then(refined) {
            return Ok(with_error(&bound, x, residual));
        }
        let factors = SparseCholesky::new(state.stiffness.reduced(state.t).map(|x| x.to_f64()))?;
        let x = factors.solve(&f);
        let residual = factors.residual(&x, &f);
        Ok(with_error(&factors, x, residual))
    }
}

impl Sparse<F64x2> for Condensing {
    fn solve(&self, state: &State<F64x2>) -> Result<Solved<F64x2>, Unsolved> {
        let matrix = state.stiffness.reduced(state.t);
        let factors = self.factors(state, &self.session.stiffness(state.model)).1;
        let (x, _) = in_double(&matrix, state.f, factors)?;
        Ok(Solved { residual: matrix.residual(&x, state.f), x })
    }
}

impl Sparse<BoundedDouble> for Condensing {
    /// Solves as in double-double, with a bound on the error of the solution.
    fn solve(&self, state: &State<BoundedDouble>) -> Result<Solved<BoundedDouble>, Unsolved> {
        let matrix = state.stiffness.reduced(state.t).map(|x| x.value());
        let f = state.f.map(WithBound::value);
        let factors = self.factors(state, &self.session.stiffness(state.model)).1;
        let (x, bound) = in_double(&matrix, &f, factors)?;
        let factors: Box<dyn Factors<f64>> = match bound {
            Some(bound) => Box::new(bound),
            None => Box::new(SparseCholesky::new(matrix.map(|x| x.to_f64()))?),
        };
        let error = error_of_solution((state.stiffness, state.t), &*factors, state.f, &x);
        let residual = matrix.residual(&x, &f);
        Ok(Solved { residual, x: x.map(|x| BoundedDouble::new(x, error)) })
    }
}

/// Refines the solution of A x = `f` by factors in `f64`, and returns those; where that does not
/// converge, solves by LDLᵀ factors.
fn in_double(
    matrix: &SparseSymmetric<F64x2>,
    f: &DVector<F64x2>,
    factors: Option<Bound>,
) -> Result<(DVector<F64x2>, Option<Bound>), Unsolved> {
    /// The relative residual at which refinement ends, in units of the scalar's epsilon.
    const TOL: f64 = 4.0;
    let refined = factors.and_then(|factors| {
        // Far more digits than are shown, whatever |A| hides.
        let limits = [TOL * <F64x2 as Field>::EPSILON, f64::INFINITY];
        let x = refine(&factors, matrix, f, limits).ok()?;
        Some((x, Some(factors)))
    });
    match refined {
        Some(refined) => Ok(refined),
        None => Ok((DVector::from_vec(Ldlt::new(matrix)?.solve(f.as_slice())), None)),
    }
}

/// Returns whether `solver` takes Tᵀ K T as a sparse matrix in numbers of a scalar.
pub(super) fn takes_sparse(solver: Solver, scalar: ScalarName) -> bool {
    use ScalarName::{Exact, F32, F64, F64x2};
    match solver {
        Solver::SparseCholesky => scalar != Exact,
        _ => solver.iterates() && matches!(scalar, F32 | F64 | F64x2),
    }
}

/// Returns the number of dense 2R x 2R matrices of the scalar in memory at once.
pub fn dense_matrices(variant: Variant, arithmetic: Arithmetic) -> usize {
    let solver = arithmetic.solver(variant == Variant::Printed);
    // K beside the matrix of the iteration.
    let beside = usize::from(variant != Variant::Printed);
    match solver {
        _ if variant == Variant::Unilateral => 0,
        // Factored in its place.
        Solver::DenseLu if arithmetic.scalar == ScalarName::F64 => 1 + beside,
        Solver::DenseLu | Solver::DenseCholesky => 2 + beside,
        Solver::SparseLu => 2 * beside,
        _ if beside == 1 && takes_sparse(solver, arithmetic.scalar) => 0,
        _ => 1 + beside,
    }
}
