//! Plates without contact whose solution is known: a thick-walled cylinder (Lamé), a circular hole
//! in an infinite sheet (Kirsch), Cook's membrane, an elliptic membrane (NAFEMS LE1).

use std::f64::consts::FRAC_PI_2;

use super::line::{between, geometric, part, quarter};
use super::parameters::parameters;
use super::rows::Rows;
use super::{check, scene};
use base::error::Result;
use problem::element::Plane;
use problem::scene::{Axis, MeshBuilder, SceneBuilder};

parameters! {
    /// Lame: a quarter of a thick-walled cylinder under internal pressure.
    ///
    /// Radii 10 and 20 mm, 10 MPa inside, E = 30000 MPa, nu = 0.2, plane strain. At the bore: u =
    /// 0.00613333 mm, hoop stress 16.6667 MPa.
    ///
    /// Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 28.
    #[command(after_help = "\
Examples:
  plane-contact scene mesh annulus
  plane-contact scene mesh annulus --radial 32 --around 64")]
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
  plane-contact scene mesh hole
  plane-contact scene mesh hole --around 64 --outer 20")]
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
    /// There are fewer than two divisions, or too many; the outer radius is below 1.5 or
    /// beyond 1e6.
    pub fn generate(&self) -> Result<SceneBuilder> {
        check::count("around", self.around, 2)?;
        check::between("outer", self.outer, [1.5, 1e6])?;
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

    /// sigma_x, sigma_y, tau_xy of the closed form: unit tension in x, hole of radius 1 at (0, 0).
    pub fn stress([x, y]: [f64; 2]) -> [f64; 3] {
        let (a2, angle) = (1.0 / (x * x + y * y), y.atan2(x));
        let a4 = 1.5 * a2 * a2;
        let ((s2, c2), (s4, c4)) = ((2.0 * angle).sin_cos(), (4.0 * angle).sin_cos());
        [
            1.0 - a2 * (1.5 * c2 + c4) + a4 * c4,
            -a2 * (0.5 * c2 - c4) - a4 * c4,
            -a2 * (0.5 * s2 + s4) + a4 * s4,
        ]
    }
}

/// Traction of the closed form at the middle of the edge from `a` to `b`, which runs
/// counter-clockwise around the hole.
fn traction(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    let normal = [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
    let [xx, yy, xy] = Hole::stress([(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]);
    [xx * normal[0] + xy * normal[1], xy * normal[0] + yy * normal[1]]
}

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
  plane-contact scene mesh cook
  plane-contact scene mesh cook --n 32")]
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
    pub fn generate(&self) -> Result<SceneBuilder> {
        let n = self.n;
        check::count("n", n, 1)?;
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

parameters! {
    /// NAFEMS LE1: a quarter of an elliptic membrane under outward pressure.
    ///
    /// Inner ellipse 2 x 1 m, outer 3.25 x 2.75 m, thickness 0.1 m, 10 MPa outward on the outer
    /// edge, E = 210000 MPa, nu = 0.3, plane stress. sigma_y = 92.7 MPa at (2, 0).
    ///
    /// Source: NAFEMS, The Standard NAFEMS Benchmarks, TNSB rev. 3, 1990, test LE1.
    #[command(after_help = "\
Examples:
  plane-contact scene mesh ellipse
  plane-contact scene mesh ellipse --n 64")]
    Ellipse {
        /// Divisions between the ellipses and along each of them.
        n: usize = 16,
    }
}

/// Half axes of the inner and of the outer ellipse, m.
const INNER: [f64; 2] = [2.0, 1.0];
const OUTER: [f64; 2] = [3.25, 2.75];

impl Ellipse {
    /// Generates the scene.
    ///
    /// # Errors
    /// There are fewer than two divisions, or too many.
    pub fn generate(&self) -> Result<SceneBuilder> {
        let n = self.n;
        check::count("n", n, 2)?;
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
