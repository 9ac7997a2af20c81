//! The printed conditions of `c_cnt`, each once: the operands of its `∧`, in printed order.

use super::failure::{Failure, Line};
use mathcad::Conjunction;
use mathcad::array::{Column, rows};
use numbers::scalar::Scalar;

/// An operand of a printed condition: whether it holds, or that it names an entry that does not exist.
pub type Operand = Result<bool, Failure>;

/// Evaluates Mathcad's `∧` of some operands under reading R4.
///
/// # Errors
/// An operand that is evaluated names an entry that does not exist.
pub fn and(order: Conjunction, operands: &[Operand]) -> Result<bool, Failure> {
    match order {
        Conjunction::LeftToRight => {
            for operand in operands.iter().cloned() {
                if !operand? {
                    return Ok(false);
                }
            }
            Ok(true)
        }
        Conjunction::Eager => {
            operands.iter().cloned().try_fold(true, |all, operand| Ok(operand? && all))
        }
        Conjunction::Guarded => {
            if operands.contains(&Ok(false)) {
                return Ok(false);
            }
            operands.iter().cloned().try_for_each(|operand| operand.map(drop))?;
            Ok(true)
        }
    }
}

/// Line 16: row `i1` of `cnt` is nearer to its edge than the tolerance.
pub fn is_near<T: Scalar>(ct: &Column<usize>, yt: &Column<T>, c_tll: T, i1: usize) -> [Operand; 2] {
    [Ok(yt[i1].abs() < c_tll), Ok(ct[i1] > 0)]
}

/// Line 17: row `i1` of `cnt` is beyond its edge, and the row after it is not.
pub fn is_jumped_after<T: Scalar>(ct: &Column<usize>, yt: &Column<T>, i1: usize) -> [Operand; 4] {
    let after = Line { line: 17, i1, ct: ct[i1] }.entry(yt, i1 + 1);
    [
        Ok(i1 < rows(yt)),
        Ok(yt[i1] < T::zero()),
        after.map(|after| after > T::zero()),
        Ok(ct[i1] > 0),
    ]
}

/// Line 18: row `i1` of `cnt` is beyond its edge, and the row before it is not.
pub fn is_jumped_before<T: Scalar>(ct: &Column<usize>, yt: &Column<T>, i1: usize) -> [Operand; 4] {
    let before = Line { line: 18, i1, ct: ct[i1] }.entry(yt, i1 - 1);
    [Ok(yt[i1] < T::zero()), before.map(|before| before > T::zero()), Ok(i1 >= 2), Ok(ct[i1] > 0)]
}
