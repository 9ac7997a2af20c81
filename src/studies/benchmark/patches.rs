//! Contact patch tests: two stacked blocks; a punch on a wider foundation (Taylor and
//! Papadopoulos).

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

parameters! {
    /// Taylor and Papadopoulos' contact patch test: a punch on the middle of a wider foundation,
    /// one pressure on both.
    ///
    /// Foundation 8 x 5, punch 2 x 2, E = 1000, nu = 0.4, plane strain. The pressure acts on the
    /// punch's top and on what the punch leaves free of the foundation's top, so sigma_y =
    /// -pressure everywhere and nothing else but sigma_z.
    ///
    /// Source: R. L. Taylor, P. Papadopoulos, "On a patch test for contact problems in two
    /// dimensions", in Computational Methods in Nonlinear Mechanics, Springer, 1991.
    #[command(after_help = "\
Examples:
  plane-contact scene mesh punch-patch
  plane-contact scene mesh punch-patch --punch 4 --foundation 4      matching nodes")]
    PunchPatch {
        /// Divisions of the punch along the contact line, even.
        punch: usize = 6,
        /// Divisions of the foundation below the punch, even.
        foundation: usize = 4,
        /// The pressure.
        pressure: f64 = 1.0,
    }
}

const PUNCH: f64 = 1.0;
const FOUNDATION: f64 = 4.0;
/// Heights of the foundation, and of the punch on it.
const TOP: f64 = 5.0;
const ALL: f64 = 7.0;

impl PunchPatch {
    /// Generates the scene.
    ///
    /// # Errors
    /// A number of divisions is odd, zero or too large; the pressure is not positive.
    pub fn generate(&self) -> Result<SceneBuilder> {
        check::even("punch", self.punch)?;
        check::even("foundation", self.foundation)?;
        check::positive("pressure", self.pressure)?;
        let mut mesh = MeshBuilder::default();
        self.add_foundation(&mut mesh);
        let n = self.punch;
        let punch = Rows::grid(&mut mesh, "punch", [n, n], |i, j| {
            [part(-PUNCH, PUNCH, i, n), part(TOP, ALL, j, n)]
        });
        mesh.edges("contact", punch.first());
        mesh.edges("punch_top", punch.last());
        mesh.edges("punch_axis", &punch.column(n / 2));
        Ok(scene("punch-patch", mesh, Plane::Strain)
            .title("Contact patch test of Taylor and Papadopoulos")
            .material("foundation", 1000.0, 0.4)
            .material("punch", 1000.0, 0.4)
            .restrain("bottom", &[Axis::Y])
            .restrain("foundation_axis", &[Axis::X])
            .restrain("punch_axis", &[Axis::X])
            .pressure("punch_top", self.pressure)
            .pressure("free_left", self.pressure)
            .pressure("free_right", self.pressure)
            .contact(frictionless()))
    }

    /// Adds the foundation: `foundation` columns below the punch, as wide ones on both sides of it.
    fn add_foundation(&self, mesh: &mut MeshBuilder) {
        let (below, beside) = (self.foundation, self.foundation * 3 / 2);
        let rows = self.foundation * 5 / 2;
        let x = |i: usize| match i {
            i if i < beside => part(-FOUNDATION, -PUNCH, i, beside),
            i if i <= beside + below => part(-PUNCH, PUNCH, i - beside, below),
            i => part(PUNCH, FOUNDATION, i - beside - below, beside),
        };
        let foundation = Rows::grid(mesh, "foundation", [below + 2 * beside, rows], |i, j| {
            [x(i), part(0.0, TOP, j, rows)]
        });
        let top = foundation.last();
        mesh.edges("bottom", foundation.first());
        mesh.edges("foundation_axis", &foundation.column(beside + below / 2));
        mesh.edges("target", top);
        mesh.edges("free_left", &top[..=beside]);
        mesh.edges("free_right", &top[beside + below..]);
    }
}
