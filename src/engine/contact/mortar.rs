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
//!
//! What a contact edge sees behind a jump of the target, as the bottom of a slot, it does not cover: a dual
//! function is negative at the far end of its edge, so that the average of a gap that jumps is an overlap
//! where nothing overlaps.
//!
//! ```text
//!  contact edge     o---------------o
//!  target edges  *-----*         *-----*    both are covered: they go on from each other
//!                      |         |
//!                      *---------*          not covered: it lies behind the end of the first
//! ```
//!
//! The integrals are computed in any scalar. A target edge that covers less than [`ROUNDING`] of a
//! contact edge does not count, so that no sliver hangs on rounding; what may hang on it is whether two
//! edges face each other, which of two overlapping target edges is nearer, and whether a node is covered
//! at all.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::pairing::{Pairing, unit};
use super::search::dot;
use super::surface::{FACING, PlacedEdge, SAME, Surface, Surfaces};
use numbers::scalar::Scalar;
use problem::model::{EdgeId, NodeId};
use problem::tree::{Bounds, Tree};

/// The overlap below which two edges do not overlap, over the contact edge's length: coordinates are rounded
/// to f64, in whatever scalar a run computes.
const ROUNDING: f64 = 1e-12;

/// The share of what its edges could cover below which a contact node does not face the target.
const COVERED: f64 = 0.05;

/// The cosine of the angle between a contact edge and a target edge beyond which the latter is a wall that
/// joins no others: 60 degrees.
const WALL: f64 = 0.5;

/// How far one target edge may lie behind the line of another, over the distance between them: a target that
/// bends there.
const BEHIND: f64 = 0.5;

impl Surfaces {
    /// Returns, for each contact surface entry, the average of the target that its edges cover in a shape,
    /// given as the coordinates of each node, length.
    pub fn mortar<T: Scalar>(&self, shape: &[[T; 2]]) -> Vec<Option<Pairing<T>>> {
        let [contact, target] = [&self.contact, &self.target].map(|own| own.in_shape(shape));
        let mut gathered: FxHashMap<NodeId, NodeIntegrals<T>> = FxHashMap::default();
        let at = |n: NodeId| shape[n.index()].map(T::to_f64);
        let tree = Tree::new(self.target.edges.iter().map(|edge| edge.map(at)).enumerate());
        let search = Search { surfaces: self, target: &target, tree };
        let edges = contact.iter().zip(&self.contact.undeformed);
        let covered: Vec<Vec<Stretch<T>>> =
            edges.map(|(edge, at_rest)| search.cover(edge, at_rest.at(0.5))).collect();
        for (i, edge) in self.contact.edges.iter().enumerate() {
            let Some(integrals) = Integrals::over(&covered[i]) else { continue };
            for (k, node) in edge.iter().copied().enumerate() {
                let mut others = self.contact.at[&node].iter().filter(|other| **other != i);
                if others.any(|other| search.is_cut_off([&covered[i], &covered[*other]], k)) {
                    continue;
                }
                let gathered = gathered.entry(node).or_insert_with(|| NodeIntegrals {
                    masters: BTreeMap::new(),
                    length: T::zero(),
                    normal: [T::zero(); 2],
                    edges: BTreeMap::new(),
                });
                gathered.add(k, &integrals, &covered[i], &search);
            }
        }
        let pairing = |(node, tributary): (&NodeId, T)| {
            let least = T::from_f64(COVERED) * tributary;
            let gathered = gathered.remove(node)?;
            (gathered.length >= least).then(|| gathered.pairing(*node, shape, &self.contact))
        };
        let tributary = self.tributary(shape);
        self.nodes.iter().zip(tributary).map(pairing).collect()
    }
}

/// A stretch of a contact edge and the target edge that it covers.
#[derive(Clone, Copy)]
struct Stretch<T> {
    /// The index of the target edge in the list of target edges.
    edge: usize,
    /// Where the stretch begins and ends on the contact edge, over the edge's length.
    from: T,
    to: T,
    /// The projections of the target edge's two nodes, over the contact edge's length.
    ends: [T; 2],
    /// The length of the contact edge, length.
    length: T,
}

