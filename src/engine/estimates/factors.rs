//! The equations of a step's contact state, factored, ready for one more load.

use nalgebra::DVector;

use crate::refinement::refined;
use crate::{Elimination, Solution, Step, Stiffness};
use numbers::solve::SparseCholesky;
use problem::model::Model;
use problem::modelling::Variant;

/// The stiffness of the bodies, and Tᵀ K T of a step's contact state, factored.
pub struct StateFactors {
    pub(super) stiffness: Stiffness,
    /// T of the contact state.
    pub(super) t: Elimination,
    /// The factors of Tᵀ K T.
    pub(super) factors: SparseCholesky,
}

impl StateFactors {
    /// Factors the last contact state of a solution; None where it does not hold the bodies, and of
    /// `Km` as printed, which is the stiffness of no bodies in contact.
    pub fn new(solution: &Solution) -> Option<Self> {
        StateFactors::of_step(solution, solution.last())
    }

    /// Factors the contact state of one of the solution's steps.
    pub(super) fn of_step(solution: &Solution, step: &Step) -> Option<Self> {
        let (model, constraints) = (&solution.model, &step.constraints);
        let t = match solution.request.variant {
            Variant::Printed if model.has_contact() => return None,
            Variant::Unilateral => Elimination::closing(&model.restrained, constraints),
            Variant::Printed | Variant::Tied | Variant::Stepped => {
                Elimination::new(&model.restrained, constraints)
            }
        };
        let stiffness = Stiffness::new(model, |x| x);
        let factors = SparseCholesky::new(stiffness.reduced(&t)).ok()?;
        Some(StateFactors { stiffness, t, factors })
    }

    /// Returns q of Tᵀ K T q = `f`, refined as far as its factors allow.
    pub(super) fn refined(&self, f: &DVector<f64>) -> DVector<f64> {
        refined(&self.stiffness, &self.t, &self.factors, f).0
    }

    /// Returns the displacements under one more load by degree of freedom, length.
    pub(super) fn under(&self, model: &Model, load: &DVector<f64>) -> DVector<f64> {
        let q = self.factors.solve(&self.t.load(&model.free_part(load)));
        self.t.motion(&q)
    }
}
