//! Mortar with dual multipliers: each contact node is bound to the average of the target over the
//! stretch that its edges cover.
//!
//! ```text
//!  contact edge  s1 o-----------o s2   φ, N: linear shape functions of contact and target edges
//!                    | | | | | |       ψ: dual functions, ∫ ψ_i φ_k = δ_ik ∫ φ_k where covered
//!  target edges  *------*----------*   D_i = ∫ φ_i,  M_ij = ∫ ψ_i N_j,  weights w_ij = M_ij / D_i
//! ```
//!
//! A target edge is projected on a contact edge along the contact edge's normal, so that every
//! integrand is a polynomial of degree two. The dual functions are built on the stretch that is
//! covered, so that an edge that reaches past the target's end still transfers constant pressure.
//!
//! Source: B. Wohlmuth, SIAM J. Numer. Anal. 38 (2000) 989-1012 (dual multipliers); A. Popp, A.
//! Seitz, M. W. Gee, W. A. Wall, Comput. Methods Appl. Mech. Engrg. 264 (2013) 67-80 (edges covered
//! in part).

use std::collections::{BTreeMap, HashMap};

use nalgebra::{Matrix2, Vector2};

use super::pairing::{Pairing, Vector, unit};
use super::search::dot;
use super::surface::{Edge, FACING, Placed, Surfaces};
use crate::problem::model::{EdgeId, NodeId};
use crate::problem::tree::{Bounds, Tree};

/// The overlap below which two edges do not overlap, over the contact edge's length: rounding.
const ROUNDING: f64 = 1e-12;

/// The share of what its edges could cover below which a contact node does not face the target.
const COVERED: f64 = 0.05;

/// Returns, for each contact surface entry, the average of the target that its edges cover.
pub(super) fn pairings(surfaces: &Surfaces, shape: &[Vector]) -> Vec<Option<Pairing>> {
    let target: Vec<Placed> = surfaces.target.iter().map(|edge| edge.place(shape)).collect();
    let mut gathered: HashMap<NodeId, Gathered> = HashMap::new();
    let ends = |(k, edge): (usize, &Edge)| (k, edge.nodes.map(|n| shape[n.index()]));
    let tree = Tree::new(surfaces.target.iter().enumerate().map(ends));
    for edge in &surfaces.contact {
        let covered = cover(&edge.place(shape), &target, &tree);
        let Some(integrals) = Integrals::over(&covered) else { continue };
        for (k, node) in edge.nodes.into_iter().enumerate() {
            gathered.entry(node).or_default().add(k, &integrals, &covered, surfaces, &target);
        }
    }
    let pairing = |(node, tributary): (&NodeId, f64)| {
        let gathered = gathered.remove(node).filter(|g| g.length >= COVERED * tributary)?;
        Some(gathered.pairing(*node, shape))
    };
    surfaces.nodes.iter().zip(surfaces.tributary(shape)).map(pairing).collect()
}

/// A stretch of a contact edge and the target edge that it covers.
struct Stretch {
    /// The index of the target edge in the list of target edges.
    edge: usize,
    /// Where the stretch begins and ends on the contact edge, over the edge's length.
    from: f64,
    to: f64,
    /// The projections of the target edge's two nodes, over the contact edge's length.
    ends: [f64; 2],
    /// The length of the contact edge, length.
    length: f64,
}

/// Returns the stretches of a contact edge that face a target edge. Where several target edges face
/// the same stretch, the nearest one counts.
///
/// Which edges face each other is decided in the shape itself, other than under node to segment: by
/// the normals of the undeformed shape, a contact edge that an iteration has turned over would still
/// cover the target, and a folded shape would pass for an equilibrium.
fn cover(contact: &Placed, target: &[Placed], tree: &Tree) -> Vec<Stretch> {
    let mut facing: Vec<(f64, Stretch)> = Vec::new();
    let across = |b: Bounds| {
        let [least, most] = b.along(contact.start, contact.tangent);
        (most >= 0.0 && least <= contact.length).then_some(0.0)
    };
    let mut beside = Vec::new();
    tree.visit(&across, &mut |edge| beside.push(edge));
    for edge in beside {
        let placed = &target[edge];
        if dot(placed.normal, contact.normal) > -FACING {
            continue;
        }
        let end = [0, 1].map(|d| placed.start[d] + placed.length * placed.tangent[d]);
        let ends = [contact.along(placed.start), contact.along(end)];
        let (from, to) = (ends[0].min(ends[1]).max(0.0), ends[0].max(ends[1]).min(1.0));
        if to - from > ROUNDING {
            let distance = distance(contact, placed, (from + to) / 2.0);
            facing.push((distance, Stretch { edge, from, to, ends, length: contact.length }));
        }
    }
    facing.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.edge.cmp(&b.1.edge)));
    let mut covered: Vec<Stretch> = Vec::new();
    for (_, stretch) in facing {
        for (from, to) in uncovered(&covered, stretch.from, stretch.to) {
            covered.push(Stretch { from, to, ..stretch });
        }
    }
    covered
}

