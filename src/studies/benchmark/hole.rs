//! A circular hole in an infinite sheet under tension: Kirsch.

use std::f64::consts::FRAC_PI_2;

use super::line::{geometric, quarter};
use super::parameters::parameters;
use super::rows::Rows;
use super::{check, scene};
use crate::error::InputError;
use crate::problem::element::Plane;
use crate::problem::scene::{Axis, MeshBuilder, SceneBuilder};

parameters! {
    /// Kirsch: a circular hole in an infinite sheet under unit tension in x.
    ///
    /// Hole of radius 1, E = 1000, nu = 0.3, plane stress. A quarter of the sheet is cut out along
    /// a circle, and each outer edge carries the traction of the closed form at its middle: the
    /// sheet is infinite at any outer radius. At the hole sigma_x = 3 at (0, 1) and sigma_y = -1 at
    /// (1, 0).
    ///
    /// Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 35.
    #[command(after_help = "\
Examples:
  plane-contact mesh hole
  plane-contact mesh hole --around 64 --outer 20")]
    Hole {
        /// Divisions around the quarter; cells are near square.
        around: usize = 16,
        /// Radius at which the sheet is cut, in radii of the hole.
        outer: f64 = 5.0,
    }
}

impl Hole {
    /// Generates the scene.
    ///
    /// # Errors
    /// There are fewer than two divisions, or too many; the outer radius is below 1.5 or beyond
    /// 1e6.
    pub fn generate(&self) -> Result<SceneBuilder, InputError> {
        check::count("--around", self.around, 2)?;
        check::between("--outer", self.outer, [1.5, 1e6])?;
        let n = self.around;
        let radial = (self.outer.ln() * n as f64 / FRAC_PI_2).ceil() as usize;
        let mut mesh = MeshBuilder::default();
        let sheet = Rows::grid(&mut mesh, "sheet", [n, radial], |i, j| {
            quarter(i, n).map(|x| x * geometric(1.0, self.outer, j, radial))
        });
        mesh.edges("hole", sheet.first());
        mesh.edges("x_axis", &sheet.starts());
        mesh.edges("y_axis", &sheet.ends());
        let mut tractions = Vec::new();
        for (k, edge) in sheet.last().windows(2).enumerate() {
            let (group, [a, b]) = (format!("outer_{}", k + 1), [0, 1].map(|i| mesh.xy(edge[i])));
            mesh.edges(group.as_str(), edge);
            tractions.push((group, traction(a, b)));
        }
        let scene = scene("hole", mesh, Plane::Stress)
            .title("Circular hole in an infinite sheet under tension (Kirsch)")
            .material("sheet", 1000.0, 0.3)
            .restrain("x_axis", &[Axis::Y])
            .restrain("y_axis", &[Axis::X]);
        Ok(tractions.into_iter().fold(scene, |scene, (group, t)| scene.traction(group, t)))
    }
}

/// Traction of the closed form at the middle of the edge from `a` to `b`, which runs
/// counter-clockwise around the hole.
fn traction(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    let normal = [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
    let [xx, yy, xy] = stress([(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]);
    [xx * normal[0] + xy * normal[1], xy * normal[0] + yy * normal[1]]
}

/// sigma_x, sigma_y, tau_xy of the closed form: unit tension in x, hole of radius 1 at the origin.
fn stress([x, y]: [f64; 2]) -> [f64; 3] {
    let (a2, angle) = (1.0 / (x * x + y * y), y.atan2(x));
    let a4 = 1.5 * a2 * a2;
    let ((s2, c2), (s4, c4)) = ((2.0 * angle).sin_cos(), (4.0 * angle).sin_cos());
    [
        1.0 - a2 * (1.5 * c2 + c4) + a4 * c4,
        -a2 * (0.5 * c2 - c4) - a4 * c4,
        -a2 * (0.5 * s2 + s4) + a4 * s4,
    ]
}

#[cfg(test)]
mod tests {
    use super::stress;

    #[test]
    fn the_closed_form_has_its_known_values_at_the_hole_and_far_away() {
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-8);
        assert!(near(stress([0.0, 1.0]), [3.0, 0.0, 0.0]));
        assert!(near(stress([1.0, 0.0]), [0.0, -1.0, 0.0]));
        assert!(near(stress([3e5, 4e5]), [1.0, 0.0, 0.0]));
    }
}
