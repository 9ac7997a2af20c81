//! The distance of a run from another solution on the same mesh: the reference solution, or the
//! equilibrium under the scene's own friction.

use serde::Serialize;

use super::quantities::summaries;
use super::solution::{Solution, max_displacement};
use super::stiffness::Stiffness;

/// The differences between a run and the solution compared with.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Distance {
    /// The largest difference of a node's displacement, length.
    pub displacement: f64,
    /// That difference over the largest displacement of the solution compared with.
    pub displacement_relative: f64,
    /// sqrt((u − u*)ᵀ K (u − u*)) over sqrt(u*ᵀ K u*), where u* is the solution compared with.
    pub energy_relative: f64,
    /// The largest stresses of each body, in the model's order.
    pub bodies: Vec<BodyDistance>,
}

/// A body's largest von Mises stress beside that of the solution compared with.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyDistance {
    /// The name of the body.
    pub name: String,
    /// The largest von Mises stress of the run.
    pub von_mises_stress: f64,
    /// The largest von Mises stress of the solution compared with.
    pub reference: f64,
    /// The difference of the two over that of the solution compared with.
    pub relative: f64,
}

/// Returns the distance of `solution` from `reference`, with the same mesh and reading.
pub fn distance(solution: &Solution, reference: &Solution) -> Distance {
    let difference = &solution.u - &reference.u;
    let stiffness = Stiffness::new(&reference.model, |x| x);
    let [energy, scale] = [&difference, &reference.u].map(|u| stiffness.energy_norm(u));
    let displacement = max_displacement(&difference);
    let bodies = summaries(solution).into_iter().zip(summaries(reference));
    Distance {
        displacement,
        displacement_relative: over(displacement, max_displacement(&reference.u)),
        energy_relative: over(energy, scale),
        bodies: bodies
            .map(|(own, reference)| {
                let (stress, exact) = (own.max_von_mises_stress, reference.max_von_mises_stress);
                BodyDistance {
                    name: own.name,
                    von_mises_stress: stress,
                    reference: exact,
                    relative: over(stress - exact, exact),
                }
            })
            .collect(),
    }
}

/// Returns a difference over a scale, where 0 over 0 is 0.
pub fn over(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference / scale }
}
