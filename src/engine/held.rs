//! The bodies as contact holds them in a step of a run, ready for one more load: condensed as the run
//! condensed them at its end, or whole.

use std::sync::Arc;

use nalgebra::DVector;

use super::elimination::Elimination;
use super::fast::condensation::{Bound, refined};
use super::session::Session;
use super::solution::{Solution, Step};
use super::stiffness::Stiffness;
use numbers::solve::{Normed, SparseCholesky};
use problem::model::Model;
use problem::modelling::Variant;

/// The bodies as contact holds them in a step.
pub(super) struct Held {
    pub(super) stiffness: Arc<Stiffness>,
    /// T of the contact state.
    pub(super) t: Elimination,
    /// The factors of Tᵀ K T.
    pub(super) factors: Box<dyn Normed + Send>,
}

impl Held {
    /// Takes the last contact state of a solution; None where it does not hold the bodies, and of
    /// `Km` as printed, which is the stiffness of no bodies in contact.
    pub(super) fn new(solution: &Solution, session: &Session) -> Option<Self> {
        Held::at(solution, solution.last(), session)
    }

    /// Takes the contact state of one of the solution's steps.
    pub(super) fn at(solution: &Solution, step: &Step, session: &Session) -> Option<Self> {
        let (model, constraints) = (&solution.model, &step.constraints);
        let t = match solution.request.variant {
            Variant::Printed if model.has_contact() => return None,
            Variant::Unilateral => Elimination::closing(&model.restrained, constraints),
            _ => Elimination::new(&model.restrained, constraints),
        };
        let stiffness = session.stiffness(model);
        let kept = solution.kept.clone();
        let bodies = kept.and_then(|nodes| session.condensed(&stiffness, model, nodes));
        let condensed = bodies
            .filter(|bodies| bodies.has(constraints))
            .and_then(|bodies| Bound::new(bodies, &t));
        let factors: Box<dyn Normed + Send> = match condensed {
            Some(bound) => Box::new(bound),
            None => Box::new(SparseCholesky::new(stiffness.reduced(&t)).ok()?),
        };
        Some(Held { stiffness, t, factors })
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
