//! How far one solution is from another on the same mesh.

use serde::Serialize;

use engine::{Solution, distance, over, resultant};

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

/// What contact passes on, and how far that is from the solution compared with, over the latter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Contact {
    /// The force on the target, force.
    pub force: f64,
    /// How far it is off.
    pub force_error: f64,
    /// The largest contact pressure, stress.
    pub peak_pressure: f64,
    /// How far it is off.
    pub peak_pressure_error: f64,
}

impl Contact {
    /// The contact of `solution` beside that of `truth`, on whatever mesh; nothing where none presses.
    pub fn new(solution: &Solution, truth: &Solution) -> Option<Self> {
        let [[force, peak_pressure], [true_force, true_peak]] = [of(solution)?, of(truth)?];
        let error = |own: f64, truth| over(own - truth, truth).abs();
        Some(Contact {
            force,
            force_error: error(force, true_force),
            peak_pressure,
            peak_pressure_error: error(peak_pressure, true_peak),
        })
    }
}

fn of(solution: &Solution) -> Option<[f64; 2]> {
    let [fx, fy] = resultant(solution)?.force;
    // Of forces that balance, as on a ring between two plates, the sum of their sizes.
    let force = match fx.hypot(fy) {
        0.0 => solution.pressed(),
        size => size,
    };
    let pressures = solution.in_contact().filter_map(|node| node.pressure);
    Some([force, pressures.reduce(f64::max)?])
}
