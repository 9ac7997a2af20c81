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

use super::nearest::{Edge, TargetSurface, orient, place};
use super::operations::Operations;
use crate::paper::mathcad::array::{Column, Table};
use crate::paper::mirror::{
    Cause, Failure, LoopPlace, NodeTable, Order, Pairs, Reading, Worksheet, c_cnt,
};
use crate::problem::modelling::StatusRule;

/// Target edges and statuses, by contact node.
#[derive(Clone, Debug, PartialEq)]
pub struct Statuses {
    /// `elem` number of the target edge: `c_cnt`'s, and where it found none for a node in contact, the nearest; under *projection* the
    /// nearest for each node, 0 past the surface's end.
    pub ct: Column<usize>,
    /// `c_cnt`'s yt; under *projection* minus the signed distance to the nearest edge: > 0 inside the target. Length.
    pub yt: Column<f64>,
    /// 1 = in contact.
    pub dy: Column<usize>,
}

/// The contact pairs in the shape `node_n` (R x 4), statuses by `rule`. The weights are those of lines 21 to 30 of `c_cnt`.
///
/// # Errors
/// Where the lines of `c_cnt` that the rule keeps fail as printed: all of them under *signs*; 1 to 16 under *intersection*, and 19 to 30
/// under both other rules: the weights of a vertical edge.
pub fn pairs(
    rule: StatusRule,
    sheet: &Worksheet<f64>,
    reading: &Reading,
    node_n: &Table<f64>,
) -> Result<Pairs<f64>, Failure> {
    if rule == StatusRule::Signs {
        return c_cnt(sheet, reading, node_n);
    }
    let Statuses { ct, yt, dy } = statuses(rule, sheet, reading, node_n, &Operations::default())?;
    let node = match reading.r5 {
        NodeTable::Node => &sheet.node,
        NodeTable::NodeN => node_n,
    };
    let k_cnt = weights(sheet, reading.r1, node, &ct, &dy)?;
    Ok(Pairs { ct, yt, dy, k_cnt })
}

/// Target edges and statuses alone, counting the operations beside those of `c_cnt`.
///
/// # Errors
/// Where the lines of `c_cnt` that the rule keeps fail as printed; never under *projection*.
pub fn statuses(
    rule: StatusRule,
    sheet: &Worksheet<f64>,
    reading: &Reading,
    node_n: &Table<f64>,
    operations: &Operations,
) -> Result<Statuses, Failure> {
    let surface = || TargetSurface::new(sheet, node_n);
    match rule {
        StatusRule::Signs => {
            let Pairs { ct, yt, dy, .. } = c_cnt(sheet, reading, node_n)?;
            Ok(Statuses { ct, yt, dy })
        }
        StatusRule::Intersection => {
            // The sign rule takes no part: a false operand keeps its lines from failing.
            let reading = Reading { r4: Order::Guarded, ..*reading };
            let printed = c_cnt(sheet, &reading, node_n)?;
            Ok(by_intersection(sheet, node_n, &surface(), printed, operations))
        }
        StatusRule::Projection => Ok(by_projection(sheet, node_n, &surface(), operations)),
    }
}

fn by_intersection(
    sheet: &Worksheet<f64>,
    node_n: &Table<f64>,
    surface: &TargetSurface,
    printed: Pairs<f64>,
    operations: &Operations,
) -> Statuses {
    let Pairs { mut ct, yt, mut dy, .. } = printed;
    for i1 in 1..=sheet.cnt.rows() {
        operations.add(1);
        let near = ct[i1] > 0 && yt[i1].abs() < sheet.c_tll;
        let inside = near || intersects(sheet, node_n, surface, sheet.cnt[i1], operations);
        dy[i1] = usize::from(inside);
        if inside && ct[i1] == 0 {
            let foot = surface.nearest_counted(place(node_n, sheet.cnt[i1]), operations);
            ct[i1] = foot.expect("a surface that is crossed has an edge").edge;
        }
    }
    Statuses { ct, yt, dy }
}

