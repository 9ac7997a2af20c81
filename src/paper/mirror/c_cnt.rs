//! Listing `c_cnt` (fig. 2): the contact pairs (`listings/READING.md`, section 2).

use super::failure::{Cause, Failure};
use super::reading::{LoopPlace, NodeTable, Reading};
use super::worksheet::Worksheet;
use crate::numbers::scalar::Scalar;
use crate::paper::mathcad::Conjunction;
use crate::paper::mathcad::array::{Column, Table, max, min, rows};

/// The arrays that `c_cnt` computes; the listing returns `k_cnt`.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairs<T> {
    /// The `elem` number of each contact node's target edge; 0 for none.
    pub ct: Column<usize>,
    /// The vertical distance from contact node to target line, > 0 with the line above, length.
    pub yt: Column<T>,
    /// The status of each contact node: 1 in contact, 0 not.
    pub dy: Column<usize>,
    /// The rows of all nodes: mate, weight, mate, weight. R x 4.
    pub k_cnt: Table<T>,
}

impl<T: Scalar> Pairs<T> {
    /// Returns the arrays of no pair, for a scene of `nodes` nodes without contact.
    pub fn none(nodes: usize) -> Self {
        let k_cnt = Table::filled(nodes, 4, T::zero());
        let empty = Column::filled(0, 0);
        Pairs { ct: empty.clone(), yt: Column::filled(0, T::zero()), dy: empty, k_cnt }
    }

    /// Returns the same pairs in other numbers.
    pub fn map<U: Scalar>(&self, to: impl Fn(T) -> U) -> Pairs<U> {
        Pairs {
            ct: self.ct.clone(),
            yt: self.yt.map(&to),
            dy: self.dy.clone(),
            k_cnt: self.k_cnt.map(&to),
        }
    }
}

/// Finds the contact pairs in the current shape `node_n` (R x 4).
/// Errors: the listing fails as printed: a zero x difference (lines 10, 22, 23), `yt` outside its
/// range unless R4 is *guarded* (lines 17, 18), or an overflow.
pub fn c_cnt<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
) -> Result<Pairs<T>, Failure> {
    listing(sheet, reading, node_n, None, &|_| (1..=rows(&sheet.trg)).collect())
}

/// Finds the same pairs; line 4 goes through the rows of `trg` that `near` returns for a row of
/// `cnt`, ascending. Those left out must be rows that line 7 does not take.
/// Errors: those of [`c_cnt`].
pub fn c_cnt_near<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    near: &dyn Fn(usize) -> Vec<usize>,
) -> Result<Pairs<T>, Failure> {
    listing(sheet, reading, node_n, None, near)
}

/// Computes the weights, lines 11 to 31, of nodes whose statuses another rule has `decided`.
/// Errors: those lines fail as printed: a zero x difference (lines 22, 23), or an overflow.
pub fn weights<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    decided: Pairs<T>,
) -> Result<Pairs<T>, Failure> {
    listing(sheet, reading, node_n, Some(decided), &|_| Vec::new())
}