/// A place on a target edge.
#[derive(Clone, Copy)]
struct Foot<T> {
    edge: usize,
    /// Its position: 0 at the edge's first node, 1 at its second.
    eta: T,
}

impl<T: Scalar> Stretch<T> {
    /// Returns the place on the target edge under the stretch's beginning, 0, or its end, 1.
    fn foot(&self, end: usize) -> Foot<T> {
        let xi = [self.from, self.to][end];
        Foot { edge: self.edge, eta: (xi - self.ends[0]) / (self.ends[1] - self.ends[0]) }
    }
}

/// The target in a shape, for the search of what contact edges cover.
struct Search<'a, T> {
    surfaces: &'a Surfaces,
    target: &'a [PlacedEdge<T>],
    tree: Tree,
}

impl<T: Scalar> Search<'_, T> {
    /// Returns the stretches of a contact edge that face a target edge; `middle` is that of the contact edge
    /// in the undeformed shape, length. Where several target edges face the same stretch, the nearest one
    /// counts.
    ///
    /// Which edges face each other is decided in the shape itself, other than under node to segment:
    /// by the normals of the undeformed shape, a contact edge that an iteration has turned over would
    /// still cover the target, and a folded shape would pass for an equilibrium.
    fn cover(&self, contact: &PlacedEdge<T>, middle: [f64; 2]) -> Vec<Stretch<T>> {
        let mut facing: Vec<(T, Stretch<T>)> = Vec::new();
        let (start, tangent) = (contact.start.map(T::to_f64), contact.tangent.map(T::to_f64));
        let across = |b: Bounds| {
            let [least, most] = b.along(start, tangent);
            (most >= 0.0 && least <= contact.length.to_f64()).then_some(0.0)
        };
        let mut beside = Vec::new();
        self.tree.visit(&across, &mut |edge| beside.push(edge));
        let (one, two) = (T::one(), T::from_f64(2.0));
        for edge in beside {
            let placed = &self.target[edge];
            if dot(placed.normal, contact.normal) > T::from_f64(-FACING) {
                continue;
            }
            let ends = [T::zero(), one].map(|eta| contact.along(placed.at(eta)));
            let from = Scalar::max(Scalar::min(ends[0], ends[1]), T::zero());
            let to = Scalar::min(Scalar::max(ends[0], ends[1]), one);
            let is_seen_through = || self.surfaces.target.is_seen_through(edge, middle);
            if to - from > T::from_f64(ROUNDING) && !is_seen_through() {
                let distance = distance(contact, placed, (from + to) / two);
                facing.push((distance, Stretch { edge, from, to, ends, length: contact.length }));
            }
        }
        facing.sort_by(|a, b| in_order(a.0, b.0).then(a.1.edge.cmp(&b.1.edge)));
        let mut covered: Vec<Stretch<T>> = Vec::new();
        for (_, stretch) in facing {
            for (from, to) in uncovered(&covered, stretch.from, stretch.to) {
                covered.push(Stretch { from, to, ..stretch });
            }
        }
        self.before_jumps(contact, covered)
    }

    /// Returns, of the stretches of a contact edge, the nearest of which is the first, those that no jump of
    /// the target parts from that one. A wall joins no others, and lies behind one where either of its ends
    /// does.
    fn before_jumps(&self, contact: &PlacedEdge<T>, covered: Vec<Stretch<T>>) -> Vec<Stretch<T>> {
        let Some(&nearest) = covered.first() else { return covered };
        let is_before = |k: &usize| in_order(covered[*k].from, nearest.from).is_lt();
        let (mut before, mut after): (Vec<usize>, Vec<usize>) =
            (1..covered.len()).partition(is_before);
        before.sort_by(|a, b| in_order(covered[*b].from, covered[*a].from));
        after.sort_by(|a, b| in_order(covered[*a].from, covered[*b].from));
        let away =
            |stretch: &Stretch<T>| -dot(self.target[stretch.edge].normal, contact.normal).to_f64();
        let mut is_kept = vec![true; covered.len()];
        for (side, [start, end]) in [(before, [1, 0]), (after, [0, 1])] {
            let mut last = nearest;
            for k in side {
                let next = covered[k];
                let is_wall = away(&next) < WALL && away(&last) >= WALL;
                let goes_on = self.goes_on(last.edge, next.edge) && !is_wall;
                let measured = if is_wall { vec![start, end] } else { vec![start] };
                let bend = if is_wall { 0.0 } else { BEHIND };
                let is_behind =
                    |at: usize| self.is_behind(contact.length, last.foot(end), next.foot(at), bend);
                is_kept[k] = goes_on || !measured.into_iter().any(is_behind);
                last = if is_kept[k] { next } else { last };
            }
        }
        let kept = covered.into_iter().zip(is_kept).filter(|(_, is_kept)| *is_kept);
        kept.map(|(stretch, _)| stretch).collect()
    }

    /// Returns whether node `node`, 0 or 1, of a contact edge does not count for what the edge covers, as
    /// that lies behind what the other contact edge at the node covers.
    fn is_cut_off(&self, [own, other]: [&[Stretch<T>]; 2], node: usize) -> bool {
        let last = |covered: &[Stretch<T>], end: usize| {
            let nearer = |a: &&Stretch<T>, b: &&Stretch<T>| match end {
                0 => in_order(b.from, a.from),
                _ => in_order(a.to, b.to),
            };
            covered.iter().max_by(nearer).map(|stretch| (stretch.length, stretch.foot(end)))
        };
        last(other, 1 - node).zip(last(own, node)).is_some_and(|((_, last), (length, next))| {
            !self.goes_on(last.edge, next.edge) && self.is_behind(length, last, next, BEHIND)
        })
    }

    /// Returns whether a target edge is another one or shares a node with it.
    fn goes_on(&self, edge: usize, other: usize) -> bool {
        let edges = &self.surfaces.target.edges;
        edges[edge].iter().any(|n| edges[other].contains(n))
    }

    /// Returns whether a place on the target lies behind a jump of it: behind the line of the edge that was
    /// covered `last`, farther than by `bend` of the distance between them. So in this shape and in the
    /// undeformed one, in which bodies side by side may be flush. `length` is that of the contact edge.
    fn is_behind(&self, length: T, last: Foot<T>, next: Foot<T>, bend: f64) -> bool {
        let depth = |[line, other]: [PlacedEdge<T>; 2]| {
            let (from, to) = (line.at(last.eta), other.at(next.eta));
            let apart = Scalar::abs(dot([to[0] - from[0], to[1] - from[1]], line.tangent));
            -line.outside(to).to_f64() - bend * apart.to_f64()
        };
        let ends = [last.edge, next.edge];
        let undeformed = ends.map(|k| self.surfaces.target.undeformed[k].map(T::from_f64));
        let least = depth(ends.map(|k| self.target[k])).min(depth(undeformed));
        least > SAME * length.to_f64()
    }
}