/// Returns the distance from the contact edge's point `xi` to the target edge's line along the
/// contact edge's normal, length.
fn distance(contact: &Placed, target: &Placed, xi: f64) -> f64 {
    let p = [0, 1].map(|d| contact.start[d] + xi * contact.length * contact.tangent[d]);
    (target.outside(p) / dot(target.normal, contact.normal)).abs()
}

/// Returns the parts of `from` .. `to` outside the stretches that are already covered.
fn uncovered(covered: &[Stretch], from: f64, to: f64) -> Vec<(f64, f64)> {
    let mut left = vec![(from, to)];
    for stretch in covered {
        left = left
            .into_iter()
            .flat_map(|(a, b)| [(a, b.min(stretch.from)), (a.max(stretch.to), b)])
            .filter(|(a, b)| b - a > ROUNDING)
            .collect();
    }
    left
}

/// Returns the linear shape functions of the contact edge's two nodes at `xi`.
fn phi(xi: f64) -> Vector2<f64> {
    Vector2::new(1.0 - xi, xi)
}

/// Returns the two Gauss points of a stretch and their weight, length: exact up to degree three.
fn gauss(stretch: &Stretch) -> [(f64, f64); 2] {
    let (middle, half) = ((stretch.from + stretch.to) / 2.0, (stretch.to - stretch.from) / 2.0);
    let offset = half / 3.0_f64.sqrt();
    [middle - offset, middle + offset].map(|xi| (xi, half * stretch.length))
}

/// The integrals over the covered part of a contact edge.
struct Integrals {
    /// The integral ∫ φ_k of each shape function, length.
    phi: Vector2<f64>,
    /// The matrix of the dual shape functions: ψ = dual · φ.
    dual: Matrix2<f64>,
}

impl Integrals {
    /// Integrates over `covered`. Returns None where nothing is covered.
    fn over(covered: &[Stretch]) -> Option<Self> {
        let (mut mass, mut sum) = (Matrix2::zeros(), Vector2::zeros());
        for (xi, weight) in covered.iter().flat_map(gauss) {
            mass += weight * phi(xi) * phi(xi).transpose();
            sum += weight * phi(xi);
        }
        let inverse = mass.try_inverse()?;
        Some(Integrals { phi: sum, dual: Matrix2::from_diagonal(&sum) * inverse })
    }
}

/// The sums of a contact node over its edges.
#[derive(Default)]
struct Gathered {
    /// The integral M_ij by target node, length.
    masters: BTreeMap<NodeId, f64>,
    /// The integral D_i, length.
    length: f64,
    /// The integral ∫ φ_i n, length.
    normal: Vector,
    /// The share of the node's contact edges that each target edge covers.
    edges: BTreeMap<EdgeId, f64>,
}

impl Gathered {
    /// Adds the integrals of node `k` (0 or 1) of a contact edge over `covered`.
    fn add(
        &mut self,
        k: usize,
        integrals: &Integrals,
        covered: &[Stretch],
        surfaces: &Surfaces,
        target: &[Placed],
    ) {
        self.length += integrals.phi[k];
        for stretch in covered {
            let edge = &surfaces.target[stretch.edge];
            let normal = target[stretch.edge].normal;
            let id = edge.id.expect("a target edge is one of the model's");
            *self.edges.entry(id).or_insert(0.0) += stretch.to - stretch.from;
            for (xi, weight) in gauss(stretch) {
                let psi = weight * (integrals.dual * phi(xi))[k];
                let eta = (xi - stretch.ends[0]) / (stretch.ends[1] - stretch.ends[0]);
                *self.masters.entry(edge.nodes[0]).or_insert(0.0) += psi * (1.0 - eta);
                *self.masters.entry(edge.nodes[1]).or_insert(0.0) += psi * eta;
                for d in [0, 1] {
                    self.normal[d] += weight * phi(xi)[k] * normal[d];
                }
            }
        }
    }

    fn pairing(self, node: NodeId, shape: &[Vector]) -> Pairing {
        let normal = unit(self.normal);
        let masters: Vec<(NodeId, f64)> =
            self.masters.into_iter().map(|(master, m)| (master, m / self.length)).collect();
        let most = self.edges.iter().reduce(|a, b| if b.1 > a.1 { b } else { a });
        let edge = *most.expect("a node that covers something covers an edge").0;
        let mut pairing = Pairing { node, edge, masters, normal, gap: 0.0, length: self.length };
        pairing.gap = pairing.opening(|n| shape[n.index()]);
        pairing
    }
}
