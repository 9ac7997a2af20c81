//! The differences between two results of one model.

use serde::Serialize;

use super::fields::Fields;
use crate::problem::scene::{Body, Scene};

/// Two results of one model, node by node and triangle by triangle.
pub struct Comparison {
    /// By this program.
    pub ours: Fields,
    /// By CalculiX.
    pub theirs: Fields,
    /// Von Mises stress of each triangle, by this program and by CalculiX.
    pub von_mises: [Vec<f64>; 2],
    /// Displacements, by node.
    pub displacement: Difference,
    /// Stresses, by triangle: the largest component of sigma_x, sigma_y, tau_xy; relative to the largest von Mises stress.
    pub stress: Difference,
    /// Von Mises stress, by body.
    pub bodies: Vec<BodyStress>,
}

/// A difference, place by place.
pub struct Difference {
    /// At each node or triangle.
    pub at: Vec<f64>,
    /// The largest one.
    pub largest: Largest,
    /// Root of the mean square.
    pub rms: f64,
}

/// The largest difference.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Largest {
    /// Its node, or its triangle's row of `EL`.
    pub at: usize,
    /// The difference.
    pub difference: f64,
    /// The largest value by this program.
    pub scale: f64,
    /// Difference over scale; 0 where both are 0.
    pub relative: f64,
}

/// The largest von Mises stress of a body by each.
#[derive(Clone, Debug, Serialize)]
pub struct BodyStress {
    /// The body.
    pub name: String,
    /// By this program.
    pub ours: f64,
    /// By CalculiX.
    pub calculix: f64,
}

impl Comparison {
    /// `ours` beside `theirs`.
    pub fn new(scene: &Scene, ours: Fields, theirs: Fields) -> Self {
        let length = |[x, y]: &[f64; 2]| x.hypot(*y);
        let moved = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).hypot(a[1] - b[1]);
        // sigma_x, sigma_y, tau_xy: sigma_z is no unknown of a plane problem.
        let stressed = |(a, b): (&[f64; 6], &[f64; 6])| {
            [0, 1, 3].into_iter().map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
        };
        let von_mises = [ours.von_mises(), theirs.von_mises()];
        Comparison {
            displacement: Difference::new(
                ours.u.iter().zip(&theirs.u).map(moved).collect(),
                largest(ours.u.iter().map(length)),
            ),
            stress: Difference::new(
                ours.sigma.iter().zip(&theirs.sigma).map(stressed).collect(),
                largest(von_mises[0].iter().copied()),
            ),
            bodies: bodies(scene, &von_mises),
            von_mises,
            ours,
            theirs,
        }
    }
}

impl Difference {
    fn new(at: Vec<f64>, scale: f64) -> Self {
        let node = (0..at.len()).reduce(|a, b| if at[b] > at[a] { b } else { a });
        let node = node.expect("a mesh has a node and a triangle");
        let relative = if at[node] == 0.0 { 0.0 } else { at[node] / scale };
        let squares: f64 = at.iter().map(|x| x * x).sum();
        Difference {
            largest: Largest { at: node + 1, difference: at[node], scale, relative },
            rms: (squares / at.len() as f64).sqrt(),
            at,
        }
    }

    /// The `count` places where it is largest, the largest first.
    pub fn worst(&self, count: usize) -> Vec<usize> {
        let mut places: Vec<usize> = (1..=self.at.len()).collect();
        places.sort_by(|a, b| self.at[b - 1].total_cmp(&self.at[a - 1]));
        places.truncate(count);
        places
    }
}

fn bodies(scene: &Scene, von_mises: &[Vec<f64>; 2]) -> Vec<BodyStress> {
    let row = |body: &Body| {
        let [ours, calculix] =
            [0, 1].map(|by: usize| largest(body.triangles.iter().map(|n| von_mises[by][n - 1])));
        BodyStress { name: body.name.clone(), ours, calculix }
    };
    scene.bodies.iter().map(row).collect()
}

fn largest(of: impl Iterator<Item = f64>) -> f64 {
    of.fold(0.0, f64::max)
}
