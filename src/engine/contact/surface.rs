//! The contact surface and the target surface as edges with an inner and an outer side.

use std::collections::HashSet;

use rustc_hash::FxHashMap;

use super::pairing::{Vector, unit};
use super::search::{distance_square, dot, is_inside, minus};
use base::error::InputError;
use numbers::scalar::Scalar;
use problem::model::{BEND, Body, EdgeId, Model, NodeId, unordered};

/// The difference of two places or directions, over the size of what is compared, up to which they are one:
/// far above rounding, also at a thousand sizes from the origin, and far below any gap that matters.
pub(super) const SAME: f64 = 1e-9;

/// The cosine between a contact surface's normal and the reverse of a target edge's, below which
/// the two do not face each other.
pub(super) const FACING: f64 = 0.1;

/// The distance from another side of a body, over the depth behind an edge, up to which a point is beside
/// that side.
const BESIDE: f64 = 0.1;

/// The nodes and edges that may touch, and the side of each edge on which its body lies.
pub struct Surfaces {
    /// The entries of the contact surface.
    pub(super) nodes: Vec<NodeId>,
    /// The undeformed coordinates of each node of the model, length.
    pub(super) at_rest: Vec<Vector>,
    pub(super) contact: Surface,
    pub(super) target: Surface,
    /// The model's edge for each edge of the target.
    pub(super) target_edges: Vec<EdgeId>,
}

/// The edges of the contact surface or those of the target surface, each once, in the order of the model.
pub(super) struct Surface {
    /// The two nodes of each edge, with the body on the left from the first to the second.
    pub(super) edges: Vec<[NodeId; 2]>,
    /// The edges at each node.
    pub(super) at: FxHashMap<NodeId, Vec<usize>>,
    /// The edges in the undeformed shape. An intermediate shape of the iterations may be folded, so that its
    /// normals do not decide which surfaces face each other.
    pub(super) undeformed: Vec<PlacedEdge>,
    /// The unit mean normal at each node over its edges, weighted by length.
    pub(super) node_normals: FxHashMap<NodeId, Vector>,
    /// The direction across the line of symmetry on which the surface ends, as that of half a scene, by the
    /// node there.
    across: FxHashMap<NodeId, Vector>,
    /// The sides that bound the surface's bodies, in the undeformed shape.
    outline: Vec<[Vector; 2]>,
}

impl Surface {
    pub(super) fn new(model: &Model, edges: Vec<[NodeId; 2]>) -> Self {
        let mut at: FxHashMap<NodeId, Vec<usize>> = FxHashMap::default();
        for (k, edge) in edges.iter().enumerate() {
            edge.iter().for_each(|n| at.entry(*n).or_default().push(k));
        }
        let mut sums: FxHashMap<NodeId, Vector> = FxHashMap::default();
        let undeformed: Vec<PlacedEdge> =
            edges.iter().map(|edge| PlacedEdge::new(*edge, &model.nodes)).collect();
        for (edge, PlacedEdge { normal, length, .. }) in edges.iter().zip(&undeformed) {
            for n in edge {
                let sum = sums.entry(*n).or_default();
                (0..2).for_each(|d| sum[d] += length * normal[d]);
            }
        }
        let means = sums.into_iter().map(|(n, sum)| (n, unit(sum)));
        let node_normals = means.collect();
        let across = across(model, &edges, &at);
        let has_surface = |body: &&Body| edges.iter().any(|edge| body.has(edge[0]));
        let bodies: Vec<&Body> = model.bodies.iter().filter(has_surface).collect();
        let sides = model.sides.outline().map(|side| side.nodes);
        let own = sides.filter(|nodes| bodies.iter().any(|body| body.has(nodes[0])));
        let outline = own.map(|nodes| nodes.map(|node| model.coordinates(node))).collect();
        Surface { edges, at, undeformed, node_normals, across, outline }
    }

    /// Places the edges in a shape, given as the coordinates of each node, length.
    pub(super) fn in_shape<T: Scalar>(&self, shape: &[[T; 2]]) -> Vec<PlacedEdge<T>> {
        self.edges.iter().map(|edge| PlacedEdge::new(*edge, shape)).collect()
    }

    /// Returns whether edge `k` is seen from behind, through its body, from a place in the undeformed shape:
    /// from deeper behind it than it is long, and from no body of the surface, or from beside another side of
    /// it. An intermediate shape of the iterations, in which bodies may have passed through each other, does
    /// not decide that.
    pub(super) fn is_seen_through(&self, k: usize, p: Vector) -> bool {
        let edge = &self.undeformed[k];
        let depth = -edge.outside(p);
        // A node of the outline itself is of the body.
        if depth <= edge.length || self.outline.iter().any(|[a, _]| *a == p) {
            return false;
        }
        let near = (BESIDE * depth).powi(2);
        let is_beside = |ends: &[Vector; 2]| distance_square(*ends, p) < near;
        !is_inside(self.outline.iter().copied(), p) || self.outline.iter().any(is_beside)
    }

