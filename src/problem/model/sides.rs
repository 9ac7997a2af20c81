//! The triangles beside each side, computed once per model.

use super::ids::{NodeId, TriangleId};
use serde::Serialize;

/// The cosine of the angle between two edges beyond which they meet in a corner, not in a bend of a
/// smooth surface: 30 degrees.
pub const BEND: f64 = 0.866;

/// What lies beside each side, by the lower of its two nodes, then by the higher one.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Sides {
    /// Where the sides of each lower node start, and where the last ones end.
    starts: Vec<u32>,
    beside: Vec<TriangleSide>,
}

/// A side of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct TriangleSide {
    /// The triangle.
    pub triangle: TriangleId,
    /// The side's two nodes, in the order that leaves the triangle on their left.
    pub nodes: [NodeId; 2],
    /// The triangle's node opposite the side.
    pub third: NodeId,
}

impl Sides {
    /// Collects the sides of `triangles`, each given by its nodes counter-clockwise.
    pub fn new(triangles: impl Iterator<Item = [NodeId; 3]> + Clone) -> Self {
        let of_triangle = |(index, corners): (usize, [NodeId; 3])| {
            [0, 1, 2].map(|k| {
                let [a, b, third] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| corners[k]);
                TriangleSide { triangle: TriangleId::new(index), nodes: [a, b], third }
            })
        };
        // They are gone through three times, so that only one list of them is held.
        let given = triangles.enumerate().flat_map(of_triangle);
        let lower = |one: &TriangleSide| unordered(one.nodes)[0].index();
        let nodes = given.clone().map(|one| lower(&one)).max().map_or(0, |last| last + 1);
        let mut starts = vec![0; nodes + 1];
        given.clone().for_each(|one| starts[lower(&one) + 1] += 1);
        (0..nodes).for_each(|node| starts[node + 1] += starts[node]);
        let Some(first) = given.clone().next() else { return Sides::default() };
        let (mut next, mut beside) = (starts.clone(), vec![first; starts[nodes] as usize]);
        for one in given {
            let at = &mut next[lower(&one)];
            beside[*at as usize] = one;
            *at += 1;
        }
        for ends in starts.windows(2) {
            beside[ends[0] as usize..ends[1] as usize].sort_by_key(|one| unordered(one.nodes)[1]);
        }
        Sides { starts, beside }
    }

    /// Returns the triangles that have the side between two nodes in any order, ascending.
    pub fn beside(&self, nodes: [NodeId; 2]) -> &[TriangleSide] {
        let [lower, higher] = unordered(nodes);
        let Some([from, to]) = self.starts.get(lower.index()..lower.index() + 2) else {
            return &[];
        };
        let of_lower = &self.beside[*from as usize..*to as usize];
        let higher_of = |one: &TriangleSide| unordered(one.nodes)[1];
        let from = of_lower.partition_point(|one| higher_of(one) < higher);
        let to = of_lower.partition_point(|one| higher_of(one) <= higher);
        &of_lower[from..to]
    }

    /// Returns the sides that bound the bodies, by the lower of their nodes, then by the higher one.
    pub fn outline(&self) -> impl Iterator<Item = TriangleSide> {
        self.beside.iter().filter_map(|side| self.boundary(side.nodes))
    }

    /// Returns the one triangle that has this side, where the side bounds the body; None for an
    /// inner side and for two nodes without a common side.
    pub fn boundary(&self, nodes: [NodeId; 2]) -> Option<TriangleSide> {
        match self.beside(nodes) {
            [one] => Some(*one),
            _ => None,
        }
    }
}

/// Returns two nodes, the lower one first: one key for both directions of an edge.
pub fn unordered<N: Copy + Ord>([a, b]: [N; 2]) -> [N; 2] {
    [a.min(b), a.max(b)]
}
