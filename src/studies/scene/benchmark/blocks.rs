//! The contact patch test: two stacked blocks.

use super::line::part;
use super::parameters::parameters;
use super::rows::Rows;
use super::{check, frictionless, scene};
use base::error::Result;
use problem::element::Plane;
use problem::scene::{Axis, MeshBuilder, SceneBuilder};

parameters! {
    /// Contact patch test: two stacked blocks, sigma_y = -6.3 MPa everywhere.
    ///
    /// Each 50 x 25 mm, E = 30000 MPa, nu = 0.2, plane strain: von Mises 5.774 MPa, top
    /// displacement -0.010080 mm.
    #[command(after_help = "\
Examples:
  plane-contact scene mesh blocks
  plane-contact scene mesh blocks --upper 10 --lower 10      matching nodes")]
    Blocks {
        /// Divisions of the upper block along the contact line.
        upper: usize = 7,
        /// Divisions of the lower block along the contact line.
        lower: usize = 10,
    }
}

/// Width and height of a block, mm.
const SIZE: [f64; 2] = [50.0, 25.0];

impl Blocks {
    /// Generates the scene.
    ///
    /// # Errors
    /// There is no division, or there are too many.
    pub fn generate(&self) -> Result<SceneBuilder> {
        check::count("upper", self.upper, 1)?;
        check::count("lower", self.lower, 1)?;
        let mut mesh = MeshBuilder::default();
        let lower = block(&mut mesh, "lower", self.lower, 0.0);
        let upper = block(&mut mesh, "upper", self.upper, SIZE[1]);
        mesh.edges("bottom", lower.first());
        mesh.edges("target", lower.last());
        mesh.edges("contact", upper.first());
        mesh.edges("top", upper.last());
        mesh.edges("lower_left", &lower.starts());
        mesh.edges("upper_left", &upper.starts());
        Ok(scene("blocks", mesh, Plane::Strain)
            .title("Contact patch test: two stacked blocks")
            .units("mm", "MPa", "N")
            .material("lower", 30000.0, 0.2)
            .material("upper", 30000.0, 0.2)
            .restrain("bottom", &[Axis::Y])
            .restrain("lower_left", &[Axis::X])
            .restrain("upper_left", &[Axis::X])
            .pressure("top", 6.3)
            .contact(frictionless()))
    }
}

/// Adds a block with near square cells whose bottom is at `y`, mm.
fn block(mesh: &mut MeshBuilder, body: &str, columns: usize, y: f64) -> Rows {
    let [width, height] = SIZE;
    let rows = columns.div_ceil(2);
    Rows::grid(mesh, body, [columns, rows], |i, j| {
        [part(0.0, width, i, columns), part(y, y + height, j, rows)]
    })
}
