//! Numerical stability at the extremes: generators that sweep a magnitude until something breaks
//! down, each answer compared with exact numbers.
//!
//! ```text
//!  Generator = Sweep (magnitudes) + Methods (variant x scalar, remedies)
//!       |
//!       +--> a Verdict for each magnitude and method: exact, digits, wrong, refused
//!       +--> for each method, where it breaks down: bisected to half a decade
//! ```
//!
//! A method breaks down where it is refused or keeps fewer than three digits. Remedies live here:
//! the mirror keeps the printed formulas.

mod answer;
mod blocks;
mod material;
mod methods;
mod scale;
mod search;
mod status;
mod sweep;
mod verdict;

use rayon::prelude::*;

pub use sweep::{Break, Column, Generator, LEAST, SweepTable};
pub use verdict::Verdict;

/// Every generator, in the order of the tables.
pub fn generators() -> Vec<Generator> {
    vec![
        material::moduli(),
        material::incompressible(),
        material::auxetic(),
        scale::offset(),
        status::offset_gap(),
        scale::lengths(),
        scale::loads(),
        scale::slivers(),
        status::steep_edge(),
        status::gap_at_tolerance(),
        status::tolerance(),
        status::surfaces(),
        material::unit_diagonal(),
        scale::iterations(),
    ]
}

/// Sweeps each of `generators`, side by side.
pub fn measure(generators: &[Generator]) -> Vec<SweepTable> {
    generators.par_iter().map(Generator::measure).collect()
}
