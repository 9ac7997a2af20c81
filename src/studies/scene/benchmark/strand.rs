//! The paper's example: a strand in a duct of a concrete block.
//!
//! ```text
//!             top
//!      +---------------+       block   the duct in its middle, whose centre is the origin
//!      |     .---.     |       stamp   the lower half of a disc that touches the duct's lowest
//! left |    (     )    | right         point, a node of each there
//!      |    (=====)    |
//!      |     '---'     |       The arc and the wall are cut at the same angles: the stamp's
//!      +---------------+       polygon is the wall's, shrunk by the ratio of the radii about the
//!            bottom            point of contact, so it lies in the wall's, which is convex. The
//!                              two edges beside that point lie on the wall's; no others touch.
//! ```

use std::f64::consts::FRAC_PI_2;

use super::line::{cos_sin, graded, quarter};
use super::mirrored::Mirrored;
use super::parameters::parameters;
use super::{check, scene};
use base::error::{InputError, Result};
use problem::element::Plane;
use problem::modelling::Variant;
use problem::scene::{Axis, Contact, MeshBuilder, SceneBuilder};

parameters! {
    /// The paper's example, remeshed: a strand pressed on the wall of its duct in a concrete block.
    ///
    /// Near what is known in closed form: Hertz's line contact of nearly conforming circles, R = R1 R2
    /// / (R2 - R1), and Persson's (1964; Ciavarella and Decuzzi, 2001) of a disc in a hole, whose arc
    /// of contact may be wide. Both take the bodies for unbounded. For the default radii, half width
    /// and peak pressure are 1.610 mm and 37.86 MPa, and 1.588 mm and 38.60 MPa. It is the embedded
    /// scene `strand` with another mesh, for any radii and edge length.
    ///
    /// From the paper: a block of 50 x 50 mm, E = 30000 MPa, nu = 0.2; a stamp with E = 210000 MPa,
    /// nu = 0.3, simplified with its contact surface kept; 6.3 MPa on its top; symmetry on the
    /// outer sides; c_tol = 0.001; 20 iterations.
    ///
    /// Our assumption: a circular duct in the middle of the block; the stamp is the lower half of a
    /// disc (a strand 15K7 is 15.2 mm thick) that touches the duct's lowest point, cut at its
    /// centre's height; plane strain, thickness 1 mm; the stamp's axis is restrained in x; c_tol is
    /// in mm. The mesh is ours too: mirror-symmetric about x = 0, both arcs cut at the same angles,
    /// so that the initial polygons touch beside the lowest point only and do not overlap, however
    /// close the radii.
    #[command(after_help = "\
Examples:
  plane-contact scene mesh strand                              some 1,100 nodes
  plane-contact scene mesh strand --duct 7.61 --size 0.25      nearly conforming
  plane-contact scene mesh strand --duct 20 --strand 7.6       a wide duct
  plane-contact scene mesh strand --top 0.5                    a stamp a quarter of the disc high")]
    Strand {
        /// Radius of the duct, mm.
        duct: f64 = 7.7,
        /// Radius of the strand, mm.
        strand: f64 = 7.6,
        /// Length of the edges on the lower half of the duct's wall, mm; those on the stamp's arc
        /// are shorter by strand / duct, those far away up to 9 times longer.
        size: f64 = 0.45,
        /// Height of the stamp's flat top above its lowest point over the strand's radius, 1 being
        /// half a disc; lower ones end at the nearest node of the arc.
        top: f64 = 1.0,
    }
}

/// Half the side of the block, mm.
const SIDE: f64 = 25.0;
/// The duct's least and largest radius, mm: between it and the block's sides stay 3 mm.
const DUCT: [f64; 2] = [1.0, 22.0];
/// The duct's radius over the strand's, at most: edges of equal angle are so much shorter there.
const WIDEST: f64 = 3.0;
/// The shortest edge length, mm: some 280,000 nodes.
const FINEST: f64 = 0.0125;
/// The longest over the strand's radius, for ten edges on a quarter of its arc, and over the width
/// of the block beside the duct. In these limits, from 0.05 mm, some 2,800 meshes had no angle below 21
/// degrees.
const COARSEST: f64 = 0.16;
const ACROSS: f64 = 0.4;

