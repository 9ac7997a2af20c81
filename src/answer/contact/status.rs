//! Who is in contact: the sign rule that the listing prints, the text's other remedy, and the exact answer.
//!
//! For a node that jumped deeper into the target than c_tol the text names two remedies: "the search for the point of intersection of
//! the elements that hold this node with the neighbouring elements of the target surface", and "the comparison of the signs of Yi
//! of neighbouring nodes". The listing has the second only. The first, as built here, word by word:
//!
//! - *the elements that hold this node*: the triangles of which the contact node is a corner. Of their sides those count that end at the
//!   node: where the opposite side is cut, the node may be on either side of the cut;
//! - *the neighbouring elements of the target surface*: the target edges (the text calls an edge with nodes 1.1 and 1.2 an element). A
//!   side meets its neighbours only: an edge whose box does not overlap the side's is passed over;
//! - *the point of intersection*: a side that leads out of the target crosses the surface once more outwards than inwards.
//!
//! ```text
//!       q1 *-------* q2       c      the contact node, jumped deeper than c_tol
//!           \     /           q1, q2 the other corners of the triangle that holds it
//!            \   /            x      points of intersection: c - q1 and c - q2 lead out of the target
//!     *-------x-x-------*            target edges; below them the target
//!              c
//! ```
//!
//! What the remedy cannot see: a node whose elements have sunk in whole (no side of theirs is cut), and a node beside the target
//! whose side runs through the target's flank, which is no target edge, and out through the surface.

use super::nearest::{Edge, TargetSurface, orient};
use super::operations::Operations;
use crate::numbers::scalar::Scalar;
use crate::paper::door::{self, ContactStatus, NodeToSegment};
use crate::paper::mirror::{Failure, Order, Reading, c_cnt};
use crate::problem::model::{Model, NodeId};
use crate::problem::modelling::StatusRule;

/// Who is in contact in a shape, the coordinates of each node, by `rule`.
///
/// Under *signs* edges and distances are `c_cnt`'s. Under *intersection* too, and where it found no edge for a node in contact, the edge is
/// the nearest. Under *projection* the edge is the nearest one, none past the surface's end, and the distance minus the signed distance to
/// it: > 0 inside the target.
///
/// # Errors
/// Where the lines of `c_cnt` that the rule keeps fail as printed: all of them under *signs*, 1 to 16 under *intersection*.
pub fn statuses(
    rule: StatusRule,
    model: &Model,
    reading: &Reading,
    shape: &[[f64; 2]],
) -> Result<Vec<ContactStatus>, Failure> {
    statuses_counted(rule, model, reading, shape, &Operations::default())
}

/// The same, counting the operations beside those of `c_cnt`.
///
/// # Errors
/// Those of [`statuses`].
pub fn statuses_counted(
    rule: StatusRule,
    model: &Model,
    reading: &Reading,
    shape: &[[f64; 2]],
    operations: &Operations,
) -> Result<Vec<ContactStatus>, Failure> {
    let printed = |reading: &Reading| {
        let sheet = door::worksheet(model, |x| x);
        let pairs = c_cnt(&sheet, reading, &door::node_n(model, shape))?;
        Ok(door::statuses(model, &pairs))
    };
    let surface = || TargetSurface::new(model, shape);
    match rule {
        StatusRule::Signs => printed(reading),
        StatusRule::Intersection => {
            // The sign rule takes no part: a false operand keeps its lines from failing.
            let printed = printed(&Reading { r4: Order::Guarded, ..*reading })?;
            Ok(by_intersection(model, shape, &surface(), printed, operations))
        }
        StatusRule::Projection => Ok(by_projection(model, shape, &surface(), operations)),
    }
}

/// The places of the nodes in contact on their target edges, with the weights of lines 22 and 23 of `c_cnt`. `x`: the x coordinate of
/// each node in the shape that weights come from (R5).
///
/// # Errors
/// Where line 22 fails as printed: the weights of a vertical edge.
pub fn places<T: Scalar>(
    model: &Model,
    statuses: &[ContactStatus],
    x: impl Fn(NodeId) -> T,
) -> Result<Vec<NodeToSegment<T>>, Failure> {
    let in_contact = statuses.iter().enumerate().filter(|(_, status)| status.in_contact);
    in_contact
        .map(|(k, status)| {
            let edge = model.edge(status.edge.expect("a node in contact has an edge"));
            door::on_edge(status.node, edge.nodes, &x).map_err(|cause| {
                let [a, b] = edge.nodes;
                let values: [(&str, &dyn std::fmt::Display); 3] = [
                    ("i1", &(k + 1)),
                    ("ct[i1]", &edge.number),
                    ("denominator", &(x(b) - x(a)).to_f64()),
                ];
                Failure::new("c_cnt", 22, cause, &values)
            })
        })
        .collect()
}

