//! Numerical stability at the extremes: each row of one table sweeps a magnitude until something breaks
//! down, every answer compared with one that is known.
//!
//! ```text
//!  Generator: powers of ten, how a scene is made of one
//!       |
//!       +--> what is kept of each value by each method: exact, digits, wrong, refused
//!       +--> for each method, where it breaks down: bisected to half a decade
//! ```

mod answer;
mod blocks;
pub(crate) mod command;
pub mod digit_tables;
mod kept;
mod method;
mod search;

use rayon::prelude::*;
use serde::Serialize;

use blocks::Blocks;
use search::{Quantity, Search};

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
    #[serde(skip)]
    made: Made,
}

/// How a scene is made of a value.
#[derive(Clone, Copy, Debug)]
enum Made {
    /// Two blocks in contact.
    Blocks(fn(f64) -> Blocks),
    /// A contact node beside a target edge, of which the search finds these.
    Search(fn(f64) -> Search, &'static [Quantity]),
}

/// Every generator, in the order of the tables: what is ill-conditioned, locks, cancels, leaves the range
/// of numbers (lengths: areas; loads: forces), is nearly singular, divides by nearly 0, or is decided by the
/// last bit.
pub static GENERATORS: [Generator; 8] = [
    Generator {
        name: "moduli",
        title: "Moduli of the two bodies far apart",
        magnitude: "E of the stamp / E of the block",
        decades: (-15, 15, 3),
        made: Made::Blocks(|ratio| Blocks { e: [30000.0, 30000.0 * ratio], ..Blocks::new() }),
    },
    Generator {
        name: "incompressible",
        title: "Poisson's ratio to 0.5",
        magnitude: "1 - 2 nu",
        decades: (-17, 0, 1),
        made: Made::Blocks(|rest| Blocks { nu: 0.5 - rest / 2.0, ..Blocks::new() }),
    },
    Generator {
        name: "offset",
        title: "Coordinates moved off the origin, two iterations",
        magnitude: "distance from the origin / edge length",
        decades: (0, 16, 1),
        made: Made::Blocks(|origin| Blocks { origin, iterations: 2, ..Blocks::new() }),
    },
    Generator {
        name: "lengths",
        title: "Lengths of any size",
        magnitude: "length unit",
        decades: (-300, 300, 20),
        made: Made::Blocks(|length| Blocks { length, c_tll: 1e-3 * length, ..Blocks::new() }),
    },
    Generator {
        name: "loads",
        title: "Loads of any size, one iteration",
        magnitude: "pressure",
        decades: (-300, 300, 20),
        made: Made::Blocks(|pressure| Blocks { pressure, ..Blocks::new() }),
    },
    Generator {
        name: "slivers",
        title: "A triangle pressed flat",
        magnitude: "height / length of the triangle",
        decades: (-18, 0, 1),
        made: Made::Blocks(|height| Blocks { sliver: Some(height), ..Blocks::new() }),
    },
    Generator {
        name: "steep-edge",
        title: "C3: a target edge turned to the vertical, the node 7e-4 off it; errors over the edge \
                length, so that 3 digits are the paper's c_tol of 0.001",
        magnitude: "angle from the vertical, rad",
        decades: (-18, 0, 1),
        made: Made::Search(Search::at_angle, &[Quantity::Yt, Quantity::NormalGap]),
    },
    Generator {
        name: "gap-at-tolerance",
        title: "A gap on a sloping edge, a little more and a little less than c_tll: is the node in contact",
        magnitude: "|gap / c_tll - 1|",
        decades: (-18, 0, 1),
        made: Made::Search(Search::at_tolerance, &[Quantity::Status]),
    },
];

/// Sweeps each of `generators`, side by side.
pub fn measure(generators: &[&'static Generator]) -> Vec<SweepTable> {
    generators.par_iter().map(|generator| generator.measure()).collect()
}
