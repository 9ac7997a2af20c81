//! The contact surfaces seen from outside the listing: which side of an edge is inside, what lies in
//! the target.

use super::experiment::Shape;
use crate::problem::element::area;
use crate::problem::model::{EdgeId, Model, NodeId, TriangleId};

/// A node's coordinates in a shape, length.
pub(super) fn place(shape: &Shape, node: NodeId) -> [f64; 2] {
    shape[node.index()]
}

/// The coordinates of the ends of an edge in a shape, length.
pub(super) fn ends(model: &Model, shape: &Shape, edge: EdgeId) -> [[f64; 2]; 2] {
    model.edge(edge).nodes.map(|node| place(shape, node))
}

/// Vertical distance from `point` up to the line through `ends`; nothing where that is vertical.
pub(super) fn rise([a, b]: [[f64; 2]; 2], point: [f64; 2]) -> Option<f64> {
    let slope = (b[1] - a[1]) / (b[0] - a[0]);
    (b[0] != a[0]).then(|| a[1] + slope * (point[0] - a[0]) - point[1])
}

/// Whether entry `i` of the contact surface lies inside a triangle of the target, its sides
/// excluded.
pub(super) fn inside_target(model: &Model, shape: &Shape, i: usize) -> bool {
    let point = place(shape, model.contact.nodes[i]);
    let inside = |id: &TriangleId| {
        let [a, b, c] = model.triangle(*id).nodes.map(|node| place(shape, node));
        [[a, b], [b, c], [c, a]].iter().all(|[p, q]| area(&[*p, *q, point]) > 0.0)
    };
    model.target().is_some_and(|target| target.triangles.iter().any(inside))
}

/// The sign of `yt` inside the target at an edge: +1 where the target lies below it, −1 where above.
/// Nothing for a vertical edge, or one that bounds no triangle.
pub(super) fn inner_sign(model: &Model, shape: &Shape, edge: EdgeId) -> Option<f64> {
    let third = model.sides.beside(model.edge(edge).nodes).first()?.third;
    rise(ends(model, shape, edge), place(shape, third)).map(f64::signum)
}

/// The unit normal of a target edge that points away from the target.
pub(super) fn away(model: &Model, shape: &Shape, edge: EdgeId) -> Option<[f64; 2]> {
    let [a, b] = ends(model, shape, edge);
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let scale = inner_sign(model, shape, edge)? * dx.signum() / dx.hypot(dy);
    Some([-dy * scale, dx * scale])
}