/// The lowest and the highest top over the strand's radius: five edges on half of the lowest arc.
const TOP: [f64; 2] = [0.3, 1.7];

/// Edge lengths over `size`: at the duct's highest point, and the longest anywhere.
const ROOF: f64 = 10.0 / 3.0;
const FAR: f64 = 9.0;
/// Growth of the edge length with the distance from an arc.
const GROWTH: f64 = 0.19;

impl Strand {
    /// Generates the scene.
    ///
    /// # Errors
    /// Those of [`Strand::check`].
    pub fn generate(&self) -> Result<SceneBuilder> {
        self.check()?;
        let mut mesh = MeshBuilder::default();
        self.add_block(&mut mesh);
        self.add_stamp(&mut mesh);
        let Strand { duct, strand, .. } = self;
        let title = format!("Strand of radius {strand} mm in a duct of radius {duct} mm");
        Ok(scene("strand", mesh, Plane::Strain)
            .title(title)
            .units("mm", "MPa", "N")
            .material("block", 30000.0, 0.2)
            .material("stamp", 210000.0, 0.3)
            .restrain("left", &[Axis::X])
            .restrain("right", &[Axis::X])
            .restrain("bottom", &[Axis::Y])
            .restrain("top", &[Axis::Y])
            .restrain("stamp_axis", &[Axis::X])
            .pressure("stamp_top", 6.3)
            .contact(Contact::new("stamp_arc", "duct_wall", 0.001))
            .variant(Variant::Stepped))
    }

    /// Checks the parameters.
    ///
    /// # Errors
    /// The duct's radius is outside 1 to 22 mm; the strand's is outside a third of it to the
    /// whole; the size is outside 0.0125 mm to 0.16 of the strand's radius, or beyond 0.4 of the width
    /// of the block beside the duct; the top is outside 0.3 to 1.7, or above 1 where the chords of the
    /// wall would cut into the disc.
    pub fn check(&self) -> Result<()> {
        check::between("duct", self.duct, DUCT)?;
        check::between("strand", self.strand, [self.duct / WIDEST, self.duct])?;
        let coarsest = (COARSEST * self.strand).min(ACROSS * (SIDE - self.duct));
        check::between("size", self.size, [FINEST, coarsest])?;
        check::between("top", self.top, TOP)?;
        // Chords of the upper wall leave the disc room where it rises above its centre: there the two are as
        // far apart as their radii at least.
        let Strand { duct, strand, size, top } = *self;
        let height = ((strand * top - duct) / duct).max(0.0);
        let chord = size * (1.0 + (ROOF - 1.0) * height);
        let sagitta = chord * chord / (8.0 * duct);
        if top <= 1.0 || sagitta <= duct - strand {
            return Ok(());
        }
        let what = format!("chords of the wall cut {sagitta:.2e} mm into the duct beside the disc");
        let fix = "give 1 at most, a shorter size or a wider duct";
        Err(InputError::new("top", what, fix))
    }

    /// Edges on a quarter of the lower wall, and on a quarter of the stamp's arc.
    fn edges(&self) -> usize {
        (self.duct * FRAC_PI_2 / self.size).round() as usize
    }

