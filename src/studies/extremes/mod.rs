//! Numerical stability at the extremes: each row of one table sweeps a magnitude until something breaks
//! down, every answer compared with one that is known.
//!
//! ```text
//!  Generator: powers of ten, how a scene is made of one
//!       |
//!       +--> what is kept of each value by each method: exact, digits, wrong, refused
//!       +--> for each method, where it breaks down: bisected to half a decade
//! ```

mod blocks;
pub(crate) mod command;
pub mod digit_tables;
mod kept;
mod method;

use rayon::prelude::*;
use serde::Serialize;

use blocks::Blocks;

pub use kept::Kept;
pub use method::{Break, Column, SweepTable};

/// A family of scenes in which one magnitude becomes extreme.
#[derive(Debug, Serialize)]
pub struct Generator {
    /// Its name.
    pub name: &'static str,
    /// What the generator tries, in a line for people.
    pub title: &'static str,
    /// What is swept, with its unit.
    pub magnitude: &'static str,
    /// Powers of ten: from, to, step.
    #[serde(skip)]
    decades: (i32, i32, usize),
    /// The scene of a value.
    #[serde(skip)]
    blocks: fn(f64) -> Blocks,
}

/// Every generator, in the order of the tables: what is ill-conditioned, locks, cancels, leaves the range
/// of numbers (lengths: areas; loads: forces), or is nearly singular.
pub static GENERATORS: [Generator; 6] = [
    Generator {
        name: "moduli",
        title: "Moduli of the two bodies far apart",
        magnitude: "E of the stamp / E of the block",
        decades: (-15, 15, 3),
        blocks: |ratio| Blocks { e: [30000.0, 30000.0 * ratio], ..Blocks::new() },
    },
    Generator {
        name: "incompressible",
        title: "Poisson's ratio to 0.5",
        magnitude: "1 - 2 nu",
        decades: (-17, 0, 1),
        blocks: |rest| Blocks { nu: 0.5 - rest / 2.0, ..Blocks::new() },
    },
    Generator {
        name: "offset",
        title: "Coordinates moved off the origin, two iterations",
        magnitude: "distance from the origin / edge length",
        decades: (0, 16, 1),
        blocks: |origin| Blocks { origin, iterations: 2, ..Blocks::new() },
    },
    Generator {
        name: "lengths",
        title: "Lengths of any size",
        magnitude: "length unit",
        decades: (-300, 300, 20),
        blocks: |length| Blocks { length, c_tll: 1e-3 * length, ..Blocks::new() },
    },
    Generator {
        name: "loads",
        title: "Loads of any size, one iteration",
        magnitude: "pressure",
        decades: (-300, 300, 20),
        blocks: |pressure| Blocks { pressure, ..Blocks::new() },
    },
    Generator {
        name: "slivers",
        title: "A triangle pressed flat",
        magnitude: "height / length of the triangle",
        decades: (-18, 0, 1),
        blocks: |height| Blocks { sliver: Some(height), ..Blocks::new() },
    },
];

/// Sweeps each of `generators`, side by side.
pub fn measure(generators: &[&'static Generator]) -> Vec<SweepTable> {
    generators.par_iter().map(|generator| generator.measure()).collect()
}
