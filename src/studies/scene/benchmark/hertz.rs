//! A cylinder on a block: Hertz, NAFEMS CGS-1.

use std::f64::consts::{FRAC_PI_2, PI};

use super::confocal;
use super::line::{between, part};
use super::parameters::parameters;
use super::rows::Rows;
use super::{check, frictionless, scene};
use base::error::{InputError, Result};
use base::plain::six_digits;
use problem::element::Plane;
use problem::modelling::Geometry;
use problem::scene::{Axis, Contact, MeshBuilder, SceneBuilder};

parameters! {
    /// Hertz, NAFEMS CGS-1: a cylinder pressed on a block, frictionless.
    ///
    /// Half model of a cylinder of radius 50 mm (E = 210000 MPa) on a block of 200 x 200 mm (E =
    /// 70000 MPa), nu = 0.3, plane strain, 35000 N/mm, of which the model carries half: half width
    /// 6.2146 mm, peak pressure 3585.4 MPa. The load is a point load on the top of the whole
    /// cylinder, as in the benchmark: a pressure on the diameter of a lower half would bend that
    /// half and with it the contact arc, where the point load is a diameter away.
    ///
    /// Contact is measured in the initial shape, as Hertz's theory of small displacements does: in
    /// the current one the peak is 0.8 % higher at any mesh, for the surfaces shorten under the
    /// pressure.
    ///
    /// Source: NAFEMS, Benchmark Tests for Various Finite Element Contact Problems, CGS-1; closed
    /// form: K. L. Johnson, Contact Mechanics, 1985, section 4.2.
    #[command(after_help = "\
Examples:
  plane-contact scene mesh hertz                about 4,000 equations
  plane-contact scene mesh hertz --size 59      about 30,000")]
    Hertz {
        /// Elements on the contact half width.
        size: usize = 20,
        /// Radius of the cylinder, mm.
        radius: f64 = 50.0,
        /// Load on the whole cylinder, N/mm.
        load: f64 = 35000.0,
    }
}

/// Elastic moduli of the cylinder and the block, MPa.
const E: [f64; 2] = [210000.0, 70000.0];
const NU: f64 = 0.3;

/// Half width of the face of fine cells over that of the contact; the surfaces that may touch reach
/// to `REACH` of it.
const FACE: f64 = 1.25;
const REACH: f64 = 2.0;

impl Hertz {
    /// Half width of the contact by the closed form, length.
    pub fn half_width(&self) -> f64 {
        let compliance: f64 = E.iter().map(|e| (1.0 - NU * NU) / e).sum();
        (4.0 * self.load * self.radius * compliance / PI).sqrt()
    }

    /// Generates the scene.
    ///
    /// # Errors
    /// There are fewer than four elements, or too many; the radius or the load is not
    /// positive; the half width is beyond a quarter of the radius.
    pub fn generate(&self) -> Result<SceneBuilder> {
        check::count("size", self.size, 4)?;
        check::positive("radius", self.radius)?;
        check::positive("load", self.load)?;
        let (a, most) = (self.half_width(), self.radius / 4.0);
        if a <= 1e-3 * self.radius || a >= most || a.is_nan() {
            let a = six_digits(a);
            let what = format!("the contact's half width {a} mm is outside 0.001 to 0.25 radii");
            let fix = "choose a load for which Hertz's theory holds";
            return Err(InputError::new("load", what, fix));
        }
        let mut mesh = MeshBuilder::default();
        self.add_block(&mut mesh);
        let top = self.add_cylinder(&mut mesh);
        Ok(scene("hertz", mesh, Plane::Strain)
            .title("Cylinder on a block (Hertz, NAFEMS CGS-1)")
            .units("mm", "MPa", "N")
            .material("block", E[1], NU)
            .material("cylinder", E[0], NU)
            .restrain("bottom", &[Axis::Y])
            .restrain("block_axis", &[Axis::X])
            .restrain("cylinder_axis", &[Axis::X])
            .force(top, [0.0, -self.load / 2.0])
            .contact(Contact { geometry: Geometry::Initial, ..frictionless() }))
    }

