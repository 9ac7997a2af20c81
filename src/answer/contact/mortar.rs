//! Mortar with dual multipliers: each contact node is bound to the average of the target over what
//! its edges cover.
//!
//! ```text
//!   contact edge   s1 o-----------o s2        ψ: dual shape functions, ∫ ψ_i φ_k = δ_ik ∫ φ_k over the stretch covered
//!                      | | | | | |             D_i = ∫ φ_i,  M_ij = ∫ ψ_i N_j,  weights w_ij = M_ij / D_i
//!   target edges   *------*----------*         φ, N: linear shape functions of the contact and the target edges
//! ```
//!
//! A target edge is cast on a contact edge along the contact edge's normal, so that every integrand
//! is a polynomial of degree two. The dual functions are made for the stretch covered, so that an
//! edge that hangs over the target's end still passes constant pressure.
//!
//! Source: B. Wohlmuth, SIAM J. Numer. Anal. 38 (2000) 989-1012 (dual multipliers); A. Popp, A.
//! Seitz, M. W. Gee, W. A. Wall, Comput. Methods Appl. Mech. Engrg. 264 (2013) 67-80 (edges covered
//! in part).

use std::collections::{BTreeMap, HashMap};

use nalgebra::{Matrix2, Vector2};

use super::pairing::{Pairing, Vector, dot};
use super::surface::{FACING, Placed, Surfaces};
use crate::problem::model::{EdgeId, NodeId};

/// A shorter overlap, of the contact edge's length, is rounding.
const ROUNDING: f64 = 1e-12;

/// A contact node that covers less than this share of what its edges could cover is off the target.
const COVERED: f64 = 0.05;

/// For each entry of the contact surface the average of the target over what its edges cover.
pub(super) fn pairings(surfaces: &Surfaces, shape: &[Vector]) -> Vec<Option<Pairing>> {
    let target: Vec<Placed> = surfaces.target.iter().map(|edge| edge.place(shape)).collect();
    let mut gathered: HashMap<NodeId, Gathered> = HashMap::new();
    for edge in &surfaces.contact {
        let covered = cover(&edge.place(shape), &target);
        let Some(integrals) = Integrals::over(&covered) else { continue };
        for (k, node) in edge.nodes.into_iter().enumerate() {
            gathered.entry(node).or_default().add(k, &integrals, &covered, surfaces, &target);
        }
    }
    let tributary = surfaces.tributary(shape);
    let entries = surfaces.nodes.iter().zip(tributary);
    entries
        .map(|(node, tributary)| {
            let gathered = gathered.remove(node).filter(|g| g.length >= COVERED * tributary)?;
            Some(gathered.pairing(*node, shape))
        })
        .collect()
}

/// A stretch of a contact edge and the target edge that it covers.
struct Stretch {
    /// The target edge's place in the list of target edges.
    edge: usize,
    /// Where the stretch begins and ends on the contact edge, of its length.
    from: f64,
    to: f64,
    /// Where the target edge's two nodes are cast on the contact edge.
    ends: [f64; 2],
    /// Length of the contact edge.
    length: f64,
}

/// The stretches of a contact edge that face a target edge. Of several that face the same place the
/// nearest counts.
fn cover(contact: &Placed, target: &[Placed]) -> Vec<Stretch> {
    let mut facing: Vec<(f64, Stretch)> = Vec::new();
    for (edge, placed) in target.iter().enumerate() {
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

/// Distance, along the contact edge's normal, from its point `xi` to the target edge's line.
fn distance(contact: &Placed, target: &Placed, xi: f64) -> f64 {
    let p = [0, 1].map(|d| contact.start[d] + xi * contact.length * contact.tangent[d]);
    (target.outside(p) / dot(target.normal, contact.normal)).abs()
}

/// What is left of `from` .. `to` outside the stretches that are covered.
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

/// Linear shape functions of the contact edge's two nodes.
fn phi(xi: f64) -> Vector2<f64> {
    Vector2::new(1.0 - xi, xi)
}

/// The two Gauss points of a stretch and their weight, length: exact up to degree three.
fn gauss(stretch: &Stretch) -> [(f64, f64); 2] {
    let (middle, half) = ((stretch.from + stretch.to) / 2.0, (stretch.to - stretch.from) / 2.0);
    let offset = half / 3.0_f64.sqrt();
    [middle - offset, middle + offset].map(|xi| (xi, half * stretch.length))
}

/// Integrals over what a contact edge covers.
struct Integrals {
    /// ∫ φ_k, length.
    phi: Vector2<f64>,
    /// ψ = dual · φ.
    dual: Matrix2<f64>,
}

impl Integrals {
    /// None where nothing is covered.
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

/// What a contact node gathers from its edges.
#[derive(Default)]
struct Gathered {
    /// M_ij by target node, length.
    masters: BTreeMap<NodeId, f64>,
    /// D_i, length.
    length: f64,
    /// ∫ φ_i n, length.
    normal: Vector,
    /// Length covered, by target edge.
    edges: BTreeMap<EdgeId, f64>,
}

impl Gathered {
    /// Adds what node `k` (0 or 1) of a contact edge has of `covered`.
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
            *self
                .edges
                .entry(edge.id.expect("a target edge is one of the model's"))
                .or_insert(0.0) += stretch.to - stretch.from;
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
        let size = self.normal[0].hypot(self.normal[1]);
        let normal = [self.normal[0] / size, self.normal[1] / size];
        let masters: Vec<(NodeId, f64)> =
            self.masters.into_iter().map(|(master, m)| (master, m / self.length)).collect();
        let most = self.edges.iter().reduce(|a, b| if b.1 > a.1 { b } else { a });
        let edge = *most.expect("a node that covers something covers an edge").0;
        let mut pairing = Pairing { node, edge, masters, normal, gap: 0.0, length: self.length };
        pairing.gap = pairing.opening(|n| shape[n.index()]);
        pairing
    }
}
