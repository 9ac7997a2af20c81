//! The elliptic membrane, NAFEMS LE1.

use serde_json::json;

use super::builder::{Builder, Grid};
use super::line::{between, part, quarter};
use super::{Benchmark, check};
use crate::error::InputError;

/// NAFEMS LE1: a quarter of an elliptic membrane under outward pressure.
///
/// Inner ellipse 2 x 1 m, outer 3.25 x 2.75 m, thickness 0.1 m, 10 MPa outward on the outer edge, E = 210000 MPa, nu = 0.3,
/// plane stress. sigma_y = 92.7 MPa at (2, 0).
///
/// Source: NAFEMS, The Standard NAFEMS Benchmarks, TNSB rev. 3, 1990, test LE1.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "\
Examples:
  plane-contact mesh ellipse
  plane-contact mesh ellipse --n 64")]
pub struct Ellipse {
    /// Divisions between the ellipses and along each of them.
    #[arg(long, default_value_t = Ellipse::default().n)]
    pub n: usize,
}

impl Default for Ellipse {
    fn default() -> Self {
        Ellipse { n: 16 }
    }
}

/// Half axes of the inner ellipse, m.
const INNER: [f64; 2] = [2.0, 1.0];
/// Half axes of the outer ellipse, m.
const OUTER: [f64; 2] = [3.25, 2.75];

impl Ellipse {
    /// Generates the scene.
    ///
    /// # Errors
    /// Fewer than two divisions, or too many.
    pub fn generate(&self) -> Result<Benchmark, InputError> {
        let n = self.n;
        check::count("--n", n, 2)?;
        let mut builder = Builder::default();
        let grid = Grid::add(&mut builder, "membrane", [n, n], |i, j| {
            let [cos, sin] = quarter(i, n);
            let on = |axes: [f64; 2]| [axes[0] * cos, axes[1] * sin];
            between(on(INNER), on(OUTER), part(0.0, 1.0, j, n))
        });
        builder.edges("inner", grid.first());
        builder.edges("outer", grid.last());
        builder.edges("x_axis", &grid.starts());
        builder.edges("y_axis", &grid.ends());
        let scene = json!({
            "title": "Elliptic membrane (NAFEMS LE1)",
            "plane": "stress",
            "thickness": 0.1,
            "units": { "length": "m", "stress": "MPa", "force": "MN" },
            "materials": { "membrane": { "E": 210000.0, "nu": 0.3 } },
            "restraints": [{ "on": "x_axis", "fix": ["y"] }, { "on": "y_axis", "fix": ["x"] }],
            "loads": [{ "on": "outer", "pressure": -10.0 }],
            "variant": "unilateral"
        });
        Ok(Benchmark::new("ellipse", builder.finish(), scene))
    }
}
