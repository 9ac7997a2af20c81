//! The conditions of `c_cnt` that rounding may decide: its listing is run in numbers that carry a
//! bound on their error, and its comparisons are looked at again afterwards.
//!
//! A comparison of a and b is sure where |a − b| is beyond the bound on its error. A conjunction is
//! surely false where one of its operands is, whatever the others are, and surely true where all of
//! them are; otherwise the operands that are not sure leave it to rounding. A condition that another
//! one has already settled does not count. Where none is left to rounding, exact arithmetic takes
//! the same turns.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::mathcad;
use super::mathcad::array::{Table, rows};
use super::mirror::{Pairs, Reading, Worksheet};
use super::near::Boxes;
use crate::numbers::scalar::{Scalar, Unsure};
use crate::problem::model::NodeId;

/// A decision on who is in contact that rounding may have taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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
        let [margin, bound] = [by.margin, by.bound].map(|x| Some(x).filter(|x| x.is_finite()));
        Decision { iteration, node, condition, margin, bound }
    }
}

/// A comparison of two numbers: what it says, and how sure that is.
#[derive(Clone, Copy)]
struct Comparison {
    line: usize,
    text: &'static str,
    holds: bool,
    margin: f64,
    bound: f64,
}

impl Comparison {
    /// Compares `a` and `b`, where `holds` says what comes of it.
    fn new<T: Scalar>(line: usize, text: &'static str, holds: bool, [a, b]: [T; 2]) -> Self {
        let difference = a - b;
        let bound = difference.error_bound().unwrap_or(0.0);
        Comparison { line, text, holds, margin: difference.to_f64().abs(), bound }
    }

    fn less<T: Scalar>(line: usize, text: &'static str, a: T, b: T) -> Self {
        Comparison::new(line, text, a < b, [a, b])
    }

    fn at_most<T: Scalar>(line: usize, text: &'static str, a: T, b: T) -> Self {
        Comparison::new(line, text, a <= b, [a, b])
    }

    fn is_sure(&self) -> bool {
        // Where both sides are exact, so is the comparison, also of equal ones.
        self.margin > self.bound || self.bound == 0.0
    }

    fn is_surely(&self, holds: bool) -> bool {
        self.is_sure() && self.holds == holds
    }

    /// Returns the comparison on which "this one or the other" hangs.
    fn or(self, other: Self) -> Self {
        let [first, second] = if self.is_surely(false) { [other, self] } else { [self, other] };
        if second.is_surely(true) { second } else { first }
    }
}

/// The operands of a conjunction on which it hangs; none where it is surely true.
enum Conjunction {
    True,
    False,
    Left(Vec<Comparison>),
}

fn all(operands: &[Comparison]) -> Conjunction {
    if operands.iter().any(|operand| operand.is_surely(false)) {
        return Conjunction::False;
    }
    let left: Vec<Comparison> = operands.iter().filter(|o| !o.is_sure()).copied().collect();
    if left.is_empty() { Conjunction::True } else { Conjunction::Left(left) }
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
    let boxes = Boxes::new(sheet, node_n);
    let of_node = |i1: usize| {
        let near = boxes.as_ref().map(|boxes| boxes.near(i1));
        let near = near.unwrap_or_else(|| (1..=rows(&sheet.trg)).collect());
        let left = edge(sheet, node_n, i1, &near);
        let left = left.into_iter().chain(status(sheet, reading, pairs, i1));
        left.map(move |Comparison { line, text, margin, bound, .. }| {
            let node = NodeId::from_number(sheet.cnt[i1]);
            let condition = format!("c_cnt {line}: {text}");
            Decision::unsure(iteration, node, condition, Unsure { margin, bound })
        })
    };
    (1..=rows(&sheet.cnt)).flat_map(of_node).collect()
}

/// Returns what leaves the target edge of contact node `i1` to rounding, lines 4 to 7; the boxes of
/// all rows of `trg` but those `near` it surely do not have it.
fn edge<T: Scalar>(
    sheet: &Worksheet<T>,
    node_n: &Table<T>,
    i1: usize,
    near: &[usize],
) -> Vec<Comparison> {
    let mut left = Vec::new();
    // The last edge whose box has the node is its edge: those before a sure one do not count.
    for &i2 in near.iter().rev() {
        let place = |node: usize, column: usize| node_n[(node, column)];
        let side = |column: usize, texts: [&'static str; 2]| {
            let [from, to] = [6, 7].map(|j| place(sheet.elem[(sheet.trg[i2], j)], column));
            let (low, high) = (from - sheet.c_tll, to + sheet.c_tll);
            let at = place(sheet.cnt[i1], column);
            let above = |limit: T| Comparison::at_most(7, texts[0], limit, at);
            let below = |limit: T| Comparison::at_most(7, texts[1], at, limit);
            // The smaller one is at most x where one of the two is.
            [above(low).or(above(high)), below(low).or(below(high))]
        };
        let [left_of, right_of] =
            side(2, ["min(ntx) <= x of the node", "x of the node <= max(ntx)"]);
        let [under, over] = side(3, ["min(nty) <= y of the node", "y of the node <= max(nty)"]);
        match all(&[left_of, right_of, under, over]) {
            Conjunction::True => break,
            Conjunction::False => (),
            Conjunction::Left(operands) => left.extend(operands),
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
) -> Vec<Comparison> {
    let (yt, zero) = (&pairs.yt, T::zero());
    let below = |line: usize| Comparison::less(line, "yt[i1] < 0", yt[i1], zero);
    // At i1 = 1 line 18 fails from left to right where its first operand holds.
    let fails = reading.r4 == mathcad::Conjunction::LeftToRight && i1 == 1 && !below(18).is_sure();
    let mut left = Vec::from_iter(fails.then(|| below(18)));
    if pairs.ct[i1] == 0 {
        return left;
    }
    let near = Comparison::less(16, "|yt[i1]| < c_tll", Scalar::abs(yt[i1]), sheet.c_tll);
    let mut conditions = vec![all(&[near])];
    if i1 < rows(yt) {
        let next = Comparison::less(17, "yt[i1+1] > 0", zero, yt[i1 + 1]);
        conditions.push(all(&[below(17), next]));
    }
    if i1 >= 2 {
        let last = Comparison::less(18, "yt[i1-1] > 0", zero, yt[i1 - 1]);
        conditions.push(all(&[below(18), last]));
    }
    if conditions.iter().any(|condition| matches!(condition, Conjunction::True)) {
        return left;
    }
    for condition in conditions {
        if let Conjunction::Left(operands) = condition {
            left.extend(operands);
        }
    }
    left
}