fn by_intersection(
    model: &Model,
    shape: &[[f64; 2]],
    surface: &TargetSurface,
    mut statuses: Vec<ContactStatus>,
    operations: &Operations,
) -> Vec<ContactStatus> {
    for status in &mut statuses {
        operations.add(1);
        let near = status.edge.is_some() && status.distance.abs() < model.contact.tolerance;
        status.in_contact = near || intersects(model, shape, surface, status.node, operations);
        if status.in_contact && status.edge.is_none() {
            let closest = surface.nearest_counted(shape[status.node.index()], operations);
            status.edge = Some(closest.expect("a surface that is crossed has an edge").edge);
        }
    }
    statuses
}

/// Whether a side at contact node `n` leads out of the target.
fn intersects(
    model: &Model,
    shape: &[[f64; 2]],
    surface: &TargetSurface,
    n: NodeId,
    operations: &Operations,
) -> bool {
    let c = shape[n.index()];
    sides(model, n).into_iter().any(|q| {
        let q = shape[q.index()];
        surface.edges.iter().map(|edge| crossing(edge, c, q, operations)).sum::<i32>() > 0
    })
}

/// The nodes that share a triangle with node `n`, in order.
fn sides(model: &Model, n: NodeId) -> Vec<NodeId> {
    let triangles = model.triangles.iter().map(|t| t.nodes).filter(|t| t.contains(&n));
    let mut others: Vec<NodeId> = triangles.flatten().filter(|other| *other != n).collect();
    others.sort_unstable();
    others.dedup();
    others
}

/// +1 where the way from `c` to `q` crosses `edge` outwards, −1 inwards, 0 where it does not. It crosses a corner of two edges once. A
/// way that starts on the edge starts inside; one that ends on it ends outside.
fn crossing(edge: &Edge, c: [f64; 2], q: [f64; 2], operations: &Operations) -> i32 {
    let [a, b] = edge.ends;
    if apart([a, b], [c, q], operations) {
        return 0;
    }
    operations.add(2 * Operations::ORIENTATION);
    if (orient(c, q, a) >= 0.0) == (orient(c, q, b) >= 0.0) {
        return 0;
    }
    operations.add(2 * Operations::ORIENTATION);
    match (edge.side(c) >= 0.0, edge.side(q) > 0.0) {
        (true, false) => 1,
        (false, true) => -1,
        _ => 0,
    }
}

/// Whether the boxes around two segments have no point in common.
fn apart(one: [[f64; 2]; 2], other: [[f64; 2]; 2], operations: &Operations) -> bool {
    (0..2).any(|axis| {
        let span = |s: [[f64; 2]; 2]| (s[0][axis].min(s[1][axis]), s[0][axis].max(s[1][axis]));
        // Two smallest, two largest, two comparisons of them.
        operations.add(6);
        let ((low, high), (other_low, other_high)) = (span(one), span(other));
        high < other_low || other_high < low
    })
}

fn by_projection(
    model: &Model,
    shape: &[[f64; 2]],
    surface: &TargetSurface,
    operations: &Operations,
) -> Vec<ContactStatus> {
    let tolerance = model.contact.tolerance;
    let status = |&node: &NodeId| {
        let apart = ContactStatus { node, edge: None, distance: 0.0, in_contact: false };
        let Some(closest) = surface.nearest_counted(shape[node.index()], operations) else {
            return apart;
        };
        operations.add(2);
        let distance = 0.0 - closest.distance;
        match closest.beyond <= tolerance {
            true => ContactStatus {
                node,
                edge: Some(closest.edge),
                distance,
                in_contact: closest.distance <= tolerance,
            },
            false => ContactStatus { distance, ..apart },
        }
    };
    model.contact.nodes.iter().map(status).collect()
}
