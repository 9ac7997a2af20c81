//! How far a run is from the converged answer on the same mesh: `unilateral` with mortar, under the scene's friction.

use serde::Serialize;

use super::outcome::{Outcome, max_displacement};
use super::run::run;
use super::stiffness::Stiffness;
use super::summary::summaries;
use crate::answer::error::Error;
use crate::paper::mirror::Reading;
use crate::problem::modelling::Coupling;
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;

/// How far a run is from the converged answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Distance {
    /// Largest difference of a node's displacement, length.
    pub displacement: f64,
    /// The same over the largest displacement of the converged answer.
    pub displacement_relative: f64,
    /// sqrt((u − u*)ᵀ K (u − u*)) over the same of u*, the converged answer.
    pub energy_relative: f64,
    /// By body.
    pub bodies: Vec<BodyDistance>,
}

/// A body's largest von Mises stress beside that of the converged answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyDistance {
    /// Its name.
    pub name: String,
    /// Largest von Mises stress of the run.
    pub von_mises_stress: f64,
    /// Largest von Mises stress of the converged answer.
    pub converged: f64,
    /// Their difference over the latter.
    pub relative: f64,
}

/// The converged answer that runs are measured against.
///
/// # Errors
/// As [`run`] under `unilateral`.
pub fn reference(scene: &Scene, reading: &Reading) -> Result<Outcome, Error> {
    let mut scene = scene.clone();
    scene.contact.coupling = Coupling::Mortar;
    run(&scene, Variant::Unilateral, reading, |_| ())
}

/// The distance of `outcome` from `converged`, a run on the same mesh under the same reading.
pub fn distance(scene: &Scene, outcome: &Outcome, converged: &Outcome) -> Distance {
    let difference = &outcome.u - &converged.u;
    let stiffness = Stiffness::new(&converged.sheet);
    let displacement = max_displacement(&difference);
    let bodies = summaries(scene, outcome).into_iter().zip(summaries(scene, converged));
    Distance {
        displacement,
        displacement_relative: over(displacement, max_displacement(&converged.u)),
        energy_relative: over(
            stiffness.energy_norm(&difference),
            stiffness.energy_norm(&converged.u),
        ),
        bodies: bodies
            .map(|(own, converged)| {
                let (stress, exact) = (own.max_von_mises_stress, converged.max_von_mises_stress);
                BodyDistance {
                    name: own.name,
                    von_mises_stress: stress,
                    converged: exact,
                    relative: over(stress - exact, exact),
                }
            })
            .collect(),
    }
}

/// A difference over a scale; 0 over 0 is 0.
fn over(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference / scale }
}