    /// Returns the normal at a node as its mirror image leaves it where the surface ends on a line of
    /// symmetry: along that line; elsewhere, and where the two images meet in a corner, as it is.
    pub(super) fn mirrored<T: Scalar>(&self, node: NodeId, normal: [T; 2]) -> [T; 2] {
        let Some(across) = self.across.get(&node).map(|across| across.map(T::from_f64)) else {
            return normal;
        };
        let part = dot(normal, across);
        let is_bend = 1.0 - 2.0 * part.to_f64() * part.to_f64() > BEND;
        let along = [0, 1].map(|d| normal[d] - part * across[d]);
        if is_bend { unit(along) } else { normal }
    }

    /// Returns the height of the arc of a circle over the undeformed edges that meet at a node in a bend of a
    /// smooth surface: an eighth of an edge's length times the angle between their normals, length; 0 where they
    /// meet in no bend.
    pub(super) fn height_at(&self, node: NodeId) -> f64 {
        self.bend_at(node).map_or(0.0, |[_, height]| height)
    }

    /// Returns the angle between the normals of the undeformed edges that meet at a node in a bend of a smooth
    /// surface, rad, and [`Surface::height_at`] there; None where they meet in no bend.
    fn bend_at(&self, node: NodeId) -> Option<[f64; 2]> {
        let [k, l] = self.at.get(&node)?[..] else { return None };
        let [a, b] = [k, l].map(|k| &self.undeformed[k]);
        let angle = dot(a.tangent, b.normal).abs().atan2(dot(a.normal, b.normal));
        (dot(a.normal, b.normal) > BEND).then_some([angle, angle * a.length.max(b.length) / 8.0])
    }

    /// Returns the nodes at which the surface ends, ascending.
    fn ends(&self) -> Vec<NodeId> {
        let ends = self.at.iter().filter(|(_, edges)| edges.len() == 1);
        let mut ends: Vec<NodeId> = ends.map(|(node, _)| *node).collect();
        ends.sort();
        ends
    }
}

/// Returns the direction along which a node at the end of a surface is held, where the outline goes on from
/// it along a line across that direction that is held so too.
fn across(
    model: &Model,
    edges: &[[NodeId; 2]],
    at: &FxHashMap<NodeId, Vec<usize>>,
) -> FxHashMap<NodeId, Vector> {
    let held = |node: NodeId| model.restraints_of(node);
    let axis = |[a, b]: [NodeId; 2]| match [0, 1].map(|d| held(a)[d] && held(b)[d]) {
        [true, false] => Some([1.0, 0.0]),
        [false, true] => Some([0.0, 1.0]),
        [true, true] | [false, false] => None,
    };
    // A surface that goes on along the line itself ends there all the same.
    let is_end = |node: &NodeId, side: [NodeId; 2]| {
        let own = at.get(node).into_iter().flatten();
        own.filter(|k| unordered(edges[**k]) != unordered(side)).count() == 1
    };
    let mut found = FxHashMap::default();
    for side in model.sides.outline().map(|side| side.nodes) {
        let Some(across) = axis(side) else { continue };
        let [from, to] = side.map(|node| model.coordinates(node));
        let is_line = dot(minus(to, from), across) == 0.0;
        found.extend(
            side.into_iter()
                .filter(|node| is_line && is_end(node, side))
                .map(|node| (node, across)),
        );
    }
    found
}

/// An edge in a given shape.
#[derive(Clone, Copy)]
pub(super) struct PlacedEdge<T = f64> {
    /// The coordinates of its first node, length.
    pub(super) start: [T; 2],
    /// The unit vector from its first node to its second.
    pub(super) tangent: [T; 2],
    /// The unit normal that points out of the body.
    pub(super) normal: [T; 2],
    /// The length of the edge, length.
    pub(super) length: T,
}

impl<T: Scalar> PlacedEdge<T> {
    /// Places the edge between two nodes in a shape, given as the coordinates of each node, length.
    fn new(nodes: [NodeId; 2], shape: &[[T; 2]]) -> Self {
        let [start, end] = nodes.map(|n| shape[n.index()]);
        let along = minus(end, start);
        let length = T::length(along[0], along[1]);
        let tangent = [along[0] / length, along[1] / length];
        PlacedEdge { start, tangent, normal: [tangent[1], -tangent[0]], length }
    }

    /// Returns the same edge in other numbers.
    pub(super) fn map<U>(&self, to: impl Fn(T) -> U) -> PlacedEdge<U> {
        let PlacedEdge { start, tangent, normal, length } = *self;
        let [start, tangent, normal] = [start, tangent, normal].map(|v| v.map(&to));
        PlacedEdge { start, tangent, normal, length: to(length) }
    }