fn listing<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    decided: Option<Pairs<T>>,
    near: &dyn Fn(usize) -> Vec<usize>,
) -> Result<Pairs<T>, Failure> {
    let Worksheet { node, elem, trg, cnt, c_tll, .. } = sheet;
    let (c_tll, zero, one) = (*c_tll, T::zero(), T::one());
    let R = sheet.R();
    let mut ct = Column::filled(rows(cnt), 0);
    let mut yt = Column::filled(rows(cnt), zero);
    let mut dy = Column::filled(rows(cnt), 0);
    let mut k_cnt = Table::filled(R, 4, zero);
    // DIFFERENCE: the results of another rule replace lines 2 to 10 and 15 to 18.
    let (search, is_decided) =
        (1..=if decided.is_some() { 0 } else { rows(cnt) }, decided.is_some());
    if let Some(decided) = decided {
        (ct, yt, dy) = (decided.ct, decided.yt, decided.dy);
    }

    //#  1 c_cnt(node_n) :=
    //#  2 for i1 ∈ 1 .. rows(cnt)
    for i1 in search.clone() {
        //#  3 ct[i1] ← 0
        ct[i1] = 0;
        //#  4 for i2 ∈ 1 .. rows(trg)
        // DIFFERENCE: rows that line 7 would not take may be left out.
        for i2 in near(i1) {
            let here = Line { i1, ct: trg[i2], ..Line::default() };
            //#  5 ntx ← (node_n[elem[trg[i2],6],2] − c_tll   node_n[elem[trg[i2],7],2] + c_tll)ᵀ
            let ntx = [
                here.at(5).finite(node_n[(elem[(trg[i2], 6)], 2)] - c_tll)?,
                here.at(5).finite(node_n[(elem[(trg[i2], 7)], 2)] + c_tll)?,
            ];
            //#  6 nty ← (node_n[elem[trg[i2],6],3] − c_tll   node_n[elem[trg[i2],7],3] + c_tll)ᵀ
            let nty = [
                here.at(6).finite(node_n[(elem[(trg[i2], 6)], 3)] - c_tll)?,
                here.at(6).finite(node_n[(elem[(trg[i2], 7)], 3)] + c_tll)?,
            ];
            //#  7 ct[i1] ← trg[i2] if min(ntx) ≤ node_n[cnt[i1],2] ∧ node_n[cnt[i1],2] ≤ max(ntx) ∧ min(nty) ≤ node_n[cnt[i1],3] ∧ node_n[cnt[i1],3] ≤ max(nty)
            if min(ntx) <= node_n[(cnt[i1], 2)]
                && node_n[(cnt[i1], 2)] <= max(ntx)
                && min(nty) <= node_n[(cnt[i1], 3)]
                && node_n[(cnt[i1], 3)] <= max(nty)
            {
                ct[i1] = trg[i2];
            }
        }
    }
    //#  8 for i1 ∈ 1 .. rows(cnt)
    for i1 in search {
        let here = Line { i1, ct: ct[i1], ..Line::default() };
        //#  9 yt[i1] ← 0
        yt[i1] = zero;
        //# 10 yt[i1] ← ((node_n[elem[ct[i1],7],3] − node_n[elem[ct[i1],6],3]) / (node_n[elem[ct[i1],7],2] − node_n[elem[ct[i1],6],2])) · (node_n[cnt[i1],2] − node_n[elem[ct[i1],6],2]) + node_n[elem[ct[i1],6],3] − node_n[cnt[i1],3] if ct[i1] > 0
        if ct[i1] > 0 {
            yt[i1] = here.at(10).finite(
                here.at(10).quotient(
                    node_n[(elem[(ct[i1], 7)], 3)] - node_n[(elem[(ct[i1], 6)], 3)],
                    node_n[(elem[(ct[i1], 7)], 2)] - node_n[(elem[(ct[i1], 6)], 2)],
                )? * (node_n[(cnt[i1], 2)] - node_n[(elem[(ct[i1], 6)], 2)])
                    + node_n[(elem[(ct[i1], 6)], 3)]
                    - node_n[(cnt[i1], 3)],
            )?;
        }
    }
    //# 11 for i1 ∈ 1 .. R
    for i1 in 1..=R {
        //# 12 for i2 ∈ 1 .. 4
        for i2 in 1..=4 {
            //# 13 k_cnt[i1,i2] ← 0
            k_cnt[(i1, i2)] = zero;
        }
        // AMBIGUOUS R1: the weights loop is beside the zeroing loop (it runs once, after the last
        // row is zeroed), or inside it (it runs after each row).
        if reading.r1 == LoopPlace::Beside && i1 < R {
            continue;
        }
        //# 14 for i1 ∈ 1 .. rows(cnt)
        for i1 in 1..=rows(cnt) {
            let here = Line { i1, ct: ct[i1], ..Line::default() };
            if !is_decided {
                //# 15 dy[i1] ← 0
                dy[i1] = 0;
                //# 16 dy[i1] ← 1 if |yt[i1]| < c_tll ∧ ct[i1] > 0
                if yt[i1].abs() < c_tll && ct[i1] > 0 {
                    dy[i1] = 1;
                }
                // AMBIGUOUS R4: at i1 = rows(cnt) line 17 names yt[i1+1], and at i1 = 1 line 18
                // names yt[0].
                //# 17 dy[i1] ← 1 if i1 < rows(cnt) ∧ yt[i1] < 0 ∧ yt[i1+1] > 0 ∧ ct[i1] > 0
                if and(
                    reading.r4,
                    [
                        &|| Ok(i1 < rows(cnt)),
                        &|| Ok(yt[i1] < zero),
                        &|| Ok(here.at(17).entry(&yt, i1 + 1)? > zero),
                        &|| Ok(ct[i1] > 0),
                    ],
                )? {
                    dy[i1] = 1;
                }
                //# 18 dy[i1] ← 1 if yt[i1] < 0 ∧ yt[i1−1] > 0 ∧ i1 ≥ 2 ∧ ct[i1] > 0
                if and(
                    reading.r4,
                    [
                        &|| Ok(yt[i1] < zero),
                        &|| Ok(here.at(18).entry(&yt, i1 - 1)? > zero),
                        &|| Ok(i1 >= 2),
                        &|| Ok(ct[i1] > 0),
                    ],
                )? {
                    dy[i1] = 1;
                }
            }
            //# 19 if dy[i1] = 1
            if dy[i1] == 1 {
                //# 20 trace(ct[i1])
                // Writes to Mathcad's trace window, no numeric effect.
                //# 21 k_cnt[cnt[i1],1] ← elem[ct[i1],6]
                k_cnt[(cnt[i1], 1)] = T::from_number(elem[(ct[i1], 6)]);
                // AMBIGUOUS R5: initial coordinates, as printed, or current ones.
                let node = if reading.r5 == NodeTable::Node { node } else { node_n };
                //# 22 k1 ← 1 − (node[cnt[i1],2] − node[elem[ct[i1],6],2]) / (node[elem[ct[i1],7],2] − node[elem[ct[i1],6],2])
                let k1 = here.at(22).finite(
                    one - here.at(22).quotient(
                        node[(cnt[i1], 2)] - node[(elem[(ct[i1], 6)], 2)],
                        node[(elem[(ct[i1], 7)], 2)] - node[(elem[(ct[i1], 6)], 2)],
                    )?,
                )?;
                //# 23 k2 ← 1 − (node[elem[ct[i1],7],2] − node[cnt[i1],2]) / (node[elem[ct[i1],7],2] − node[elem[ct[i1],6],2])
                let k2 = here.at(23).finite(
                    one - here.at(23).quotient(
                        node[(elem[(ct[i1], 7)], 2)] - node[(cnt[i1], 2)],
                        node[(elem[(ct[i1], 7)], 2)] - node[(elem[(ct[i1], 6)], 2)],
                    )?,
                )?;
                //# 24 k_cnt[cnt[i1],2] ← k1 + k_cnt[cnt[i1],2]
                k_cnt[(cnt[i1], 2)] = here.at(24).finite(k1 + k_cnt[(cnt[i1], 2)])?;
                //# 25 k_cnt[cnt[i1],3] ← elem[ct[i1],7]
                k_cnt[(cnt[i1], 3)] = T::from_number(elem[(ct[i1], 7)]);
                //# 26 k_cnt[cnt[i1],4] ← k2 + k_cnt[cnt[i1],4]
                k_cnt[(cnt[i1], 4)] = here.at(26).finite(k2 + k_cnt[(cnt[i1], 4)])?;
                //# 27 k_cnt[elem[ct[i1],6],1] ← cnt[i1]
                k_cnt[(elem[(ct[i1], 6)], 1)] = T::from_number(cnt[i1]);
                //# 28 k_cnt[elem[ct[i1],6],2] ← k1 + k_cnt[elem[ct[i1],6],2]
                k_cnt[(elem[(ct[i1], 6)], 2)] =
                    here.at(28).finite(k1 + k_cnt[(elem[(ct[i1], 6)], 2)])?;
                //# 29 k_cnt[elem[ct[i1],7],1] ← cnt[i1]
                k_cnt[(elem[(ct[i1], 7)], 1)] = T::from_number(cnt[i1]);
                //# 30 k_cnt[elem[ct[i1],7],2] ← k2 + k_cnt[elem[ct[i1],7],2]
                k_cnt[(elem[(ct[i1], 7)], 2)] =
                    here.at(30).finite(k2 + k_cnt[(elem[(ct[i1], 7)], 2)])?;
            }
        }
    }
    //# 31 k_cnt
    Ok(Pairs { ct, yt, dy, k_cnt })
}