/// Returns the order of two distances.
fn in_order<T: Scalar>(a: T, b: T) -> Ordering {
    let beyond = || (a - b).to_f64().partial_cmp(&0.0).unwrap_or(Ordering::Equal);
    a.to_f64().total_cmp(&b.to_f64()).then_with(beyond)
}

/// Returns the distance from the contact edge's point `xi` to the target edge's line along the
/// contact edge's normal, length.
fn distance<T: Scalar>(contact: &PlacedEdge<T>, target: &PlacedEdge<T>, xi: T) -> T {
    Scalar::abs(target.outside(contact.at(xi)) / dot(target.normal, contact.normal))
}

/// Returns the parts of `from` .. `to` outside the stretches that are already covered.
fn uncovered<T: Scalar>(covered: &[Stretch<T>], from: T, to: T) -> Vec<(T, T)> {
    let mut left = vec![(from, to)];
    for stretch in covered {
        left = left
            .into_iter()
            .flat_map(|(a, b)| [(a, Scalar::min(b, stretch.from)), (Scalar::max(a, stretch.to), b)])
            .filter(|(a, b)| *b - *a > T::from_f64(ROUNDING))
            .collect();
    }
    left
}

/// Returns the linear shape functions of the contact edge's two nodes at `xi`.
fn phi<T: Scalar>(xi: T) -> [T; 2] {
    [T::one() - xi, xi]
}

