//! The bodies under imposed statuses: the equations Tᵀ K T q = f, factored.

use nalgebra::{DMatrix, DVector};

use super::problem::Problem;
use crate::elimination::{Constraint, Elimination};
use crate::refinement::refined;
use numbers::solve::{Singular, SparseCholesky};

/// The equations of the bodies under constraints.
pub(super) struct HeldBodies<'a> {
    problem: &'a Problem<'a>,
    t: Elimination,
    factors: SparseCholesky,
}

impl<'a> HeldBodies<'a> {
    /// Factors Tᵀ K T.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn new(problem: &'a Problem<'a>, t: Elimination) -> Result<Self, Unheld> {
        match SparseCholesky::new(problem.stiffness.reduced(&t)) {
            Ok(factors) => Ok(HeldBodies { problem, t, factors }),
            Err(singular) => Err(Unheld { t, singular }),
        }
    }

    /// Binds the same motions to other places.
    pub(super) fn move_to(&mut self, constraints: &[Constraint]) {
        self.t = Elimination::closing(&self.problem.model.restrained, constraints);
    }

    /// Returns the displacements by degree of freedom under a load, length, and the relative residual
    /// of their equations.
    pub(super) fn displacements(&self, load: &DVector<f64>) -> (DVector<f64>, f64) {
        let shifted = self.problem.stiffness.times(self.t.shift());
        let f = self.t.load(&(self.problem.model.free_part(load) - shifted));
        let (q, residual) = refined(&self.problem.stiffness, &self.t, &self.factors, &f);
        (self.t.expand(&q), residual)
    }

    /// Returns the displacements by degree of freedom under a load without the shift of the
    /// constraints, length.
    pub(super) fn unshifted(&self, load: &DVector<f64>) -> DVector<f64> {
        let f = self.t.load(&self.problem.model.free_part(load));
        self.t.motion(&refined(&self.problem.stiffness, &self.t, &self.factors, &f).0)
    }

    /// Returns for each of some loads on the contact surface, by degree of freedom, K u − f of the
    /// displacements under it without the shift of the constraints, force; 0 but on the surfaces.
    pub(super) fn responses(&self, loads: &[DVector<f64>]) -> Vec<DVector<f64>> {
        let Problem { model, stiffness, surface_triangles, .. } = self.problem;
        let f: Vec<_> = loads.iter().map(|load| self.t.load(&model.free_part(load))).collect();
        let q = self.factors.solve_all(DMatrix::from_columns(&f));
        let of_load = |(q, load): (_, &DVector<f64>)| {
            let u = self.t.motion(&q);
            stiffness.times_of(surface_triangles.iter().copied(), &u) - load
        };
        q.column_iter().map(|q| q.into_owned()).zip(loads).map(of_load).collect()
    }
}

/// Constraints that do not hold the bodies.
pub(super) struct Unheld {
    pub(super) t: Elimination,
    pub(super) singular: Singular,
}
