//! Numerical stability at the extremes: each row of one table sweeps a magnitude until something breaks
//! down, every answer compared with one that is known.
//!
//! ```text
//!  Generator: values tried, how a scene is made of a value, which answer is known
//!       |
//!       +--> a Verdict for each value and method: exact, digits, wrong, refused
//!       +--> for each method, where it breaks down: bisected to half a decade
//! ```

mod answer;
mod blocks;
mod search;
mod sweep;
mod verdict;

use rayon::prelude::*;

use blocks::Blocks;
use search::{Quantity, Search};

pub use sweep::{Break, Column, SweepTable};
pub use verdict::Verdict;

/// A family of scenes in which one magnitude becomes extreme.
pub struct Generator {
    /// Its name.
    pub name: &'static str,
    /// What the generator tries, in a line for people.
    pub title: &'static str,
    /// What is swept, with its unit.
    pub magnitude: &'static str,
    values: Values,
    made: Made,
    known: &'static [Known],
}

/// The values that are tried.
enum Values {
    /// Powers of ten `from` .. `to` by `step`, walked from 1 outwards.
    Decades { from: i32, to: i32, step: usize },
    /// Named cases; the value is the case's number, from 0.
    Cases(&'static [&'static str]),
}

/// How a scene is made of a value.
#[derive(Clone, Copy)]
enum Made {
    /// Two blocks in contact.
    Blocks(fn(f64) -> Blocks),
    /// A contact node beside a target edge, of which the search finds these.
    Search(fn(f64) -> Search, &'static [Quantity]),
}

/// The answer that is known.
#[derive(Clone, Copy)]
enum Known {
    /// That of the same computation in exact numbers.
    Exact,
    /// Lamé's displacement of the bore of an annulus whose Poisson's ratio is that of the blocks, on
    /// a coarse mesh and a fine one.
    Lame,
}

/// Every generator, in the order of the tables: what is ill-conditioned, locks, cancels, leaves the range
/// of numbers (lengths: areas; loads: forces), is nearly singular, divides by nearly 0, or is decided by the
/// last bit.
pub static GENERATORS: [Generator; 8] = [
    Generator {
        name: "moduli",
        title: "Moduli of the two bodies far apart",
        magnitude: "E of the stamp / E of the block",
        values: Values::Decades { from: -15, to: 15, step: 3 },
        made: Made::Blocks(|ratio| Blocks { e: [30000.0, 30000.0 * ratio], ..Blocks::new() }),
        known: &[Known::Exact],
    },
    Generator {
        name: "incompressible",
        title: "Poisson's ratio to 0.5: arithmetic against exact numbers, and locking against Lame's \
                closed form",
        magnitude: "1 - 2 nu",
        values: Values::Decades { from: -17, to: 0, step: 1 },
        made: Made::Blocks(|rest| Blocks { nu: 0.5 - rest / 2.0, ..Blocks::new() }),
        known: &[Known::Exact, Known::Lame],
    },
    Generator {
        name: "offset",
        title: "Coordinates moved off the origin, two iterations",
        magnitude: "distance from the origin / edge length",
        values: Values::Decades { from: 0, to: 16, step: 1 },
        made: Made::Blocks(|origin| Blocks { origin, iterations: 2, ..Blocks::new() }),
        known: &[Known::Exact],
    },
    Generator {
        name: "lengths",
        title: "Lengths of any size",
        magnitude: "length unit",
        values: Values::Decades { from: -300, to: 300, step: 20 },
        made: Made::Blocks(|length| Blocks { length, c_tll: 1e-3 * length, ..Blocks::new() }),
        known: &[Known::Exact],
    },
    Generator {
        name: "loads",
        title: "Loads of any size, one iteration",
        magnitude: "pressure",
        values: Values::Decades { from: -300, to: 300, step: 20 },
        made: Made::Blocks(|pressure| Blocks { pressure, ..Blocks::new() }),
        known: &[Known::Exact],
    },
    Generator {
        name: "slivers",
        title: "A triangle pressed flat",
        magnitude: "height / length of the triangle",
        values: Values::Decades { from: -18, to: 0, step: 1 },
        made: Made::Blocks(|height| Blocks { sliver: Some(height), ..Blocks::new() }),
        known: &[Known::Exact],
    },
    Generator {
        name: "steep-edge",
        title: "C3: a target edge turned to the vertical, the node 7e-4 off it; errors over the edge \
                length, so that 3 digits are the paper's c_tol of 0.001",
        magnitude: "angle from the vertical, rad",
        values: Values::Decades { from: -18, to: 0, step: 1 },
        made: Made::Search(Search::at_angle, &[Quantity::Yt, Quantity::NormalGap]),
        known: &[Known::Exact],
    },
    Generator {
        name: "gap-at-tolerance",
        title: "A gap within a unit in the last place of c_tll: is the node in contact",
        magnitude: "case",
        values: Values::Cases(&[
            "level edge, c_tll - 1 ulp",
            "level edge, c_tll",
            "level edge, c_tll + 1 ulp",
            "sloping edge, c_tll - 1 ulp",
            "sloping edge, c_tll",
            "sloping edge, c_tll + 1 ulp",
        ]),
        made: Made::Search(Search::at_tolerance, &[Quantity::Status]),
        known: &[Known::Exact],
    },
];

/// Sweeps each of `generators`, side by side.
pub fn measure(generators: &[&Generator]) -> Vec<SweepTable> {
    generators.par_iter().map(|generator| generator.measure()).collect()
}
