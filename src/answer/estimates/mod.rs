//! Error bars: how far a printed number may be from the truth. Two a number: what rounding does to it, and what the mesh does.
//!
//! ```text
//!  Worksheet, States --patches--> sites --recovery--> smoothed stresses --discretisation--> eta, bars of the mesh
//!  Scene, Outcome ----------------------------------------------------- arithmetic --------> bars of rounding
//! ```

pub mod arithmetic;
pub mod discretisation;
mod patches;
mod recovery;

use serde::Serialize;

use crate::answer::contact::Outcome;
use crate::problem::scene::Scene;
use discretisation::Discretisation;

/// The error bars of a run.
#[derive(Clone, Debug)]
pub struct ErrorBars {
    /// Rounding: a bound on the largest error of a displacement, length; infinite where nothing is known.
    pub displacement: f64,
    /// The mesh.
    pub mesh: Discretisation,
    /// By body.
    pub bodies: Vec<BodyBars>,
}

/// A body's largest von Mises stress and its bars, stress; infinite where nothing is known.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    pub fn new(scene: &Scene, outcome: &Outcome) -> Self {
        let displacement = arithmetic::displacement_bound(scene, outcome);
        let stress = arithmetic::stress_bounds(outcome, scene.thickness, displacement);
        let mesh = Discretisation::new(&outcome.sheet, &outcome.elements);
        let bodies = scene.bodies.iter().map(|body| {
            let triangles = &body.triangles;
            let largest = mesh.largest_von_mises(&outcome.sheet, &outcome.elements, triangles);
            BodyBars {
                name: body.name.clone(),
                value: largest.value,
                recovered: largest.recovered,
                mesh: largest.bar,
                arithmetic: triangles.iter().map(|n| stress[n - 1]).fold(0.0, f64::max),
            }
        });
        ErrorBars { displacement, bodies: bodies.collect(), mesh }
    }
}
