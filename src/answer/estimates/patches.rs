//! The triangles that surround each node, one material at a time.
//!
//! ```text
//!   +-----+-----+    A node where two materials meet is two sites: the stress jumps there, and is
//!   | A  /|\  B |    recovered on each side from that side's triangles alone. Bodies share no
//!   |   / | \   |    node, so no site belongs to two bodies.
//!   +--a--|--b--+
//! ```

use std::collections::HashMap;

use crate::problem::model::{Model, TriangleId};

/// The triangles around each site, a node as one material sees it. All numbers count from 0.
#[derive(Debug)]
pub struct Patches {
    /// The coordinates of each site, length.
    pub points: Vec<[f64; 2]>,
    /// The centre of each triangle, length.
    pub centres: Vec<[f64; 2]>,
    /// The sites at the corners of each triangle.
    pub corners: Vec<[usize; 3]>,
    /// The triangles around each site, ascending.
    pub around: Vec<Vec<usize>>,
    /// The sites at the other ends of each site's edges, ascending.
    pub neighbours: Vec<Vec<usize>>,
    /// Whether triangles of the site's material surround it.
    pub interior: Vec<bool>,
}

impl Patches {
    /// Finds the patches of a model's triangles.
    pub fn new(model: &Model) -> Self {
        let (corners, points) = sites(model);
        let mut patches = Patches {
            centres: corners
                .iter()
                .map(|c| [0, 1].map(|d| c.iter().map(|&s: &usize| points[s][d] / 3.0).sum()))
                .collect(),
            around: vec![Vec::new(); points.len()],
            neighbours: vec![Vec::new(); points.len()],
            interior: vec![true; points.len()],
            points,
            corners,
        };
        for id in model.triangle_ids() {
            patches.add(model, id);
        }
        for sites in &mut patches.neighbours {
            sites.sort_unstable();
            sites.dedup();
        }
        patches
    }

    /// Adds triangle `id` to the patches of its sites.
    fn add(&mut self, model: &Model, id: TriangleId) {
        let triangle = model.triangle(id);
        let sites = self.corners[id.index()];
        for k in 0..3 {
            let ends = [k, (k + 1) % 3];
            let [a, b] = ends.map(|k| sites[k]);
            self.around[a].push(id.index());
            self.neighbours[a].push(b);
            self.neighbours[b].push(a);
            let beside = model.sides.beside(ends.map(|k| triangle.nodes[k])).iter();
            let same = |other: TriangleId| model.triangle(other).material == triangle.material;
            if beside.filter(|other| same(other.triangle)).count() == 1 {
                (self.interior[a], self.interior[b]) = (false, false);
            }
        }
    }
}

/// Returns the sites of each triangle and the coordinates of each site, length. Sites are numbered
/// in the order in which triangles first have them.
fn sites(model: &Model) -> (Vec<[usize; 3]>, Vec<[f64; 2]>) {
    let (mut numbers, mut points) = (HashMap::new(), Vec::new());
    let corners = model.triangles.iter().map(|triangle| {
        triangle.nodes.map(|node| {
            let material = triangle.material;
            let key = (node, material.e.to_bits(), material.nu.to_bits());
            *numbers.entry(key).or_insert_with(|| {
                points.push(model.at(node));
                points.len() - 1
            })
        })
    });
    (corners.collect(), points)
}
