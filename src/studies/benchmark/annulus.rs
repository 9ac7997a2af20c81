//! A thick-walled cylinder under internal pressure: Lamé.

use super::line::{part, quarter};
use super::parameters::parameters;
use super::rows::Rows;
use super::{check, scene};
use crate::error::InputError;
use crate::problem::element::Plane;
use crate::problem::scene::{Axis, MeshBuilder, SceneBuilder};

parameters! {
    /// Lame: a quarter of a thick-walled cylinder under internal pressure.
    ///
    /// Radii 10 and 20 mm, 10 MPa inside, E = 30000 MPa, nu = 0.2, plane strain. At the bore: u =
    /// 0.00613333 mm, hoop stress 16.6667 MPa.
    ///
    /// Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 28.
    #[command(after_help = "\
Examples:
  plane-contact mesh annulus
  plane-contact mesh annulus --radial 32 --around 64")]
    Annulus {
        /// Divisions through the wall.
        radial: usize = 8,
        /// Divisions around the quarter.
        around: usize = 16,
    }
}

/// Inner and outer radius, mm.
const RADII: [f64; 2] = [10.0, 20.0];

impl Annulus {
    /// Generates the scene.
    ///
    /// # Errors
    /// There is no division, or there are too many.
    pub fn generate(&self) -> Result<SceneBuilder, InputError> {
        check::count("--radial", self.radial, 1)?;
        check::count("--around", self.around, 2)?;
        let mut mesh = MeshBuilder::default();
        let wall = Rows::grid(&mut mesh, "wall", [self.around, self.radial], |i, j| {
            quarter(i, self.around).map(|x| x * part(RADII[0], RADII[1], j, self.radial))
        });
        mesh.edges("inner", wall.first());
        mesh.edges("outer", wall.last());
        mesh.edges("x_axis", &wall.starts());
        mesh.edges("y_axis", &wall.ends());
        Ok(scene("annulus", mesh, Plane::Strain)
            .title("Thick-walled cylinder under internal pressure (Lamé)")
            .units("mm", "MPa", "N")
            .material("wall", 30000.0, 0.2)
            .restrain("x_axis", &[Axis::Y])
            .restrain("y_axis", &[Axis::X])
            .pressure("inner", 10.0))
    }
}
