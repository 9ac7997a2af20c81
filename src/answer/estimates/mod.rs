//! Error estimates: how far a printed number may be from the truth. Each number has two, for the
//! effect of rounding and for the effect of the mesh.
//!
//! ```text
//!  Model, States --patches--> sites --recovery--> stresses --discretisation--> errors of the mesh
//!  Solution ------------------------------------------------ arithmetic -----> errors of rounding
//! ```

pub mod arithmetic;
pub mod discretisation;
mod patches;
mod recovery;
mod ties;

use super::solution::Solution;
use crate::paper::decisions::Decision;
use discretisation::Discretisation;

/// The error estimates of a run.
#[derive(Clone, Debug)]
pub struct ErrorEstimates {
    /// A bound on the rounding error of any displacement, length; infinite where unknown, as where
    /// rounding may have decided who is in contact.
    pub displacement: f64,
    /// The decisions on who is in contact that rounding may have taken; None where that is not known.
    pub decisions: Option<Vec<Decision>>,
    /// The error that the mesh causes in the stresses.
    pub mesh: Discretisation,
    /// The error estimates of each body's largest stress, in the model's order.
    pub bodies: Vec<BodyEstimates>,
}

/// A body's largest von Mises stress and its error estimates, stress; infinite where unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyEstimates {
    /// The name of the body.
    pub name: String,
    /// The largest von Mises stress of its triangles, stress.
    pub value: f64,
    /// The largest of the recovered stresses, typically nearer to the truth, stress.
    pub recovered: f64,
    /// The estimated error of `value` that the mesh causes, stress.
    pub mesh: f64,
    /// A bound on the error of `value` that rounding causes, stress.
    pub arithmetic: f64,
}

impl ErrorEstimates {
    /// Estimates the errors of a run.
    pub fn new(solution: &Solution) -> Self {
        let model = &*solution.model;
        let arithmetic::Rounding { displacement, decisions } = arithmetic::rounding(solution);
        let stress = arithmetic::stress_bounds(solution, displacement);
        let mesh = Discretisation::new(model, &solution.elements);
        let bodies = model.bodies.iter().map(|body| {
            let largest = mesh.largest_von_mises(model, &solution.elements, &body.triangles);
            let rounding = body.triangles.iter().map(|id| stress[id.index()]);
            BodyEstimates {
                name: body.name.clone(),
                value: largest.value,
                recovered: largest.recovered,
                mesh: largest.error,
                arithmetic: rounding.fold(0.0, f64::max),
            }
        });
        ErrorEstimates { displacement, decisions, bodies: bodies.collect(), mesh }
    }
}
