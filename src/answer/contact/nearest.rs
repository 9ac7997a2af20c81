//! The target surface in a shape, and the edge of it that lies nearest to a point.
//!
//! ```text
//!        normal ^         o p            distance > 0: p is outside the target
//!               |         :
//!     a *-------+---------x------* b     x: the point closest to p; xi counts from elem[edge,6] = a to elem[edge,7] = b
//!        . . . . target . . . .
//!
//!     convex corner   o p          concave corner      \ o p /
//!                    :                                  \ : /
//!               ----*               it is on             \:/
//!             . . . .\              either edge           *
//!             . target\                                 target
//! ```
//!
//! At a corner both edges are equally near. The edge whose line is farther from p is taken: its side has the right sign, because the
//! sum of the two normals has it (Bærentzen and Aanæs, IEEE TVCG 11:243, 2005). Sides are exact (`robust`), distances rounded.

use robust::{Coord, orient2d};

use super::operations::Operations;
use crate::problem::model::{EdgeId, Model, NodeId};

/// The place on the target surface that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint {
    /// The target edge.
    pub edge: EdgeId,
    /// Place on it: 0 at its first node, 1 at its second.
    pub xi: f64,
    /// Distance to it, length: > 0 outside the target, < 0 inside. Past the end of the surface the edge's line is the border.
    pub distance: f64,
    /// Unit normal of the edge, out of the target.
    pub normal: [f64; 2],
    /// How far the point lies past the end of the surface, along the edge, length; 0 over the surface.
    pub beyond: f64,
}

/// The target edges in a shape.
#[derive(Clone, Debug)]
pub struct TargetSurface {
    pub(super) edges: Vec<Edge>,
}

/// A target edge in a shape.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    /// Which of the model's edges it is.
    id: EdgeId,
    /// Its two ends, in the order of `elem`.
    pub ends: [[f64; 2]; 2],
    length: f64,
    /// +1 where the target lies to the left of the way from the first end to the second, −1 where to the right.
    inner: f64,
    /// Ends that no other target edge shares.
    free: [bool; 2],
}

impl TargetSurface {
    /// The target surface of `model` in a shape, the coordinates of each node. An edge that bounds no triangle, or whose triangle has no
    /// area, has no inner side and is left out.
    pub fn new(model: &Model, shape: &[[f64; 2]]) -> Self {
        let shared =
            |node: NodeId| model.target_edges().filter(|e| e.nodes.contains(&node)).count();
        let place = |n: NodeId| shape[n.index()];
        let edge = |&id: &EdgeId| {
            let nodes = model.edge(id).nodes;
            let ends = nodes.map(place);
            let third = model.sides.beside(nodes).first()?.third;
            let inner = orient(ends[0], ends[1], place(third));
            let length = (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]);
            let free = nodes.map(|n| shared(n) == 1);
            let edge = Edge { id, ends, length, inner: inner.signum(), free };
            (inner != 0.0).then_some(edge)
        };
        TargetSurface { edges: model.contact.target.iter().filter_map(edge).collect() }
    }

    /// The point closest to `p`; nothing where the surface has no edge.
    pub fn nearest(&self, p: [f64; 2]) -> Option<ClosestPoint> {
        self.nearest_counted(p, &Operations::default())
    }

    /// As [`nearest`](Self::nearest), counting operations. Every edge is looked at: as clear as the listing's own search, and the two
    /// can be compared.
    pub fn nearest_counted(&self, p: [f64; 2], operations: &Operations) -> Option<ClosestPoint> {
        operations.add(self.edges.len() as u64);
        let measured = self.edges.iter().map(|edge| edge.measure(p, operations));
        measured
            .reduce(|best, next| if next.nearer_than(&best) { next } else { best })
            .map(Near::closest)
    }
}

/// An edge as seen from a point.
struct Near<'e> {
    edge: &'e Edge,
    /// Place of the closest point, before it is kept to the edge: below 0 and above 1 past the ends.
    t: f64,
    /// Distance to it, without sign.
    distance: f64,
    /// Distance to the edge's line, > 0 outside.
    line: f64,
}

impl Near<'_> {
    fn nearer_than(&self, other: &Self) -> bool {
        let tie = self.distance == other.distance;
        self.distance < other.distance || tie && self.line.abs() > other.line.abs()
    }

    fn closest(self) -> ClosestPoint {
        let Edge { id, length, free, .. } = *self.edge;
        let past = [-self.t, self.t - 1.0].map(|t| t.max(0.0) * length);
        ClosestPoint {
            edge: id,
            xi: self.t.clamp(0.0, 1.0),
            distance: if self.line < 0.0 { -self.distance } else { self.distance },
            normal: self.edge.normal(),
            beyond: if free[0] { past[0] } else { 0.0 } + if free[1] { past[1] } else { 0.0 },
        }
    }
}

impl Edge {
    fn measure(&self, p: [f64; 2], operations: &Operations) -> Near<'_> {
        let [a, b] = self.ends;
        let (along, from) = (difference(b, a), difference(p, a));
        let t = (along[0] * from[0] + along[1] * from[1]) / (self.length * self.length);
        // 0 − x rather than −x: on the line it is 0, not −0.
        let line = 0.0 - self.inner * orient(a, b, p) / self.length;
        // Two differences of two, three products, a sum, a quotient, two comparisons; the sign; its quotient.
        operations.add(11 + Operations::ORIENTATION + 2);
        let end = if t <= 0.0 { Some(a) } else { (t >= 1.0).then_some(b) };
        let distance = end.map_or(line.abs(), |end| {
            operations.add(6);
            let [x, y] = difference(p, end);
            x.hypot(y)
        });
        Near { edge: self, t, distance, line }
    }

    /// Unit normal, out of the target.
    fn normal(&self) -> [f64; 2] {
        let [x, y] = difference(self.ends[1], self.ends[0]);
        let scale = self.inner / self.length;
        [y * scale, 0.0 - x * scale]
    }

    /// On which side of the edge's line `p` lies, exactly: > 0 inside, 0 on it.
    pub fn side(&self, p: [f64; 2]) -> f64 {
        self.inner * orient(self.ends[0], self.ends[1], p)
    }
}

/// Twice the area of a, b, c with its exact sign: > 0 where c lies to the left of the way from a to b.
pub(super) fn orient(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let [a, b, c] = [a, b, c].map(|[x, y]| Coord { x, y });
    orient2d(a, b, c)
}

fn difference(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}
