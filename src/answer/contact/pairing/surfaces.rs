//! The two contact surfaces as edges with an inside and an outside.

use std::collections::{HashMap, HashSet};

use super::{Vector, dot, minus};
use crate::error::InputError;
use crate::paper::mathcad::array::Table;
use crate::paper::mirror::Worksheet;

/// Cosine between a contact surface's normal and the reverse of a target edge's, beyond which the two do not face each other.
pub(super) const FACING: f64 = 0.1;

/// Which nodes and edges may touch, and on which side of each edge its body lies.
pub struct Surfaces {
    /// The entries of `cnt`.
    pub(super) nodes: Vec<usize>,
    /// Edges of the contact surface.
    pub(super) contact: Vec<Edge>,
    /// Edges of the target surface.
    pub(super) target: Vec<Edge>,
    /// In the undeformed shape, the normal of each contact node that bounds an edge, and of each target edge. A shape on the way to the answer may
    /// be folded: it does not tell what faces what.
    undeformed: (HashMap<usize, Vector>, Vec<Vector>),
}

/// An edge of a body's surface.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    /// Its number in `elem`; 0 for an edge of the contact surface.
    pub(super) number: usize,
    /// Its nodes, the body on their left.
    pub(super) nodes: [usize; 2],
}

/// An edge in a given shape.
pub(super) struct Placed {
    /// Its first node's place, length.
    pub(super) start: Vector,
    /// Unit vector from its first node to its second.
    pub(super) tangent: Vector,
    /// Unit normal, out of the body.
    pub(super) normal: Vector,
    /// Length.
    pub(super) length: f64,
}

impl Edge {
    /// The edge in the shape `node_n`.
    pub(super) fn place(&self, node_n: &Table<f64>) -> Placed {
        let [start, end] = self.nodes.map(|n| point(node_n, n));
        let along = minus(end, start);
        let length = along[0].hypot(along[1]);
        let tangent = [along[0] / length, along[1] / length];
        Placed { start, tangent, normal: [tangent[1], -tangent[0]], length }
    }
}

impl Placed {
    /// Where the foot of `p` lies along the edge: 0 at its first node, 1 at its second.
    pub(super) fn along(&self, p: Vector) -> f64 {
        dot(minus(p, self.start), self.tangent) / self.length
    }

    /// Distance of `p` from the edge's line, > 0 outside the body.
    pub(super) fn outside(&self, p: Vector) -> f64 {
        dot(minus(p, self.start), self.normal)
    }
}

/// Node `n` in the shape `node_n`.
pub(super) fn point(node_n: &Table<f64>, n: usize) -> Vector {
    [node_n[(n, 2)], node_n[(n, 3)]]
}

impl Surfaces {
    /// The surfaces of a scene.
    ///
    /// # Errors
    /// A target edge that bounds no triangle: nobody knows which of its sides is outside.
    pub fn new(sheet: &Worksheet<f64>) -> Result<Self, InputError> {
        let sides = sides(sheet);
        let nodes: Vec<usize> = sheet.cnt.iter().copied().collect();
        let contact: Vec<Edge> = chain(&nodes, &sides)
            .into_iter()
            .filter_map(|pair| sides.get(&pair))
            .map(|nodes| Edge { number: 0, nodes: *nodes })
            .collect();
        let target = sheet.trg.iter().map(|&number| {
            let ends = [sheet.elem[(number, 6)], sheet.elem[(number, 7)]];
            let nodes = sides.get(&unordered(ends)).ok_or_else(|| {
                InputError::new(
                    "contact.trg",
                    format!("edge {number} (nodes {} and {}) bounds no triangle", ends[0], ends[1]),
                    "name edges of the target body's outline",
                )
            })?;
            Ok(Edge { number, nodes: *nodes })
        });
        let target = target.collect::<Result<Vec<_>, InputError>>()?;
        let normals = target.iter().map(|edge| edge.place(&sheet.node).normal).collect();
        let undeformed = (normals_at_nodes(&contact, &sheet.node), normals);
        Ok(Surfaces { nodes, contact, target, undeformed })
    }

