//! The contact surfaces seen from outside the listing: which side of an edge is inside, what lies in the target.

use crate::paper::mathcad::array::Table;
use crate::paper::mirror::Worksheet;
use crate::problem::element::{Corners, area};
use crate::studies::audit::Case;

/// A node's place in a shape.
pub(super) fn place(node_n: &Table<f64>, n: usize) -> [f64; 2] {
    [node_n[(n, 2)], node_n[(n, 3)]]
}

/// The ends of target edge `e` in a shape.
pub(super) fn ends(sheet: &Worksheet<f64>, node_n: &Table<f64>, e: usize) -> [[f64; 2]; 2] {
    [6, 7].map(|column| place(node_n, sheet.elem[(e, column)]))
}

/// Vertical distance from `point` up to the line through `ends`; nothing where that is vertical.
pub(super) fn rise([a, b]: [[f64; 2]; 2], point: [f64; 2]) -> Option<f64> {
    let slope = (b[1] - a[1]) / (b[0] - a[0]);
    (b[0] != a[0]).then(|| a[1] + slope * (point[0] - a[0]) - point[1])
}

/// The corners of triangle `n` in a shape.
fn corners(sheet: &Worksheet<f64>, node_n: &Table<f64>, n: usize) -> Corners<f64> {
    [0, 1, 2].map(|k| place(node_n, sheet.EL[(n, sheet.ind_1 + k)]))
}

/// Whether contact node `i1` lies inside a triangle of the target, its sides excluded.
pub(super) fn inside_target(case: &Case, node_n: &Table<f64>, i1: usize) -> bool {
    let point = place(node_n, case.sheet.cnt[i1]);
    let inside = |n: &usize| {
        let [a, b, c] = corners(&case.sheet, node_n, *n);
        [[a, b], [b, c], [c, a]].iter().all(|[p, q]| area(&[*p, *q, point]) > 0.0)
    };
    case.scene.target().is_some_and(|target| target.triangles.iter().any(inside))
}

/// The sign of `yt` inside the target at edge `e`: +1 where the target lies below the edge, −1 where above. Nothing for a
/// vertical edge, or one that bounds no triangle.
pub(super) fn inner_sign(sheet: &Worksheet<f64>, node_n: &Table<f64>, e: usize) -> Option<f64> {
    let edge = [6, 7].map(|column| sheet.elem[(e, column)]);
    let nodes = |n: usize| [0, 1, 2].map(|k| sheet.EL[(n, sheet.ind_1 + k)]);
    let triangle = (1..=sheet.M()).map(nodes).find(|t| edge.iter().all(|n| t.contains(n)))?;
    let third = triangle.into_iter().find(|n| !edge.contains(n))?;
    rise(ends(sheet, node_n, e), place(node_n, third)).map(f64::signum)
}

/// The unit normal of target edge `e` that points away from the target.
pub(super) fn away(sheet: &Worksheet<f64>, node_n: &Table<f64>, e: usize) -> Option<[f64; 2]> {
    let [a, b] = ends(sheet, node_n, e);
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let scale = inner_sign(sheet, node_n, e)? * dx.signum() / dx.hypot(dy);
    Some([-dy * scale, dx * scale])
}
