//! Error bars: how far a printed number may be from the truth. Two a number: what rounding does to
//! it, and what the mesh does.
//!
//! ```text
//!  Model, States --patches-->  sites --recovery--> smoothed stresses --discretisation--> eta, bars of the mesh
//!  Solution ---------------------------------------------------------- arithmetic --------> bars of rounding
//! ```

pub mod arithmetic;
pub mod discretisation;
mod patches;
mod recovery;

use serde::{Deserialize, Serialize};

use super::solution::Solution;
use discretisation::Discretisation;

/// The error bars of a run.
#[derive(Clone, Debug)]
pub struct ErrorBars {
    /// Rounding: a bound on the largest error of a displacement, length; infinite where nothing is
    /// known.
    pub displacement: f64,
    /// The mesh.
    pub mesh: Discretisation,
    /// By body.
    pub bodies: Vec<BodyBars>,
}

/// A body's largest von Mises stress and its bars, stress; infinite where nothing is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyBars {
    /// Its name.
    pub name: String,
    /// Its largest von Mises stress.
    pub value: f64,
    /// The largest of the recovered stresses: as a rule nearer to the truth.
    pub recovered: f64,
    /// What the mesh does to `value`.
    pub mesh: f64,
    /// What rounding does to it.
    pub arithmetic: f64,
}

impl ErrorBars {
    /// The bars of a run.
    pub fn new(solution: &Solution) -> Self {
        let model = &*solution.model;
        let displacement = arithmetic::displacement_bound(solution);
        let stress = arithmetic::stress_bounds(solution, displacement);
        let mesh = Discretisation::new(model, &solution.elements);
        let bodies = model.bodies.iter().map(|body| {
            let largest = mesh.largest_von_mises(model, &solution.elements, &body.triangles);
            let rounding = body.triangles.iter().map(|id| stress[id.index()]);
            BodyBars {
                name: body.name.clone(),
                value: largest.value,
                recovered: largest.recovered,
                mesh: largest.bar,
                arithmetic: rounding.fold(0.0, f64::max),
            }
        });
        ErrorBars { displacement, bodies: bodies.collect(), mesh }
    }
}
