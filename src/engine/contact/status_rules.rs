//! The rules that decide which nodes are in contact: the sign rule that the listing prints, and the
//! text's other remedy.
//!
//! For a node that jumped deeper into the target than c_tol the text names two remedies: "the
//! search for the point of intersection of the elements that hold this node with the neighbouring
//! elements of the target surface", and "the comparison of the signs of Yi of neighbouring nodes".
//! The listing has only the second. The first is built here, word by word:
//!
//! - *the elements that hold this node*: the triangles of which the contact node is a corner. Only
//!   their sides that end at the node count: where the opposite side is cut, the node may be on
//!   either side of the cut;
//! - *the neighbouring elements of the target surface*: the target edges (the text calls an edge
//!   with nodes 1.1 and 1.2 an element). A side meets its neighbours only: an edge is skipped if
//!   its box does not overlap the side's;
//! - *the point of intersection*: a side that leaves the target crosses it once more outwards.
//!
//! ```text
//!       q1 *-------* q2       c      the contact node, jumped deeper than c_tol
//!           \     /           q1, q2 the other corners of a triangle at c
//!            \   /            x      where c - q1 and c - q2 lead out of the target
//!     *-------x-x-------*     target edges; the target lies below them
//!              c
//! ```
//!
//! The remedy does not find a node whose elements have sunk in completely (no side of theirs is
//! cut), nor a node beside the target whose side enters through the target's flank, which is no
//! target edge, and leaves through the surface.

use std::collections::BTreeSet;

use super::search::closest;

use mathcad::Conjunction;
use mathcad::array::Table;
use numbers::scalar::Scalar;
use paper::door::{self, ContactStatus};
use paper::mirror::{self, Failure, Pairs, Reading, Worksheet, c_cnt};
use problem::model::{EdgeId, Model, NodeId};
use problem::modelling::StatusRule;

/// Returns the status of each contact node in the shape `node_n` (R x 4) by `rule`. `sheet`
/// contains the tables of `model` in T.
///
/// Under *signs* the edges and distances are those of `c_cnt`. Under *intersection* they are too,
/// but where `c_cnt` found no edge for a node in contact, the edge is the nearest one.
///
/// # Errors
/// The lines of `c_cnt` in use fail as printed: all under *signs*, 1 to 16 and the weights of 22
/// under *intersection*.
pub fn statuses<T: Scalar>(
    rule: StatusRule,
    model: &Model,
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
) -> Result<Vec<ContactStatus<T>>, Failure> {
    match rule {
        StatusRule::Signs => Ok(door::statuses(model, &c_cnt(sheet, reading, node_n)?)),
        StatusRule::Intersection => {
            // A false operand keeps its lines from failing, as the sign rule is not used.
            let guarded = Reading { r4: Conjunction::Guarded, ..*reading };
            let pairs = c_cnt(sheet, &guarded, node_n)?;
            let target = Target::new(model, node_n);
            let by_rule = |(k, status)| {
                by_intersection(model, &target, node_n, is_near(sheet, &pairs, k + 1), status)
            };
            Ok(door::statuses(model, &pairs).into_iter().enumerate().map(by_rule).collect())
        }
    }
}

/// Returns whether line 16 of `c_cnt` takes row `i1` of `cnt` for a node in contact.
fn is_near<T: Scalar>(sheet: &Worksheet<T>, pairs: &Pairs<T>, i1: usize) -> bool {
    let condition = mirror::is_near(&pairs.ct, &pairs.yt, sheet.c_tll, i1);
    pairs.ct[i1] > 0
        && mirror::and(Conjunction::LeftToRight, &condition).expect("line 16 names no other row")
}

/// The target edges in a shape that bound a triangle with an area, whose inner side is therefore known.
struct Target<T> {
    edges: Vec<EdgeId>,
    /// The ends of each, with the body on the left.
    segments: Vec<[[T; 2]; 2]>,
}

impl<T: Scalar> Target<T> {
    /// Finds the target edges of `model` in the shape `node_n` (R x 4).
    fn new(model: &Model, node_n: &Table<T>) -> Self {
        let edge = |id: &EdgeId| {
            let beside = model.sides.beside(model.edge(*id).nodes).first()?;
            let place = |node: NodeId| door::coordinates(node_n, node);
            let [a, b] = beside.nodes.map(place);
            let inner = T::orientation(a, b, place(beside.third));
            // A shape may be folded: the triangle's side is taken from the shape.
            let ends = if inner > T::zero() { [a, b] } else { [b, a] };
            (!inner.is_zero()).then_some((*id, ends))
        };
        let (edges, segments) = model.contact.target.iter().filter_map(edge).unzip();
        Target { edges, segments }
    }
}

fn by_intersection<T: Scalar>(
    model: &Model,
    target: &Target<T>,
    node_n: &Table<T>,
    is_near: bool,
    mut status: ContactStatus<T>,
) -> ContactStatus<T> {
    status.in_contact = is_near || intersects(model, target, node_n, status.node);
    if status.in_contact && status.edge.is_none() {
        let nearest = closest(&target.segments, door::coordinates(node_n, status.node));
        status.edge = Some(target.edges[nearest.expect("a surface that is crossed has an edge")]);
    }
    status
}

/// Returns whether a side at contact node `n` leads out of the target.
fn intersects<T: Scalar>(model: &Model, target: &Target<T>, node_n: &Table<T>, n: NodeId) -> bool {
    let c = door::coordinates(node_n, n);
    sides(model, n).into_iter().any(|q| {
        let q = door::coordinates(node_n, q);
        target.segments.iter().map(|edge| crossing(*edge, c, q)).sum::<i32>() > 0
    })
}

/// Returns the nodes that share a triangle with node `n`, ascending.
fn sides(model: &Model, n: NodeId) -> BTreeSet<NodeId> {
    let triangles = model.triangles.iter().map(|t| t.nodes).filter(|t| t.contains(&n));
    triangles.flatten().filter(|other| *other != n).collect()
}

/// Returns +1 where the segment from `c` to `q` crosses the edge from `a` to `b` outwards, −1 inwards, and 0
/// where it does not cross. A corner of two edges is crossed once. A segment that starts on the edge starts
/// inside; one that ends on it ends outside.
fn crossing<T: Scalar>([a, b]: [[T; 2]; 2], c: [T; 2], q: [T; 2]) -> i32 {
    if apart([a, b], [c, q]) {
        return 0;
    }
    let zero = T::zero();
    if (T::orientation(c, q, a) >= zero) == (T::orientation(c, q, b) >= zero) {
        return 0;
    }
    match (T::orientation(a, b, c) >= zero, T::orientation(a, b, q) > zero) {
        (true, false) => 1,
        (false, true) => -1,
        (true, true) | (false, false) => 0,
    }
}

/// Returns whether the boxes around two segments have no point in common.
fn apart<T: Scalar>(one: [[T; 2]; 2], other: [[T; 2]; 2]) -> bool {
    (0..2).any(|axis| {
        let span =
            |[p, q]: [[T; 2]; 2]| (Scalar::min(p[axis], q[axis]), Scalar::max(p[axis], q[axis]));
        let ((low, high), (other_low, other_high)) = (span(one), span(other));
        high < other_low || other_high < low
    })
}
