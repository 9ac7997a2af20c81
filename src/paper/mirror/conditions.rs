//! The printed conditions of `c_cnt`, each once: the operands of its `∧`, in printed order.

use super::failure::{Failure, Line};
use mathcad::Conjunction;
use mathcad::array::{Column, Table, max, min, rows};
use numbers::scalar::Scalar;

/// An operand of a printed condition.
#[derive(Clone, Debug)]
pub struct Operand<T> {
    /// The listing line of the condition.
    pub line: usize,
    /// The comparison in words.
    pub text: &'static str,
    /// What it compares.
    pub comparison: Comparison<T>,
}

/// A comparison of numbers of the worksheet.
#[derive(Clone, Debug)]
pub enum Comparison<T> {
    /// The smaller of two numbers is at most another.
    MinAtMost([T; 2], T),
    /// A number is at most the larger of two others.
    AtMostMax(T, [T; 2]),
    /// A number is less than another.
    Less(T, T),
    /// A comparison of whole numbers, which has a result in any scalar.
    Whole(bool),
    /// The operand names an entry that does not exist.
    Fails(Failure),
}

impl<T: Scalar> Operand<T> {
    /// Makes the comparison.
    ///
    /// # Errors
    /// The operand names an entry that does not exist.
    pub fn value(&self) -> Result<bool, Failure> {
        match &self.comparison {
            Comparison::MinAtMost(smaller, larger) => Ok(min(*smaller) <= *larger),
            Comparison::AtMostMax(smaller, larger) => Ok(*smaller <= max(*larger)),
            Comparison::Less(smaller, larger) => Ok(smaller < larger),
            Comparison::Whole(value) => Ok(*value),
            Comparison::Fails(failure) => Err(failure.clone()),
        }
    }
}

/// Evaluates Mathcad's `∧` of some operands under reading R4.
///
/// # Errors
/// An operand that is evaluated names an entry that does not exist.
pub fn and<T: Scalar>(order: Conjunction, operands: &[Operand<T>]) -> Result<bool, Failure> {
    match order {
        Conjunction::LeftToRight => {
            for operand in operands {
                if !operand.value()? {
                    return Ok(false);
                }
            }
            Ok(true)
        }
        Conjunction::Eager => {
            operands.iter().try_fold(true, |all, operand| Ok(operand.value()? && all))
        }
        Conjunction::Guarded => {
            let values: Vec<_> = operands.iter().map(Operand::value).collect();
            if values.contains(&Ok(false)) {
                return Ok(false);
            }
            values.into_iter().try_for_each(|value| value.map(drop))?;
            Ok(true)
        }
    }
}

/// Line 7: node `n` is in the box `ntx`, `nty` of a target edge.
pub fn is_in_box<T: Scalar>(
    ntx: [T; 2],
    nty: [T; 2],
    node_n: &Table<T>,
    n: usize,
) -> [Operand<T>; 4] {
    let [x, y] = [node_n[(n, 2)], node_n[(n, 3)]];
    let operand = |text, comparison| Operand { line: 7, text, comparison };
    [
        operand("min(ntx) <= x of the node", Comparison::MinAtMost(ntx, x)),
        operand("x of the node <= max(ntx)", Comparison::AtMostMax(x, ntx)),
        operand("min(nty) <= y of the node", Comparison::MinAtMost(nty, y)),
        operand("y of the node <= max(nty)", Comparison::AtMostMax(y, nty)),
    ]
}

/// Line 16: row `i1` of `cnt` is nearer to its edge than the tolerance.
pub fn is_near<T: Scalar>(
    ct: &Column<usize>,
    yt: &Column<T>,
    c_tll: T,
    i1: usize,
) -> [Operand<T>; 2] {
    let operand = |text, comparison| Operand { line: 16, text, comparison };
    [
        operand("|yt[i1]| < c_tll", Comparison::Less(yt[i1].abs(), c_tll)),
        operand("ct[i1] > 0", Comparison::Whole(ct[i1] > 0)),
    ]
}

/// Line 17: row `i1` of `cnt` is beyond its edge, and the row after it is not.
pub fn is_jumped_after<T: Scalar>(
    ct: &Column<usize>,
    yt: &Column<T>,
    i1: usize,
) -> [Operand<T>; 4] {
    let operand = |text, comparison| Operand { line: 17, text, comparison };
    let here = Line { line: 17, i1, ct: ct[i1] };
    [
        operand("i1 < rows(cnt)", Comparison::Whole(i1 < rows(yt))),
        operand("yt[i1] < 0", Comparison::Less(yt[i1], T::zero())),
        operand("yt[i1+1] > 0", is_positive(here.entry(yt, i1 + 1))),
        operand("ct[i1] > 0", Comparison::Whole(ct[i1] > 0)),
    ]
}

/// Line 18: row `i1` of `cnt` is beyond its edge, and the row before it is not.
pub fn is_jumped_before<T: Scalar>(
    ct: &Column<usize>,
    yt: &Column<T>,
    i1: usize,
) -> [Operand<T>; 4] {
    let operand = |text, comparison| Operand { line: 18, text, comparison };
    let here = Line { line: 18, i1, ct: ct[i1] };
    [
        operand("yt[i1] < 0", Comparison::Less(yt[i1], T::zero())),
        operand("yt[i1-1] > 0", is_positive(here.entry(yt, i1 - 1))),
        operand("i1 >= 2", Comparison::Whole(i1 >= 2)),
        operand("ct[i1] > 0", Comparison::Whole(ct[i1] > 0)),
    ]
}

fn is_positive<T: Scalar>(entry: Result<T, Failure>) -> Comparison<T> {
    match entry {
        Ok(entry) => Comparison::Less(T::zero(), entry),
        Err(failure) => Comparison::Fails(failure),
    }
}
