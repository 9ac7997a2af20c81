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
mod precision;
mod remedies;
mod scale;
mod search;
mod status;
mod sweep;
mod verdict;

use rayon::prelude::*;
use serde::Serialize;

pub use sweep::{Break, Column, Method, Sweep};
pub use verdict::Verdict;

/// A family of problems with one magnitude.
pub struct Generator {
    /// Its name on the command line.
    pub name: &'static str,
    /// A line for people.
    pub title: &'static str,
    /// What is swept, with its unit.
    pub magnitude: &'static str,
    /// The magnitudes.
    pub sweep: Sweep,
    /// What is done with each.
    pub methods: Vec<Method>,
}

/// All generators.
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

/// What came of a generator.
#[derive(Clone, Debug, Serialize)]
pub struct Measured {
    /// The generator's name.
    pub name: &'static str,
    /// Its line for people.
    pub title: &'static str,
    /// What was swept.
    pub magnitude: &'static str,
    /// The magnitudes as words.
    pub labels: Vec<String>,
    /// The magnitudes; the number of a case, from 1, where they are no numbers.
    pub magnitudes: Vec<f64>,
    /// Whether the magnitudes are powers of ten.
    pub logarithmic: bool,
    /// What came of each method.
    pub columns: Vec<Column>,
}

impl Generator {
    /// Sweeps it.
    pub fn measure(&self) -> Measured {
        let points = self.sweep.points();
        let logarithmic = matches!(self.sweep, Sweep::Decades { .. });
        let magnitude =
            |p: &i32| self.sweep.magnitude(f64::from(*p)) + if logarithmic { 0.0 } else { 1.0 };
        Measured {
            name: self.name,
            title: self.title,
            magnitude: self.magnitude,
            labels: points.iter().map(|p| self.sweep.label(*p)).collect(),
            magnitudes: points.iter().map(magnitude).collect(),
            logarithmic,
            columns: self.methods.par_iter().map(|method| self.sweep.run(method)).collect(),
        }
    }
}

/// Sweeps each of `generators`, side by side.
pub fn measure(generators: &[Generator]) -> Vec<Measured> {
    generators.par_iter().map(Generator::measure).collect()
}