/// Returns the two Gauss points of a stretch and their weight, length: exact up to degree three.
fn gauss<T: Scalar>(stretch: &Stretch<T>) -> [(T, T); 2] {
    let two = T::from_f64(2.0);
    let (middle, half) = ((stretch.from + stretch.to) / two, (stretch.to - stretch.from) / two);
    let offset = half / T::from_f64(3.0).root();
    [middle - offset, middle + offset].map(|xi| (xi, half * stretch.length))
}

/// The integrals over the covered part of a contact edge.
struct Integrals<T> {
    /// The integral ∫ φ_k of each shape function, length.
    phi: [T; 2],
    /// The matrix of the dual shape functions: ψ = dual · φ.
    dual: [[T; 2]; 2],
}

impl<T: Scalar> Integrals<T> {
    /// Integrates over `covered`. Returns None where nothing is covered.
    fn over(covered: &[Stretch<T>]) -> Option<Self> {
        let (mut mass, mut sum) = ([[T::zero(); 2]; 2], [T::zero(); 2]);
        for (xi, weight) in covered.iter().flat_map(gauss) {
            let phi = phi(xi);
            for i in 0..2 {
                let weighted = weight * phi[i];
                (0..2).for_each(|j| mass[i][j] += weighted * phi[j]);
                sum[i] += weighted;
            }
        }
        let [[a, b], [c, d]] = mass;
        let determinant = a * d - c * b;
        // A matrix that is 0 within its bound has a quotient without one.
        if determinant.to_f64() == 0.0 {
            return None;
        }
        let inverse = [[d, T::zero() - b], [T::zero() - c, a]];
        let dual = [0, 1].map(|i: usize| inverse[i].map(|x| sum[i] * (x / determinant)));
        Some(Integrals { phi: sum, dual })
    }
}

/// The sums of a contact node over its edges.
struct NodeIntegrals<T> {
    /// The integral M_ij by target node, length.
    masters: BTreeMap<NodeId, T>,
    /// The integral D_i, length.
    length: T,
    /// The integral ∫ φ_i n, length.
    normal: [T; 2],
    /// The share of the node's contact edges that each target edge covers.
    edges: BTreeMap<EdgeId, f64>,
}

impl<T: Scalar> NodeIntegrals<T> {
    /// Adds the integrals of node `k` (0 or 1) of a contact edge over `covered`.
    fn add(
        &mut self,
        k: usize,
        integrals: &Integrals<T>,
        covered: &[Stretch<T>],
        search: &Search<T>,
    ) {
        self.length += integrals.phi[k];
        for stretch in covered {
            let nodes = search.surfaces.target.edges[stretch.edge];
            let normal = search.target[stretch.edge].normal;
            *self.edges.entry(search.surfaces.target_edges[stretch.edge]).or_insert(0.0) +=
                (stretch.to - stretch.from).to_f64();
            for (xi, weight) in gauss(stretch) {
                let psi = weight * dot(integrals.dual[k], phi(xi));
                let eta = (xi - stretch.ends[0]) / (stretch.ends[1] - stretch.ends[0]);
                for (master, n) in nodes.into_iter().zip(phi(eta)) {
                    *self.masters.entry(master).or_insert(T::zero()) += psi * n;
                }
                for d in [0, 1] {
                    self.normal[d] += weight * phi(xi)[k] * normal[d];
                }
            }
        }
    }

    fn pairing(self, node: NodeId, shape: &[[T; 2]], contact: &Surface) -> Pairing<T> {
        let normal = contact.mirrored(node, unit(self.normal));
        let masters: Vec<(NodeId, T)> =
            self.masters.into_iter().map(|(master, m)| (master, m / self.length)).collect();
        let most = self.edges.iter().reduce(|a, b| if b.1 > a.1 { b } else { a });
        let edge = *most.expect("a node that covers something covers an edge").0;
        let (gap, length, corner) = (T::zero(), self.length, 0.0);
        let mut pairing = Pairing { node, edge, masters, normal, gap, length, corner };
        pairing.gap = pairing.opening(|n| shape[n.index()]);
        pairing
    }
}
