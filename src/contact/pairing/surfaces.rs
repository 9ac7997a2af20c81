//! The two contact surfaces as edges with an inside and an outside.

use std::collections::HashMap;

use super::{Vector, dot, minus};
use crate::error::InputError;
use crate::mathcad::array::Table;
use crate::mirror::Worksheet;

/// Which nodes and edges may touch, and on which side of each edge its body lies.
pub struct Surfaces {
    /// The entries of `cnt`.
    pub(super) nodes: Vec<usize>,
    /// Edges of the contact surface.
    pub(super) contact: Vec<Edge>,
    /// Edges of the target surface.
    pub(super) target: Vec<Edge>,
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
        let contact = nodes
            .windows(2)
            .filter_map(|pair| sides.get(&unordered([pair[0], pair[1]])))
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
        Ok(Surfaces { contact, target: target.collect::<Result<_, InputError>>()?, nodes })
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

/// For each side of a triangle, its nodes ascending, its nodes with the triangle on their left.
fn sides(sheet: &Worksheet<f64>) -> HashMap<[usize; 2], [usize; 2]> {
    let mut sides = HashMap::new();
    for n in 1..=sheet.M() {
        let corner = |k: usize| sheet.EL[(n, sheet.ind_1 + k % 3)];
        for k in 0..3 {
            let side = [corner(k), corner(k + 1)];
            sides.insert(unordered(side), side);
        }
    }
    sides
}

fn unordered([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