    /// Returns where `p` projects on the edge's line: 0 at its first node, 1 at its second.
    pub(super) fn along(&self, p: [T; 2]) -> T {
        dot(minus(p, self.start), self.tangent) / self.length
    }

    /// Returns the point at `xi` of it: 0 at its first node, 1 at its second, length.
    pub(super) fn at(&self, xi: T) -> [T; 2] {
        [0, 1].map(|d| self.start[d] + xi * self.length * self.tangent[d])
    }

    /// Returns the distance of `p` from the edge's line, length; > 0 outside the body.
    pub(super) fn outside(&self, p: [T; 2]) -> T {
        dot(minus(p, self.start), self.normal)
    }
}

impl Surfaces {
    /// Finds the surfaces of a model.
    ///
    /// # Errors
    /// A target edge bounds no triangle, so that its outer side is unknown.
    pub fn new(model: &Model) -> Result<Self, InputError> {
        let nodes = model.contact.nodes.clone();
        let boundary = |pair: [NodeId; 2]| model.sides.boundary(pair).map(|one| one.nodes);
        let contact = chain(&nodes, |pair| boundary(pair).is_some());
        let contact = contact.into_iter().filter_map(boundary).collect();
        let target = |&id: &EdgeId| {
            let edge = model.edge(id);
            let [a, b] = edge.nodes;
            boundary(edge.nodes).ok_or_else(|| {
                let what = format!("edge {} (nodes {a} and {b}) bounds no triangle", edge.number);
                InputError::new("contact.trg", what, "name edges of the target body's outline")
            })
        };
        let target_edges = model.contact.target.clone();
        let target = target_edges.iter().map(target).collect::<Result<_, InputError>>()?;
        let [contact, target] = [contact, target].map(|edges| Surface::new(model, edges));
        Ok(Surfaces { nodes, at_rest: model.nodes.clone(), contact, target, target_edges })
    }

    /// Returns the edges of both surfaces in a shape: their nodes, their normal and their length.
    pub fn edges(&self, shape: &[Vector]) -> Vec<([NodeId; 2], Vector, f64)> {
        let edges = self.contact.edges.iter().chain(&self.target.edges);
        let placed = edges.map(|nodes| (*nodes, PlacedEdge::new(*nodes, shape)));
        placed.map(|(nodes, edge)| (nodes, edge.normal, edge.length)).collect()
    }

    /// Returns the nodes at which the contact surface ends, and those at which the target surface does.
    pub fn ends(&self) -> [Vec<NodeId>; 2] {
        [&self.contact, &self.target].map(Surface::ends)
    }

    /// Returns whether the contact surface ends at a node on a line of symmetry, as that of half a scene.
    pub fn ends_on_symmetry(&self, node: NodeId) -> bool {
        self.contact.across.contains_key(&node)
    }

    /// Returns the largest height of an arc over an undeformed edge at some nodes of either surface, length; 0
    /// where edges meet at less than an angle, rad.
    pub fn facet_height(&self, nodes: &[NodeId], least: f64) -> f64 {
        let bend =
            |node: &NodeId| self.contact.bend_at(*node).or_else(|| self.target.bend_at(*node));
        let bends = nodes.iter().filter_map(bend).filter(|[angle, _]| *angle > least);
        bends.map(|[_, height]| height).fold(0.0, f64::max)
    }

    /// Returns, for each entry of the contact surface, half the length of the contact edges that it
    /// bounds in a shape, length; 0 for a node's second entry.
    pub fn tributary<T: Scalar>(&self, shape: &[[T; 2]]) -> Vec<T> {
        let mut of_node: FxHashMap<NodeId, T> = FxHashMap::default();
        for (edge, placed) in self.contact.edges.iter().zip(self.contact.in_shape(shape)) {
            let half = placed.length / T::from_f64(2.0);
            edge.iter().for_each(|n| *of_node.entry(*n).or_insert(T::zero()) += half);
        }
        self.nodes.iter().map(|n| of_node.remove(n).unwrap_or(T::zero())).collect()
    }
}

/// Returns each pair of successive `nodes` once, the lower node first, and the pair that closes a
/// loop where all pairs are boundary edges.
fn chain(nodes: &[NodeId], is_boundary: impl Fn([NodeId; 2]) -> bool) -> Vec<[NodeId; 2]> {
    let (mut pairs, mut listed) = (Vec::new(), HashSet::new());
    let mut add = |pair| {
        if listed.insert(pair) {
            pairs.push(pair);
        }
    };
    let following: Vec<_> = nodes.windows(2).map(|p| unordered([p[0], p[1]])).collect();
    following.iter().for_each(|pair| add(*pair));
    if let [first, .., last] = nodes
        && following.iter().all(|pair| is_boundary(*pair))
    {
        add(unordered([*first, *last]));
    }
    pairs
}
