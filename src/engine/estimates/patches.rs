//! The triangles that surround each node, one material at a time.
//!
//! ```text
//!   +-----+-----+    A node where two materials meet is two sites: the stress jumps there, and is
//!   | A  /|\  B |    recovered on each side from that side's triangles alone. Bodies share no
//!   |   / | \   |    node, so no site belongs to two bodies.
//!   +--a--|--b--+
//! ```

use smallvec::SmallVec;

use problem::model::{Material, Model, TriangleId};

/// The triangles around each site, a node as one material sees it. All numbers count from 0.
#[derive(Debug)]
pub struct Patches {
    /// The coordinates of each site, length.
    pub points: Vec<[f64; 2]>,
    /// The centre of each triangle, length.
    pub centres: Vec<[f64; 2]>,
    /// The sites at the corners of each triangle.
    pub corners: Vec<[u32; 3]>,
    /// Whether triangles of the site's material surround it.
    pub interior: Vec<bool>,
    /// Where the triangles around each site start, and where the last ones end.
    starts: Vec<u32>,
    around: Vec<TriangleId>,
}

impl Patches {
    /// Finds the patches of a model's triangles.
    pub fn new(model: &Model) -> Self {
        let (corners, points) = sites(model);
        let centre =
            |c: &[u32; 3]| [0, 1].map(|d| c.map(|s| points[s as usize][d] / 3.0).iter().sum());
        let (starts, around) = around(&corners, points.len());
        Patches {
            centres: corners.iter().map(centre).collect(),
            interior: interior(model, &corners, points.len()),
            starts,
            around,
            points,
            corners,
        }
    }

    /// Returns the triangles around a site, ascending.
    pub fn around(&self, site: u32) -> &[TriangleId] {
        let [from, to] = [0, 1].map(|k| self.starts[site as usize + k] as usize);
        &self.around[from..to]
    }

    /// Returns the sites of the triangles around a site: itself and those at the other ends of its
    /// edges, some of them twice.
    pub fn neighbours(&self, site: u32) -> impl Iterator<Item = u32> {
        self.around(site).iter().flat_map(|id| self.corners[id.index()])
    }
}

/// Returns where the triangles around each of `sites` sites start, and these triangles.
fn around(corners: &[[u32; 3]], sites: usize) -> (Vec<u32>, Vec<TriangleId>) {
    let mut starts = vec![0; sites + 1];
    for site in corners.as_flattened() {
        starts[*site as usize + 1] += 1;
    }
    (0..sites).for_each(|site| starts[site + 1] += starts[site]);
    let mut next = starts.clone();
    let mut around = vec![TriangleId::new(0); 3 * corners.len()];
    for (k, sites) in corners.iter().enumerate() {
        for site in sites {
            let at = &mut next[*site as usize];
            around[*at as usize] = TriangleId::new(k);
            *at += 1;
        }
    }
    (starts, around)
}

/// Returns whether triangles of the site's material surround each of `sites` sites.
fn interior(model: &Model, corners: &[[u32; 3]], sites: usize) -> Vec<bool> {
    let mut interior = vec![true; sites];
    for (triangle, corners) in model.triangles.iter().zip(corners) {
        for ends in [[0, 1], [1, 2], [2, 0]] {
            let beside = model.sides.beside(ends.map(|k| triangle.nodes[k])).iter();
            let same = |other: TriangleId| model.triangle(other).material == triangle.material;
            if beside.filter(|other| same(other.triangle)).count() == 1 {
                ends.iter().for_each(|k| interior[corners[*k] as usize] = false);
            }
        }
    }
    interior
}

/// Returns the sites of each triangle and the coordinates of each site, length. Sites are numbered
/// in the order in which triangles first have them.
fn sites(model: &Model) -> (Vec<[u32; 3]>, Vec<[f64; 2]>) {
    let mut of_node: Vec<SmallVec<[u32; 2]>> = vec![SmallVec::new(); model.nodes.len()];
    let (mut materials, mut points): (Vec<Material>, Vec<_>) = Default::default();
    let corners = model.triangles.iter().map(|triangle| {
        triangle.nodes.map(|node| {
            let sites = &mut of_node[node.index()];
            let is_same = |site: &&u32| materials[**site as usize] == triangle.material;
            sites.iter().find(is_same).copied().unwrap_or_else(|| {
                let site = points.len() as u32;
                sites.push(site);
                points.push(model.at(node));
                materials.push(triangle.material);
                site
            })
        })
    });
    (corners.collect(), points)
}
