//! The bodies as contact holds them in a step of a run, ready for one more load: with the factors
//! that the run ended with where they serve, or with new ones.

use std::sync::Arc;

use nalgebra::DVector;

use super::condensation::{Bound, refined};
use super::elimination::Elimination;
use super::factors::{LastFactors, Whole};
use super::solution::{Solution, Step};
use super::stiffness::Stiffness;
use crate::numbers::solve::Factors;
use crate::problem::model::Model;
use crate::problem::modelling::Variant;

/// The bodies as contact holds them in a step.
pub(super) struct Held {
    pub(super) stiffness: Arc<Stiffness>,
    /// T of the contact state.
    pub(super) t: Elimination,
    factors: Made,
}

/// The factors of the contact state, or of nearly the same one.
enum Made {
    Condensed(Arc<Bound>),
    Whole(Arc<Whole>),
}

impl Held {
    /// Takes the last contact state of a solution; None where it does not hold the bodies, and of
    /// `Km` as printed, which is the stiffness of no bodies in contact.
    pub(super) fn new(solution: &Solution) -> Option<Self> {
        Held::at(solution, solution.last())
    }

    /// Takes the contact state of one of the solution's steps.
    pub(super) fn at(solution: &Solution, step: &Step) -> Option<Self> {
        let (model, constraints) = (&*solution.model, &step.constraints);
        let t = match solution.request.variant {
            Variant::Printed if model.has_contact() => return None,
            Variant::Unilateral => Elimination::closing(&model.restrained, constraints),
            _ => Elimination::new(&model.restrained, constraints),
        };
        let stiffness = solution.stiffness();
        let known = match &solution.factors.known() {
            LastFactors::Condensed(_, Some(bound)) if bound.is_of(constraints) => {
                Some(Made::Condensed(Arc::clone(bound)))
            }
            LastFactors::Condensed(bodies, _) if bodies.has(constraints) => {
                let bound = Bound::new(Arc::clone(bodies), &t, constraints);
                bound.map(|bound| Made::Condensed(Arc::new(bound)))
            }
            LastFactors::Whole(whole) if whole.is_nearly_of(constraints) => {
                Some(Made::Whole(Arc::clone(whole)))
            }
            _ => None,
        };
        let new = || Whole::new(&stiffness, &t, constraints).map(Arc::new).ok();
        let factors = known.or_else(|| new().map(Made::Whole))?;
        Some(Held { stiffness, t, factors })
    }

    /// Returns the factors of Tᵀ K T, or of nearly that matrix.
    pub(super) fn factors(&self) -> &dyn Factors<f64> {
        match &self.factors {
            Made::Condensed(bound) => &**bound,
            Made::Whole(whole) => &**whole,
        }
    }

    /// Returns q of Tᵀ K T q = `f`, refined as far as its factors allow.
    pub(super) fn refined(&self, f: &DVector<f64>) -> DVector<f64> {
        let norm = match &self.factors {
            Made::Condensed(bound) => bound.norm(),
            Made::Whole(whole) => whole.norm(),
        };
        let factors = (self.factors(), norm);
        let (Ok((q, _)) | Err((q, _))) = refined(&self.stiffness, &self.t, factors, f);
        q
    }

    /// Returns the displacements under one more load by degree of freedom, length.
    pub(super) fn under(&self, model: &Model, load: &DVector<f64>) -> DVector<f64> {
        let q = self.factors().solve(&self.t.load(&model.free_part(load)));
        self.t.motion(&q)
    }
}