/// Whether a side at contact node `n` leads out of the target.
fn intersects(
    sheet: &Worksheet<f64>,
    node_n: &Table<f64>,
    surface: &TargetSurface,
    n: usize,
    operations: &Operations,
) -> bool {
    let c = place(node_n, n);
    sides(sheet, n).into_iter().any(|q| {
        let q = place(node_n, q);
        surface.edges.iter().map(|edge| crossing(edge, c, q, operations)).sum::<i32>() > 0
    })
}

/// The nodes that share a triangle with node `n`, in order.
fn sides(sheet: &Worksheet<f64>, n: usize) -> Vec<usize> {
    let nodes = |m: usize| [0, 1, 2].map(|k| sheet.EL[(m, sheet.ind_1 + k)]);
    let triangles = (1..=sheet.M()).map(nodes).filter(|t| t.contains(&n));
    let mut others: Vec<usize> = triangles.flatten().filter(|other| *other != n).collect();
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
    sheet: &Worksheet<f64>,
    node_n: &Table<f64>,
    surface: &TargetSurface,
    operations: &Operations,
) -> Statuses {
    let rows = sheet.cnt.rows();
    let (mut ct, mut dy) = (Column::filled(rows, 0), Column::filled(rows, 0));
    let mut yt = Column::filled(rows, 0.0);
    for i1 in 1..=rows {
        let Some(foot) = surface.nearest_counted(place(node_n, sheet.cnt[i1]), operations) else {
            continue;
        };
        operations.add(2);
        yt[i1] = 0.0 - foot.distance;
        if foot.beyond <= sheet.c_tll {
            ct[i1] = foot.edge;
            dy[i1] = usize::from(foot.distance <= sheet.c_tll);
        }
    }
    Statuses { ct, yt, dy }
}

/// `k_cnt` from target edges and statuses: lines 11 to 30 of `c_cnt` under reading R1, `node` being the shape that R5 names.
fn weights(
    sheet: &Worksheet<f64>,
    r1: LoopPlace,
    node: &Table<f64>,
    ct: &Column<usize>,
    dy: &Column<usize>,
) -> Result<Table<f64>, Failure> {
    let mut k_cnt = Table::filled(sheet.R(), 4, 0.0);
    for row in 1..=sheet.R() {
        for column in 1..=4 {
            k_cnt[(row, column)] = 0.0;
        }
        if r1 == LoopPlace::Beside && row < sheet.R() {
            continue;
        }
        for i1 in (1..=ct.rows()).filter(|&i1| dy[i1] == 1) {
            link(sheet, node, (i1, ct[i1]), &mut k_cnt)?;
        }
    }
    Ok(k_cnt)
}

/// Lines 21 to 30 of `c_cnt` for contact node `i1` and target edge `e`.
fn link(
    sheet: &Worksheet<f64>,
    node: &Table<f64>,
    (i1, e): (usize, usize),
    k_cnt: &mut Table<f64>,
) -> Result<(), Failure> {
    let (c, a, b) = (sheet.cnt[i1], sheet.elem[(e, 6)], sheet.elem[(e, 7)]);
    let x = |n: usize| node[(n, 2)];
    let length = x(b) - x(a);
    let failure = |cause| {
        let values: [(&str, &dyn std::fmt::Display); 3] =
            [("i1", &i1), ("ct[i1]", &e), ("denominator", &length)];
        Failure::new("c_cnt", 22, cause, &values)
    };
    if length == 0.0 {
        return Err(failure(Cause::Singularity));
    }
    let (k1, k2) = (1.0 - (x(c) - x(a)) / length, 1.0 - (x(b) - x(c)) / length);
    if !(k1 + k2).is_finite() {
        return Err(failure(Cause::Overflow));
    }
    for (node, weight) in [(a, k1), (b, k2)] {
        let own = if node == a { 1 } else { 3 };
        k_cnt[(c, own)] = node as f64;
        k_cnt[(c, own + 1)] += weight;
        k_cnt[(node, 1)] = c as f64;
        k_cnt[(node, 2)] += weight;
    }
    Ok(())
}
