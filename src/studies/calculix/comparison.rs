//! The differences between two results of one model.

use serde::Serialize;

use super::fields::Fields;
use numbers::finite;
use problem::model::{Body, Model, NodeId, TriangleId};

/// Two results of one model, node by node and triangle by triangle.
pub struct Comparison {
    /// What this program computed.
    pub ours: Fields,
    /// What `ccx` computed.
    pub theirs: Fields,
    /// Von Mises stress of each triangle, by this program and by CalculiX.
    pub von_mises: [Vec<f64>; 2],
    /// The differences of the displacements, by node.
    pub displacement: Difference<NodeId>,
    /// Stresses, by triangle: the largest component of sigma_x, sigma_y, tau_xy; relative to
    /// CalculiX's largest von Mises stress.
    pub stress: Difference<TriangleId>,
    /// The largest von Mises stress of each body, by both.
    pub bodies: Vec<BodyStress>,
}

/// A difference, place by place: at nodes or at triangles.
#[derive(Serialize)]
pub struct Difference<Place> {
    /// Every place, in order, and the difference there.
    #[serde(skip)]
    pub at: Vec<(Place, f64)>,
    /// The largest difference, and where it is.
    pub largest: Largest<Place>,
    /// Root of the mean of the squares of all differences.
    pub rms: f64,
}

/// The largest difference, where it is, and against what: every share is of CalculiX's value.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Largest<Place> {
    /// Where it is.
    pub at: Place,
    /// The difference there, length or stress.
    pub difference: f64,
    /// The largest value by CalculiX.
    pub scale: f64,
    /// Difference over scale; 0 where both are 0, and null where the scale alone is.
    pub relative: Option<f64>,
}

/// The stresses of a body by both programs.
#[derive(Clone, Debug, Serialize)]
pub struct BodyStress {
    /// The name of the body.
    pub name: String,
    /// Its largest stress by this program.
    pub ours: f64,
    /// Its largest stress by CalculiX.
    pub calculix: f64,
}

impl BodyStress {
    /// Returns the difference of the two over CalculiX's; None where that is 0.
    pub fn relative(&self) -> Option<f64> {
        over(self.ours - self.calculix, self.calculix)
    }
}

impl Comparison {
    /// Puts `ours` beside `theirs`, two results of `model`.
    pub fn new(model: &Model, ours: Fields, theirs: Fields) -> Self {
        let length = |[x, y]: &[f64; 2]| x.hypot(*y);
        let apart = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).hypot(a[1] - b[1]);
        // sigma_x, sigma_y, tau_xy: sigma_z is no unknown of a plane problem.
        let stressed = |(a, b): (&[f64; 6], &[f64; 6])| {
            [0, 1, 3].into_iter().map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
        };
        let von_mises = [ours.von_mises(), theirs.von_mises()];
        let body = |body: &Body| {
            let stresses = |of: &Vec<f64>| largest(body.triangles.iter().map(|id| of[id.index()]));
            let [ours, calculix] = von_mises.each_ref().map(stresses);
            BodyStress { name: body.name.clone(), ours, calculix }
        };
        let u = ours.u.iter().zip(&theirs.u).map(apart);
        let stress = ours.sigma.iter().zip(&theirs.sigma).map(stressed);
        let (u_scale, stress_scale) =
            (largest(theirs.u.iter().map(length)), largest(von_mises[1].iter().copied()));
        Comparison {
            displacement: Difference::new(model.node_ids().zip(u).collect(), u_scale),
            stress: Difference::new(model.triangle_ids().zip(stress).collect(), stress_scale),
            bodies: model.bodies.iter().map(body).collect(),
            von_mises,
            ours,
            theirs,
        }
    }
}

impl<Place: Copy> Difference<Place> {
    fn new(at: Vec<(Place, f64)>, scale: f64) -> Self {
        let larger = |a: (Place, f64), b: (Place, f64)| if b.1 > a.1 { b } else { a };
        let largest = at.iter().copied().reduce(larger);
        let (place, difference) = largest.expect("a mesh has a node and a triangle");
        let relative = if difference == 0.0 { Some(0.0) } else { over(difference, scale) };
        let squares: f64 = at.iter().map(|(_, x)| x * x).sum();
        Difference {
            largest: Largest { at: place, difference, scale, relative },
            rms: (squares / at.len() as f64).sqrt(),
            at,
        }
    }

    /// The `count` places where it is largest, the largest first.
    pub fn worst(&self, count: usize) -> Vec<Place> {
        let mut at = self.at.clone();
        at.sort_by(|(_, a), (_, b)| b.total_cmp(a));
        at.into_iter().take(count).map(|(place, _)| place).collect()
    }
}

/// Returns a share of a scale; None where that is 0, or too small.
fn over(difference: f64, scale: f64) -> Option<f64> {
    finite(difference / scale)
}

fn largest(of: impl Iterator<Item = f64>) -> f64 {
    of.fold(0.0, f64::max)
}
