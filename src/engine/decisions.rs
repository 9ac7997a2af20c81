//! The conditions of `c_cnt` that rounding may decide: its listing is run in numbers that carry a
//! bound on their error, and its comparisons are looked at again afterwards.
//!
//! A comparison of a and b is sure where |a − b| is beyond the bound on its error. A conjunction is
//! surely false where one of its operands is, whatever the others are, and surely true where all of
//! them are; otherwise the operands that are not sure leave it to rounding. A condition that another
//! one has already settled does not count. Where none is left to rounding, exact arithmetic takes
//! the same turns.

use serde::{Deserialize, Serialize};

use mathcad::Conjunction;
use mathcad::array::{Table, rows};
use numbers::finite;
use numbers::scalar::{Scalar, Unsure};
use paper::mirror::{
    Comparison, Operand, Pairs, Reading, Worksheet, edge_box, is_in_box, is_jumped_after,
    is_jumped_before, is_near,
};
use problem::model::NodeId;

/// A decision on who is in contact that rounding may have taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// The iteration, from 1.
    pub iteration: usize,
    /// The contact node.
    pub node: NodeId,
    /// The comparison and its listing line, or what else was found to differ.
    pub condition: String,
    /// |a − b| of the two sides that are compared, length; None where no two sides are.
    pub margin: Option<f64>,
    /// The bound on the rounding error of a − b, length; None where none is known.
    pub bound: Option<f64>,
}

impl Decision {
    /// A comparison in iteration `iteration` that counts for `node` and that rounding may have
    /// decided.
    pub fn unsure(iteration: usize, node: NodeId, condition: String, by: Unsure) -> Self {
        let [margin, bound] = [by.margin, by.bound].map(finite);
        Decision { iteration, node, condition, margin, bound }
    }
}

/// What numbers with bounds say of a condition.
enum Truth<T> {
    True,
    False,
    /// It hangs on these operands, each of which rounding may have decided.
    Unsure(Vec<(Operand<T>, Unsure)>),
}

/// Returns what is sure of a condition under reading R4. An operand that would fail is not evaluated:
/// from left to right the operands before it decide whether it is, and otherwise one of the others is
/// surely false, as the listing has run.
fn truth<T: Scalar>(order: Conjunction, condition: &[Operand<T>]) -> Truth<T> {
    let mut unsure = Vec::new();
    for operand in condition {
        match of_operand(operand) {
            Some(Ok(true)) => (),
            Some(Ok(false)) => return Truth::False,
            Some(Err(by)) => unsure.push((operand.clone(), by)),
            None => match order {
                Conjunction::LeftToRight => return Truth::Unsure(unsure),
                Conjunction::Guarded | Conjunction::Eager => (),
            },
        }
    }
    if unsure.is_empty() { Truth::True } else { Truth::Unsure(unsure) }
}

/// Returns whether an operand surely holds, or by how little it may not; None where it fails.
fn of_operand<T: Scalar>(operand: &Operand<T>) -> Option<Result<bool, Unsure>> {
    let compared = |smaller: T, larger: T, holds: bool| {
        Unsure::from_comparison(smaller, larger).map_or(Ok(holds), Err)
    };
    let at_most = |smaller: T, larger: T| compared(smaller, larger, smaller <= larger);
    let or = |one, other| match (one, other) {
        (Ok(true), _) | (_, Ok(true)) => Ok(true),
        (Ok(false), rest) => rest,
        (Err(by), Ok(false) | Err(_)) => Err(by),
    };
    match operand.comparison {
        Comparison::MinAtMost([a, b], x) => Some(or(at_most(a, x), at_most(b, x))),
        Comparison::AtMostMax(x, [a, b]) => Some(or(at_most(x, a), at_most(x, b))),
        Comparison::Less(a, b) => Some(compared(a, b, a < b)),
        Comparison::Whole(value) => Some(Ok(value)),
        Comparison::Fails(_) => None,
    }
}

/// Returns the decisions that `c_cnt` left to rounding when it found `pairs` in the shape `node_n`
/// (R x 4), in the order of the contact surface. `pairs` are in numbers that carry a bound.
pub fn decisions<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    pairs: &Pairs<T>,
    iteration: usize,
) -> Vec<Decision> {
    let mut decisions = Vec::new();
    for i1 in 1..=rows(&sheet.cnt) {
        let mut unsure = edge(sheet, reading, node_n, i1);
        unsure.extend(status(sheet, reading, pairs, i1));
        for (operand, by) in unsure {
            let condition = format!("c_cnt {}: {}", operand.line, operand.text);
            let node = NodeId::from_number(sheet.cnt[i1]);
            decisions.push(Decision::unsure(iteration, node, condition, by));
        }
    }
    decisions
}

/// Returns what leaves the target edge of contact node `i1` to rounding, lines 4 to 7.
fn edge<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    i1: usize,
) -> Vec<(Operand<T>, Unsure)> {
    let mut left = Vec::new();
    // The last edge whose box has the node is its edge: those before a sure one do not count.
    for i2 in (1..=rows(&sheet.trg)).rev() {
        let (ntx, nty) = edge_box(sheet, node_n, i1, i2).expect("the listing has run");
        match truth(reading.r4, &is_in_box(ntx, nty, node_n, sheet.cnt[i1])) {
            Truth::True => break,
            Truth::False => (),
            Truth::Unsure(operands) => left.extend(operands),
        }
    }
    left
}

/// Returns what leaves the status of contact node `i1` to rounding, lines 16 to 18.
fn status<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    pairs: &Pairs<T>,
    i1: usize,
) -> Vec<(Operand<T>, Unsure)> {
    let Pairs { ct, yt, .. } = pairs;
    let near = truth(reading.r4, &is_near(ct, yt, sheet.c_tll, i1));
    let after = truth(reading.r4, &is_jumped_after(ct, yt, i1));
    let before = truth(reading.r4, &is_jumped_before(ct, yt, i1));
    let (mut left, conditions) = match before {
        // From left to right line 18 fails at the first node where yt[1] < 0: nothing settles that.
        Truth::Unsure(operands) if i1 == 1 => (operands, vec![near, after]),
        before => (Vec::new(), vec![near, after, before]),
    };
    if conditions.iter().any(|condition| matches!(condition, Truth::True)) {
        return left;
    }
    for condition in conditions {
        if let Truth::Unsure(operands) = condition {
            left.extend(operands);
        }
    }
    left
}