    /// Half width of the face, length.
    fn face(&self) -> f64 {
        FACE * self.half_width()
    }

    /// Segments of the face: `size` on the half width where they are longest, at the axis.
    fn segments(&self) -> usize {
        (self.size as f64 * FACE * FRAC_PI_2).round() as usize
    }

    /// Adds the block, 2 x 4 radii: ellipses as far as 0.8 radii, then rows turning into its sides.
    fn add_block(&self, mesh: &mut MeshBuilder) {
        let (r, c) = (self.radius, self.face());
        let rings = confocal::rings(self.segments(), (0.8 * r / c).acosh());
        let mut rows = confocal::rows(mesh, c, &rings, |[x, y]| [x, -y]);
        let ellipse = rows.last().to_vec();
        let n = ellipse.len() - 1;
        let sides = sides(2.0 * r, n);
        let steps = n.div_ceil(2);
        for k in 1..=steps {
            let s = part(0.0, 1.0, k, steps);
            let point = |i: usize| between(mesh.xy(ellipse[i]), sides[i], s * (1.0 + s) / 2.0);
            let points: Vec<_> = (0..=n).map(point).collect();
            rows.0.push(mesh.row(points));
        }
        let corner = sides.iter().position(|p| p[1] == -4.0 * r).expect("the corner is a node");
        join_to_corner(mesh, &rows, rings.len(), corner);
        mesh.edges("bottom", &rows.last()[corner..]);
        mesh.edges("block_axis", &rows.ends());
        mesh.edges("target", &confocal::surface(mesh, &rows, REACH * self.half_width()));
    }

    /// Adds the cylinder; returns the node at its top.
    fn add_cylinder(&self, mesh: &mut MeshBuilder) -> usize {
        let (r, c) = (self.radius, self.face());
        let mut rings = confocal::rings(self.segments(), (6.0 * r / c).acosh());
        // The segments of the last rings are halved, down to the four of the fan at the top.
        let mut segments = rings[rings.len() - 1].segments;
        let halvings = (segments.div_ceil(4) as f64).log2().ceil() as usize;
        let from = rings.len() - halvings;
        for ring in &mut rings[from..] {
            segments = segments.div_ceil(2);
            ring.segments = segments;
        }
        // From the upper half plane onto the disk that touches it at the origin, conformally; far away goes
        // to the top.
        let onto_disk = |[x, y]: [f64; 2]| {
            let (p, q) = (1.0 + y / (2.0 * r), x / (2.0 * r));
            let norm = p * p + q * q;
            [(x * p - y * q) / norm, (x * q + y * p) / norm]
        };
        let mut rows = confocal::rows(mesh, c, &rings, onto_disk);
        let top = mesh.node([0.0, 2.0 * r]);
        rows.0.push(vec![top]);
        mesh.join_all("cylinder", &rows.0);
        mesh.edges("cylinder_axis", &rows.ends());
        mesh.edges("contact", &confocal::surface(mesh, &rows, REACH * self.half_width()));
        top
    }
}

/// Joins the block's rows: `ellipses` of them, then those that turn into its sides, cut towards
/// node `corner` from either side.
fn join_to_corner(mesh: &mut MeshBuilder, rows: &Rows, ellipses: usize, corner: usize) {
    mesh.join_all("block", &rows.0[..ellipses]);
    for pair in rows.0[ellipses - 1..].windows(2) {
        let backwards = |row: &[usize]| row.iter().rev().copied().collect::<Vec<_>>();
        mesh.join("block", &backwards(&pair[0][..=corner]), &backwards(&pair[1][..=corner]));
        mesh.join("block", &pair[0][corner..], &pair[1][corner..]);
    }
}

/// Points on the right side and the bottom of the block of half width `b` and depth 2 b, from the
/// surface to the axis.
fn sides(b: f64, n: usize) -> Vec<[f64; 2]> {
    let right = (n * 7 / 10).max(1);
    let side = (0..right).map(|k| [b, part(0.0, -2.0 * b, k, right)]);
    let bottom = (0..=n - right).map(|k| [part(b, 0.0, k, n - right), -2.0 * b]);
    side.chain(bottom).collect()
}