/// Evaluates Mathcad's `∧` of several operands under reading R4.
fn and(
    order: Conjunction,
    operands: [&dyn Fn() -> Result<bool, Failure>; 4],
) -> Result<bool, Failure> {
    match order {
        Conjunction::LeftToRight => {
            for operand in operands {
                if !operand()? {
                    return Ok(false);
                }
            }
            Ok(true)
        }
        Conjunction::Eager => operands.iter().try_fold(true, |all, operand| Ok(operand()? && all)),
        Conjunction::Guarded => {
            let values = operands.map(|operand| operand());
            if values.contains(&Ok(false)) {
                return Ok(false);
            }
            values.into_iter().try_for_each(|value| value.map(drop))?;
            Ok(true)
        }
    }
}

/// The place in the listing that a failure reports.
#[derive(Clone, Copy, Default)]
struct Line {
    line: usize,
    i1: usize,
    ct: usize,
}

impl Line {
    fn at(self, line: usize) -> Self {
        Line { line, ..self }
    }

    fn failure(self, cause: Cause, values: &[(&str, &dyn std::fmt::Display)]) -> Failure {
        let edge = if self.line < 8 { "trg[i2]" } else { "ct[i1]" };
        let place: [(&str, &dyn std::fmt::Display); 2] = [("i1", &self.i1), (edge, &self.ct)];
        Failure::new("c_cnt", self.line, cause, &[&place, values].concat())
    }

    /// Returns `numerator / denominator`; x/0 and 0/0 are errors.
    fn quotient<T: Scalar>(self, numerator: T, denominator: T) -> Result<T, Failure> {
        let (numerator, denominator) = (self.finite(numerator)?, self.finite(denominator)?);
        if denominator == T::zero() {
            let values: [(&str, &dyn std::fmt::Display); 2] =
                [("numerator", &numerator), ("denominator", &denominator)];
            return Err(self.failure(Cause::Singularity, &values));
        }
        self.finite(numerator / denominator)
    }

    /// Returns `value`, unless it overflowed.
    fn finite<T: Scalar>(self, value: T) -> Result<T, Failure> {
        if value.is_finite() {
            return Ok(value);
        }
        Err(self.failure(Cause::Overflow, &[("value", &value)]))
    }

    /// Returns `yt[index]`, or an error outside 1 .. rows(yt).
    fn entry<T: Scalar>(self, yt: &Column<T>, index: usize) -> Result<T, Failure> {
        let values: [(&str, &dyn std::fmt::Display); 2] =
            [("index of yt", &index), ("rows(yt)", &yt.rows())];
        yt.get(index).copied().ok_or_else(|| self.failure(Cause::InvalidIndex, &values))
    }
}
