//! The elliptic membrane, NAFEMS LE1.

use super::line::{between, part, quarter};
use super::parameters::parameters;
use super::rows::Rows;
use super::{check, scene};
use crate::error::InputError;
use crate::problem::element::Plane;
use crate::problem::scene::{Axis, MeshBuilder, SceneBuilder};

parameters! {
    /// NAFEMS LE1: a quarter of an elliptic membrane under outward pressure.
    ///
    /// Inner ellipse 2 x 1 m, outer 3.25 x 2.75 m, thickness 0.1 m, 10 MPa outward on the outer
    /// edge, E = 210000 MPa, nu = 0.3, plane stress. sigma_y = 92.7 MPa at (2, 0).
    ///
    /// Source: NAFEMS, The Standard NAFEMS Benchmarks, TNSB rev. 3, 1990, test LE1.
    #[command(after_help = "\
Examples:
  plane-contact mesh ellipse
  plane-contact mesh ellipse --n 64")]
    Ellipse {
        /// Divisions between the ellipses and along each of them.
        n: usize = 16,
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
    /// There are fewer than two divisions, or too many.
    pub fn generate(&self) -> Result<SceneBuilder, InputError> {
        let n = self.n;
        check::count("--n", n, 2)?;
        let mut mesh = MeshBuilder::default();
        let membrane = Rows::grid(&mut mesh, "membrane", [n, n], |i, j| {
            let [cos, sin] = quarter(i, n);
            let on = |axes: [f64; 2]| [axes[0] * cos, axes[1] * sin];
            between(on(INNER), on(OUTER), part(0.0, 1.0, j, n))
        });
        mesh.edges("inner", membrane.first());
        mesh.edges("outer", membrane.last());
        mesh.edges("x_axis", &membrane.starts());
        mesh.edges("y_axis", &membrane.ends());
        Ok(scene("ellipse", mesh, Plane::Stress)
            .title("Elliptic membrane (NAFEMS LE1)")
            .thickness(0.1)
            .units("m", "MPa", "MN")
            .material("membrane", 210000.0, 0.3)
            .restrain("x_axis", &[Axis::Y])
            .restrain("y_axis", &[Axis::X])
            .pressure("outer", -10.0))
    }
}
