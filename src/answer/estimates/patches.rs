//! Which triangles surround which node, one material at a time.
//!
//! ```text
//!   +-----+-----+      A node where two materials meet is two sites: the stress jumps there, and is recovered
//!   | A  /|\  B |      on each side from that side's triangles alone. Bodies share no node, so no site belongs
//!   |   / | \   |      to two bodies.
//!   +--a--|--b--+
//! ```

use std::collections::BTreeMap;

use crate::paper::mirror::Worksheet;

/// The triangles around each site; a site is a node as one material sees it. Everything is counted from 0.
pub struct Patches {
    /// Coordinates of each site, length.
    pub points: Vec<[f64; 2]>,
    /// Centre of each triangle, length.
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
    /// The patches of a worksheet's triangles.
    pub fn new(sheet: &Worksheet<f64>) -> Self {
        let (corners, points) = sites(sheet);
        let around = around(&corners, points.len());
        let edges = edges(&corners);
        let mut neighbours = vec![Vec::new(); points.len()];
        let mut interior = vec![true; points.len()];
        for (&[a, b], &count) in &edges {
            neighbours[a].push(b);
            neighbours[b].push(a);
            if count == 1 {
                (interior[a], interior[b]) = (false, false);
            }
        }
        neighbours.iter_mut().for_each(|sites| sites.sort_unstable());
        let centre = |c: &[usize; 3]| [0, 1].map(|d| c.iter().map(|&s| points[s][d] / 3.0).sum());
        let centres = corners.iter().map(centre).collect();
        Patches { points, centres, corners, around, neighbours, interior }
    }
}

/// The sites of each triangle, and where each site is; numbered as the triangles meet them.
fn sites(sheet: &Worksheet<f64>) -> (Vec<[usize; 3]>, Vec<[f64; 2]>) {
    let (mut numbers, mut points) = (BTreeMap::new(), Vec::new());
    let corners = (1..=sheet.M()).map(|n| {
        [0, 1, 2].map(|k| {
            let node = sheet.EL[(n, sheet.ind_1 + k)];
            let key = (node, sheet.E[n].to_bits(), sheet.nu[n].to_bits());
            *numbers.entry(key).or_insert_with(|| {
                points.push([sheet.node[(node, 2)], sheet.node[(node, 3)]]);
                points.len() - 1
            })
        })
    });
    (corners.collect(), points)
}

fn around(corners: &[[usize; 3]], sites: usize) -> Vec<Vec<usize>> {
    let mut around = vec![Vec::new(); sites];
    for (triangle, corners) in corners.iter().enumerate() {
        corners.iter().for_each(|&site| around[site].push(triangle));
    }
    around
}

/// How many triangles of one material each edge bounds; ends ascending.
fn edges(corners: &[[usize; 3]]) -> BTreeMap<[usize; 2], usize> {
    let mut count = BTreeMap::new();
    for [a, b, c] in corners {
        for [p, q] in [[a, b], [b, c], [c, a]] {
            *count.entry([*p.min(q), *p.max(q)]).or_insert(0) += 1;
        }
    }
    count
}
