//! How far one solution is from another on the same mesh.

use serde::Serialize;

use engine::{Solution, distance};

/// Differences relative to the solution that is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Errors {
    /// Largest difference of a node's displacement over the largest displacement.
    pub displacement: f64,
    /// Energy norm of the difference over that of the solution compared with.
    pub energy: f64,
    /// Largest difference of a body's largest von Mises stress, over that of the solution compared with.
    pub von_mises: f64,
}

impl Errors {
    /// The errors of `solution` against `truth`, a solution on the same mesh.
    pub fn new(solution: &Solution, truth: &Solution) -> Self {
        let of = distance(solution, truth);
        Errors {
            displacement: of.displacement_relative,
            energy: of.energy_relative,
            von_mises: of.bodies.iter().map(|body| body.relative.abs()).fold(0.0, f64::max),
        }
    }
}