    /// Whether a contact node and the target edge at `edge` face each other in the undeformed shape; a node without an edge faces all.
    pub(super) fn face(&self, node: usize, edge: usize) -> bool {
        let (own, target) = &self.undeformed;
        own.get(&node).is_none_or(|normal| dot(*normal, target[edge]) <= -FACING)
    }

    /// For each target edge which of its nodes no other target edge has: there the surface ends.
    pub(super) fn free_ends(&self) -> Vec<[bool; 2]> {
        let mut edges_at: HashMap<usize, HashSet<[usize; 2]>> = HashMap::new();
        for edge in &self.target {
            for n in edge.nodes {
                edges_at.entry(n).or_default().insert(edge.nodes);
            }
        }
        self.target.iter().map(|edge| edge.nodes.map(|n| edges_at[&n].len() == 1)).collect()
    }

    /// For each entry of `cnt` half the length of the contact edges that it bounds, in the shape `node_n`; 0 for a node's second entry.
    pub fn tributary(&self, node_n: &Table<f64>) -> Vec<f64> {
        let mut of_node: HashMap<usize, f64> = HashMap::new();
        for edge in &self.contact {
            let half = edge.place(node_n).length / 2.0;
            edge.nodes.iter().for_each(|n| *of_node.entry(*n).or_insert(0.0) += half);
        }
        self.nodes.iter().map(|n| of_node.remove(n).unwrap_or(0.0)).collect()
    }
}

/// The normal of each node of `edges`, out of its body: the mean of its edges', by length; not a unit vector where they meet in a corner.
fn normals_at_nodes(edges: &[Edge], node: &Table<f64>) -> HashMap<usize, Vector> {
    let mut of_node: HashMap<usize, (Vector, f64)> = HashMap::new();
    for edge in edges {
        let Placed { normal, length, .. } = edge.place(node);
        for n in edge.nodes {
            let (sum, total) = of_node.entry(n).or_default();
            *total += length;
            (0..2).for_each(|d| sum[d] += length * normal[d]);
        }
    }
    let mean = |(n, (sum, total)): (usize, (Vector, f64))| (n, sum.map(|x| x / total));
    of_node.into_iter().map(mean).collect()
}

/// Each pair of nodes that follow each other in `nodes` once, and the pair that closes a loop where all of them are `sides`; nodes ascending.
fn chain(nodes: &[usize], sides: &HashMap<[usize; 2], [usize; 2]>) -> Vec<[usize; 2]> {
    let mut pairs: Vec<[usize; 2]> = Vec::new();
    let mut add = |pair| {
        if !pairs.contains(&pair) {
            pairs.push(pair);
        }
    };
    let following: Vec<_> = nodes.windows(2).map(|p| unordered([p[0], p[1]])).collect();
    following.iter().for_each(|pair| add(*pair));
    if let [first, .., last] = nodes
        && following.iter().all(|pair| sides.contains_key(pair))
    {
        add(unordered([*first, *last]));
    }
    pairs
}

/// For each side of a single triangle, its nodes ascending, its nodes with the triangle on their left.
fn sides(sheet: &Worksheet<f64>) -> HashMap<[usize; 2], [usize; 2]> {
    let mut sides: HashMap<[usize; 2], [usize; 2]> = HashMap::new();
    let mut inner = HashSet::new();
    for n in 1..=sheet.M() {
        let corner = |k: usize| sheet.EL[(n, sheet.ind_1 + k % 3)];
        for k in 0..3 {
            let side = [corner(k), corner(k + 1)];
            if sides.insert(unordered(side), side).is_some() {
                inner.insert(unordered(side));
            }
        }
    }
    sides.retain(|side, _| !inner.contains(side));
    sides
}

fn unordered([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
