//! Superconvergent patch recovery: better stresses at the nodes than the triangles' own.
//!
//! A linear polynomial is fitted by least squares to the stresses at the centres of the triangles
//! around an interior node, and evaluated at the node. A node on an edge of its body or material
//! has too few triangles, all on one side: there the polynomials of the adjacent interior nodes are
//! evaluated and averaged.
//!
//! ```text
//!   +-----+-----+    A node where two materials meet is two sites: the stress jumps there, and is
//!   | A  /|\  B |    recovered on each side from that side's triangles alone. Bodies share no
//!   |   / | \   |    node, so no site belongs to two bodies.
//!   +--a--|--b--+
//! ```
//!
//! Source: O. C. Zienkiewicz, J. Z. Zhu, "The superconvergent patch recovery and a posteriori error
//! estimates, part 1: the recovery technique", Int. J. Numer. Methods Eng. 33 (1992) 1331-1364.

use std::collections::BTreeSet;

use nalgebra::{Matrix2, SMatrix, Vector2, Vector3};
use smallvec::SmallVec;

use problem::model::{Material, Model, TriangleId};

/// The stress components sigma_x, sigma_y, tau_xy.
pub type Stress = Vector3<f64>;

/// The ratio of the two principal second moments of the centres below which they lie on one line
/// and fix no slope across it.
const COLLINEAR: f64 = 1e-10;

/// The number of edges beyond which the polynomial of another site says nothing of a site; without a
/// limit a body that is one layer of triangles is searched as a whole from each of its nodes.
const FARTHEST: usize = 8;

/// Returns the recovered stress at each site from the stress of each triangle; None where the
/// site's material has no patch that fixes a slope.
pub fn recover(patches: &Patches, stresses: &[Stress]) -> Vec<Option<Stress>> {
    let recovered = |site: u32| match own(patches, stresses, site) {
        Some(polynomial) => Some(polynomial.stress(patches.points[site as usize])),
        None => nearest(patches, stresses, site).or_else(|| enlarged(patches, stresses, site)),
    };
    (0..patches.points.len() as u32).map(recovered).collect()
}

/// Returns the polynomial of an interior site; None of others, and where its triangles fix no slope.
fn own(patches: &Patches, stresses: &[Stress], site: u32) -> Option<Linear> {
    let fit = || Linear::fit(patches, patches.around(site), stresses);
    patches.interior[site as usize].then(fit).flatten()
}

/// Returns the mean at `site` of the polynomials of the nearest sites that have one.
fn nearest(patches: &Patches, stresses: &[Stress], site: u32) -> Option<Stress> {
    let point = patches.points[site as usize];
    let read = |ring: &[u32]| {
        let value = |s: &u32| Some(own(patches, stresses, *s)?.stress(point));
        let values: Vec<Stress> = ring.iter().filter_map(value).collect();
        (!values.is_empty()).then(|| values.iter().sum::<Stress>() / values.len() as f64)
    };
    Rings::new(patches, site).take(FARTHEST).find_map(|ring| read(&ring))
}

/// Returns the value at `site` of the polynomial of the smallest patch of rings that fixes one.
fn enlarged(patches: &Patches, stresses: &[Stress], site: u32) -> Option<Stress> {
    let mut triangles: BTreeSet<TriangleId> = patches.around(site).iter().copied().collect();
    for ring in Rings::new(patches, site) {
        triangles.extend(ring.iter().flat_map(|s| patches.around(*s)));
        let members: Vec<TriangleId> = triangles.iter().copied().collect();
        if let Some(polynomial) = Linear::fit(patches, &members, stresses) {
            return Some(polynomial.stress(patches.points[site as usize]));
        }
    }
    None
}

/// The sites one edge away, two edges away, and so on.
struct Rings<'a> {
    patches: &'a Patches,
    seen: BTreeSet<u32>,
    last: Vec<u32>,
}

impl<'a> Rings<'a> {
    fn new(patches: &'a Patches, site: u32) -> Self {
        Rings { patches, seen: BTreeSet::from([site]), last: vec![site] }
    }
}

impl Iterator for Rings<'_> {
    type Item = Vec<u32>;

    fn next(&mut self) -> Option<Vec<u32>> {
        let beyond: BTreeSet<u32> = self
            .last
            .iter()
            .flat_map(|s| self.patches.neighbours(*s))
            .filter(|s| !self.seen.contains(s))
            .collect();
        self.seen.extend(&beyond);
        self.last = beyond.into_iter().collect();
        (!self.last.is_empty()).then(|| self.last.clone())
    }
}

/// A stress that is linear in the plane: mean + slope · (p − origin) / size.
struct Linear {
    origin: Vector2<f64>,
    size: f64,
    mean: Stress,
    slope: SMatrix<f64, 3, 2>,
}

impl Linear {
    /// Fits by least squares at the centres of `triangles`; None where they lie on one line.
    fn fit(patches: &Patches, triangles: &[TriangleId], stresses: &[Stress]) -> Option<Self> {
        let count = triangles.len() as f64;
        let centre = |t: &TriangleId| Vector2::from(patches.centres[t.index()]);
        let origin = triangles.iter().map(centre).sum::<Vector2<f64>>() / count;
        let mean = triangles.iter().map(|t| stresses[t.index()]).sum::<Stress>() / count;
        let size = triangles.iter().map(|t| (centre(t) - origin).norm()).fold(0.0, f64::max);
        if size == 0.0 {
            return None;
        }
        // About the mean point the constant and the slopes separate: slope · G = H.
        let (mut g, mut h) = (Matrix2::zeros(), SMatrix::<f64, 3, 2>::zeros());
        for t in triangles {
            let d = (centre(t) - origin) / size;
            g += d * d.transpose();
            h += (stresses[t.index()] - mean) * d.transpose();
        }
        let moments = g.symmetric_eigenvalues();
        if moments.min() <= COLLINEAR * moments.max() {
            return None;
        }
        Some(Linear { origin, size, mean, slope: h * g.try_inverse()? })
    }

    fn stress(&self, point: [f64; 2]) -> Stress {
        self.mean + self.slope * ((Vector2::from(point) - self.origin) / self.size)
    }
}

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
                points.push(model.coordinates(node));
                materials.push(triangle.material);
                site
            })
        })
    });
    (corners.collect(), points)
}
