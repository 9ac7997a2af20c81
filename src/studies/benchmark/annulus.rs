//! A thick-walled cylinder under internal pressure: Lamé.

use serde_json::json;

use super::builder::{Builder, Grid};
use super::line::{part, quarter};
use super::{Benchmark, check};
use crate::error::InputError;

/// Lame: a quarter of a thick-walled cylinder under internal pressure.
///
/// Radii 10 and 20 mm, 10 MPa inside, E = 30000 MPa, nu = 0.2, plane strain. At the bore: u = 0.00613333 mm, hoop stress
/// 16.6667 MPa.
///
/// Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 28.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact mesh annulus
  plane-contact mesh annulus --radial 32 --around 64")]
pub struct Annulus {
    /// Divisions through the wall.
    #[arg(long, default_value_t = Annulus::default().radial)]
    pub radial: usize,
    /// Divisions around the quarter.
    #[arg(long, default_value_t = Annulus::default().around)]
    pub around: usize,
}

impl Default for Annulus {
    fn default() -> Self {
        Annulus { radial: 8, around: 16 }
    }
}

/// Inner and outer radius, mm.
const RADII: [f64; 2] = [10.0, 20.0];

impl Annulus {
    /// Generates the scene.
    ///
    /// # Errors
    /// No division, or too many.
    pub fn generate(&self) -> Result<Benchmark, InputError> {
        check::count("--radial", self.radial, 1)?;
        check::count("--around", self.around, 2)?;
        let mut builder = Builder::default();
        let grid = Grid::add(&mut builder, "wall", [self.around, self.radial], |i, j| {
            quarter(i, self.around).map(|x| x * part(RADII[0], RADII[1], j, self.radial))
        });
        builder.edges("inner", grid.first());
        builder.edges("outer", grid.last());
        builder.edges("x_axis", &grid.starts());
        builder.edges("y_axis", &grid.ends());
        let scene = json!({
            "title": "Thick-walled cylinder under internal pressure (Lamé)",
            "plane": "strain",
            "units": { "length": "mm", "stress": "MPa", "force": "N" },
            "materials": { "wall": { "E": 30000.0, "nu": 0.2 } },
            "restraints": [{ "on": "x_axis", "fix": ["y"] }, { "on": "y_axis", "fix": ["x"] }],
            "loads": [{ "on": "inner", "pressure": 10.0 }],
            "variant": "unilateral"
        });
        Ok(Benchmark::new("annulus", builder.finish(), scene))
    }
}
