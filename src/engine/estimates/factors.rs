//! The equations of a step's contact state, factored, ready for one more load: on the bodies condensed as the
//! run condensed them at its end, or on the whole ones.

use std::sync::Arc;

use nalgebra::DVector;

use crate::fast::condensation::{WholeFactors, refined};
use crate::{Elimination, Session, Solution, Step, Stiffness};
use numbers::solve::{Normed, SparseCholesky};
use problem::model::Model;
use problem::modelling::Variant;

/// The stiffness of the bodies, and Tᵀ K T of a step's contact state, factored.
pub struct StateFactors {
    pub(super) stiffness: Arc<Stiffness>,
    /// T of the contact state.
    pub(super) t: Elimination,
    /// The factors of Tᵀ K T.
    pub(super) factors: Box<dyn Normed + Send>,
}

impl StateFactors {
    /// Factors the last contact state of a solution; None where it does not hold the bodies, and of
    /// `Km` as printed, which is the stiffness of no bodies in contact.
    pub fn new(solution: &Solution, session: &Session) -> Option<Self> {
        StateFactors::of_step(solution, solution.last(), session)
    }

    /// Factors the contact state of one of the solution's steps.
    pub(super) fn of_step(solution: &Solution, step: &Step, session: &Session) -> Option<Self> {
        let (model, constraints) = (&solution.model, &step.constraints);
        let t = match solution.request.variant {
            Variant::Printed if model.has_contact() => return None,
            Variant::Unilateral => Elimination::closing(&model.restrained, constraints),
            Variant::Printed | Variant::Tied | Variant::Stepped => {
                Elimination::new(&model.restrained, constraints)
            }
        };
        let stiffness = session.stiffness(model);
        let kept = solution.kept.clone();
        let bodies = kept.and_then(|nodes| session.condensed(&stiffness, model, nodes));
        let condensed = bodies
            .filter(|bodies| bodies.has(constraints))
            .and_then(|bodies| WholeFactors::new(bodies, &t));
        let factors: Box<dyn Normed + Send> = match condensed {
            Some(condensed) => Box::new(condensed),
            None => Box::new(SparseCholesky::new(stiffness.reduced(&t)).ok()?),
        };
        Some(StateFactors { stiffness, t, factors })
    }

    /// Returns q of Tᵀ K T q = `f`, refined as far as its factors allow.
    pub(super) fn refined(&self, f: &DVector<f64>) -> DVector<f64> {
        let (Ok((q, _)) | Err((q, _))) = refined(&self.stiffness, &self.t, &*self.factors, f);
        q
    }

    /// Returns the displacements under one more load by degree of freedom, length.
    pub(super) fn under(&self, model: &Model, load: &DVector<f64>) -> DVector<f64> {
        let q = self.factors.solve(&self.t.load(&model.free_part(load)));
        self.t.motion(&q)
    }
}
