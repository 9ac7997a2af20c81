//! Cook's membrane.

use super::line::{between, part};
use super::parameters::parameters;
use super::rows::Rows;
use super::{check, scene};
use crate::error::InputError;
use crate::problem::element::Plane;
use crate::problem::scene::{Axis, MeshBuilder, SceneBuilder};

parameters! {
    /// Cook's membrane: a tapered cantilever under a shear load of 1 on its right edge.
    ///
    /// Corners (0, 0), (48, 44), (48, 60), (0, 44); E = 1, nu = 1/3, plane stress. Vertical
    /// displacement of (48, 52): 23.96 in the limit.
    ///
    /// Source: R. D. Cook, "Improved two-dimensional finite element", J. Struct. Div. ASCE 100
    /// (1974) 1851-1863.
    #[command(after_help = "\
Examples:
  plane-contact mesh cook
  plane-contact mesh cook --n 32")]
    Cook {
        /// Divisions of each side; (48, 52) is a node where it is even.
        n: usize = 16,
    }
}

impl Cook {
    /// Generates the scene.
    ///
    /// # Errors
    /// There is no division, or there are too many.
    pub fn generate(&self) -> Result<SceneBuilder, InputError> {
        let n = self.n;
        check::count("--n", n, 1)?;
        let mut mesh = MeshBuilder::default();
        let membrane = Rows::grid(&mut mesh, "membrane", [n, n], |i, j| {
            let left = [0.0, part(0.0, 44.0, j, n)];
            let right = [48.0, part(44.0, 60.0, j, n)];
            between(left, right, part(0.0, 1.0, i, n))
        });
        mesh.edges("left", &membrane.starts());
        mesh.edges("right", &membrane.ends());
        Ok(scene("cook", mesh, Plane::Stress)
            .title("Cook's membrane")
            .material("membrane", 1.0, 1.0 / 3.0)
            .restrain("left", &[Axis::X, Axis::Y])
            .traction("right", [0.0, 1.0 / 16.0]))
    }
}
