//! A plate whose solution is known: a thick-walled cylinder (Lamé).

use super::line::{part, quarter};
use super::rows::Rows;
use super::{check, scene};
use base::error::Result;
use problem::element::Plane;
use problem::scene::{Axis, MeshBuilder, SceneBuilder};

/// A quarter of a thick-walled cylinder under internal pressure.
///
/// Radii 10 and 20 mm, 10 MPa inside, E = 30000 MPa, nu = 0.2, plane strain. At the bore: u =
/// 0.00613333 mm, hoop stress 16.6667 MPa.
///
/// Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 28.
#[derive(Clone, Debug)]
pub struct Annulus {
    /// Divisions through the wall.
    pub radial: usize,
    /// Divisions around the quarter.
    pub around: usize,
}

/// Inner and outer radius, mm.
const RADII: [f64; 2] = [10.0, 20.0];

impl Annulus {
    /// Generates the scene.
    ///
    /// # Errors
    /// There is no division, or there are too many.
    pub fn generate(&self) -> Result<SceneBuilder> {
        check::count("radial", self.radial, 1)?;
        check::count("around", self.around, 2)?;
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