    /// Adds the block, its sides and the duct's wall, all counter-clockwise.
    fn add_block(&self, mesh: &mut MeshBuilder) {
        let (r, n) = (self.duct, self.edges());
        // Longer with the height on the upper half of the wall, and with the distance from the wall.
        let size = |[x, y]: [f64; 2]| {
            let distance = x.hypot(y);
            let height = (y / distance).max(0.0);
            let at_wall = self.size * (1.0 + (ROOF - 1.0) * height);
            (at_wall + GROWTH * (distance - self.duct).max(0.0)).min(FAR * self.size)
        };
        let side = |a, b| graded(straight(a, b), size);
        let curves = [
            side([0.0, -SIDE], [SIDE, -SIDE]),
            side([SIDE, -SIDE], [SIDE, SIDE]),
            side([SIDE, SIDE], [0.0, SIDE]),
            side([0.0, SIDE], [0.0, r]),
            graded(|s| cos_sin(1.0 - s).map(|x| x * r), size),
            (0..=n).map(|k| quarter(k, n)).map(|[cos, sin]| [r * cos, -r * sin]).collect(),
            side([0.0, -r], [0.0, -SIDE]),
        ];
        let block = Mirrored::add(mesh, "block", &curves, size);
        let (bottom, right, top, upper_wall, lower_wall) = (0, 1, 2, 4, 5);
        mesh.edges("bottom", &reversed(&block.left[bottom]));
        mesh.edges("bottom", &block.right[bottom]);
        mesh.edges("right", &block.right[right]);
        mesh.edges("top", &block.right[top]);
        mesh.edges("top", &reversed(&block.left[top]));
        mesh.edges("left", &reversed(&block.left[right]));
        mesh.edges("duct_wall", &block.left[lower_wall]);
        mesh.edges("duct_wall", &reversed(&block.right[lower_wall]));
        mesh.edges("duct_wall", &reversed(&block.right[upper_wall]));
        mesh.edges("duct_wall", &block.left[upper_wall]);
    }

    /// Adds the stamp, its arc, what the disc has above its centre, and its top counter-clockwise, its
    /// axis upwards. The contact surface is the arc below the centre.
    fn add_stamp(&self, mesh: &mut MeshBuilder) {
        let (r, n, lowest) = (self.strand, self.edges(), -self.duct);
        // Longer with the distance from its arc.
        let size = |[x, y]: [f64; 2]| {
            let depth = self.strand - x.hypot(y + self.duct - self.strand);
            self.size * self.strand / self.duct + GROWTH * depth.max(0.0)
        };
        let at = |[cos, sin]: [f64; 2]| [r * sin, lowest + r * (1.0 - cos)];
        // The angle from the lowest point to the end of the top, in right angles.
        let end = (1.0 - self.top).acos() / FRAC_PI_2;
        let edges = ((n as f64 * end).round() as usize).min(n);
        let side = |s: f64| {
            let [cos, sin] = cos_sin((end - 1.0) * s);
            at([-sin, cos])
        };
        let mut curves = vec![(0..=edges).map(|k| at(quarter(k, n))).collect()];
        if self.top > 1.0 {
            curves.push(graded(side, size));
        }
        let [x, flat] = *curves.iter().flatten().next_back().expect("the arc has nodes");
        let (arc, top, axis) = (0, curves.len(), curves.len() + 1);
        curves.push(graded(straight([x, flat], [0.0, flat]), size));
        curves.push(graded(straight([0.0, flat], [0.0, lowest]), size));
        let stamp = Mirrored::add(mesh, "stamp", &curves, size);
        mesh.edges("stamp_arc", &reversed(&stamp.left[arc]));
        mesh.edges("stamp_arc", &stamp.right[arc]);
        mesh.edges("stamp_top", &stamp.right[top]);
        mesh.edges("stamp_top", &reversed(&stamp.left[top]));
        mesh.edges("stamp_axis", &reversed(&stamp.right[axis]));
    }
}

/// The straight line from `a` to `b` at s from 0 to 1; both ends exact.
fn straight(a: [f64; 2], b: [f64; 2]) -> impl Fn(f64) -> [f64; 2] {
    move |s| if s == 1.0 { b } else { [0, 1].map(|k| a[k] + (b[k] - a[k]) * s) }
}

fn reversed(nodes: &[usize]) -> Vec<usize> {
    nodes.iter().rev().copied().collect()
}
