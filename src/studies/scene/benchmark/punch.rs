//! A flat rigid punch on a half plane.

use super::line::{part, quarter};
use super::parameters::parameters;
use super::rows::Rows;
use super::{check, confocal, frictionless, scene};
use base::error::Result;
use problem::element::Plane;
use problem::scene::{Axis, MeshBuilder, SceneBuilder};

parameters! {
    /// A flat stiff punch, frictionless, on a half plane: p(x) = P / (pi sqrt(a^2 - x^2)).
    ///
    /// Half model: punch a x a with a = 1 and E = 1e7, foundation E = 1000, nu = 0.3, plane strain,
    /// P = 2 on both halves (1 on the model). The foundation ends, restrained, along an ellipse
    /// that is nearly a circle of radius --outer. Nodes on the contact line stand at a cos(angle),
    /// equal angles apart, so each carries the same share of P in the closed form, the two end
    /// nodes half of it.
    ///
    /// Source: K. L. Johnson, Contact Mechanics, 1985, section 2.8.
    #[command(after_help = "\
Examples:
  plane-contact scene mesh punch
  plane-contact scene mesh punch --punch 24 --foundation 32 --outer 50")]
    Punch {
        /// Divisions of the punch along the contact line.
        punch: usize = 24,
        /// Divisions of the foundation along the contact line.
        foundation: usize = 24,
        /// Radius of the foundation, in half widths of the punch.
        outer: f64 = 20.0,
    }
}

impl Punch {
    /// Generates the scene.
    ///
    /// # Errors
    /// There are fewer than four divisions, or too many; the outer radius is below 2 or
    /// beyond 1e4.
    pub fn generate(&self) -> Result<SceneBuilder> {
        check::count("punch", self.punch, 4)?;
        check::count("foundation", self.foundation, 4)?;
        check::between("outer", self.outer, [2.0, 1e4])?;
        let mut mesh = MeshBuilder::default();
        let rings = confocal::rings(self.foundation, self.outer.acosh());
        let foundation = confocal::rows(&mut mesh, 1.0, &rings, |[x, y]| [x, -y]);
        mesh.join_all("foundation", &foundation.0);
        mesh.edges("outer", foundation.last());
        mesh.edges("foundation_axis", &foundation.ends());
        mesh.edges("target", &confocal::surface(&mesh, &foundation, 1.5));
        // The columns of the punch are the foundation's angles, from the axis to the corner.
        let (n, rows) = (self.punch, self.punch.div_ceil(2));
        let punch = Rows::grid(&mut mesh, "punch", [n, rows], |i, j| {
            [quarter(n - i, n)[0], part(0.0, 1.0, j, rows)]
        });
        mesh.edges("contact", punch.first());
        mesh.edges("top", punch.last());
        mesh.edges("punch_axis", &punch.starts());
        Ok(scene("punch", mesh, Plane::Strain)
            .title("Flat punch on a half plane")
            .material("foundation", 1000.0, 0.3)
            .material("punch", 1e7, 0.3)
            .restrain("outer", &[Axis::X, Axis::Y])
            .restrain("foundation_axis", &[Axis::X])
            .restrain("punch_axis", &[Axis::X])
            .pressure("top", 1.0)
            .contact(frictionless()))
    }
}
