//! The triangles beside each side, computed once per model.

use std::collections::HashMap;

use super::ids::{NodeId, TriangleId};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sides(HashMap<[NodeId; 2], Vec<Beside>>);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Beside {
    pub triangle: TriangleId,
    /// The side's two nodes, in the order that leaves the triangle on their left.
    pub nodes: [NodeId; 2],
    pub third: NodeId,
}

impl Sides {
    /// Collects the sides of `triangles`, each given by its nodes counter-clockwise.
    pub fn new(triangles: impl Iterator<Item = [NodeId; 3]>) -> Self {
        let mut sides: HashMap<[NodeId; 2], Vec<Beside>> = HashMap::new();
        for (index, corners) in triangles.enumerate() {
            for k in 0..3 {
                let [a, b, third] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| corners[k]);
                let triangle = TriangleId::new(index);
                let beside = Beside { triangle, nodes: [a, b], third };
                sides.entry(unordered([a, b])).or_default().push(beside);
            }
        }
        Sides(sides)
    }

    /// Returns the triangles that have the side between two nodes in any order, ascending.
    pub fn beside(&self, nodes: [NodeId; 2]) -> &[Beside] {
        self.0.get(&unordered(nodes)).map_or(&[], Vec::as_slice)
    }

    /// Returns the one triangle that has this side, where the side bounds the body; None for an
    /// inner side and for two nodes without a common side.
    pub fn boundary(&self, nodes: [NodeId; 2]) -> Option<Beside> {
        match self.beside(nodes) {
            [one] => Some(*one),
            _ => None,
        }
    }
}

/// Returns two nodes, the lower one first: one key for both directions of an edge.
pub fn unordered([a, b]: [NodeId; 2]) -> [NodeId; 2] {
    [a.min(b), a.max(b)]
}
