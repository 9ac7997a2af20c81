//! Listing `c_cnt` (fig. 2): the contact pairs (`listings/READING.md`, section 2).
//!
//! [`c_cnt`] is the listing. Below it stand its parts: [`edges`] is lines 2 to 7, [`on_edges`] the rest:
//! [`distances`] 8 to 10, [`weights`] 11 to 14 with [`status`] 15 to 18 and [`link`] 19 to 30.

use super::conditions::{and, is_jumped_after, is_jumped_before, is_near};
use super::failure::{Failure, Line};
use super::reading::{NodeTable, Reading};
use super::worksheet::Worksheet;
use mathcad::Conjunction;
use mathcad::array::{Column, Table, max, min, rows};
use numbers::scalar::Scalar;

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

    /// Returns the row of k_cnt of a node, given by its number.
    pub fn row(&self, node: usize) -> [T; 4] {
        [1, 2, 3, 4].map(|j| self.k_cnt[(node, j)])
    }

    /// Returns the number of each node in whose row of k_cnt something is written, ascending, with the row.
    pub fn written(&self) -> impl Iterator<Item = (usize, [T; 4])> {
        let rows = (1..=self.k_cnt.rows()).map(|node| (node, self.row(node)));
        rows.filter(|(_, row)| row.iter().any(|x| !x.is_zero()))
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
///
/// # Errors
/// The listing fails as printed: a zero x difference (lines 10, 22, 23), `yt` outside its range
/// unless R4 is *guarded* (lines 17, 18), or an overflow.
pub fn c_cnt<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
) -> Result<Pairs<T>, Failure> {
    //#  1 c_cnt(node_n) :=
    let ct = edges(sheet, node_n)?;
    on_edges(sheet, reading, node_n, ct)
}

/// Finds the pairs on the target edges `ct`: lines 8 to 31.
///
/// # Errors
/// Those of [`c_cnt`] from line 8 on.
fn on_edges<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    ct: Column<usize>,
) -> Result<Pairs<T>, Failure> {
    let yt = distances(sheet, node_n, &ct)?;
    let status = |i1| status(sheet, reading, &ct, &yt, i1);
    let (dy, k_cnt) = weights(sheet, reading, node_n, &ct, &status)?;
    //# 31 k_cnt
    Ok(Pairs { ct, yt, dy, k_cnt })
}

/// Finds the target edge of each contact node, `ct`: lines 2 to 7.
///
/// # Errors
/// A box overflows.
pub fn edges<T: Scalar>(sheet: &Worksheet<T>, node_n: &Table<T>) -> Result<Column<usize>, Failure> {
    let Worksheet { trg, cnt, .. } = sheet;
    let mut ct = Column::filled(rows(cnt), 0);
    //#  2 for i1 ∈ 1 .. rows(cnt)
    for i1 in 1..=rows(cnt) {
        //#  3 ct[i1] ← 0
        ct[i1] = 0;
        //#  4 for i2 ∈ 1 .. rows(trg)
        for i2 in 1..=rows(trg) {
            edge(sheet, node_n, i1, i2, &mut ct)?;
        }
    }
    Ok(ct)
}

/// Takes row `i2` of `trg` for the edge of row `i1` of `cnt` if its box has the node: lines 5 to 7.
///
/// # Errors
/// The box overflows.
fn edge<T: Scalar>(
    sheet: &Worksheet<T>,
    node_n: &Table<T>,
    i1: usize,
    i2: usize,
    ct: &mut Column<usize>,
) -> Result<(), Failure> {
    let Worksheet { elem, trg, cnt, c_tll, .. } = sheet;
    let here = Line { i1, ct: trg[i2], ..Line::default() };
    //#  5 ntx ← (node_n[elem[trg[i2],6],2] − c_tll   node_n[elem[trg[i2],7],2] + c_tll)ᵀ
    let ntx = [
        here.at_line(5).finite(node_n[(elem[(trg[i2], 6)], 2)] - *c_tll)?,
        here.at_line(5).finite(node_n[(elem[(trg[i2], 7)], 2)] + *c_tll)?,
    ];
    //#  6 nty ← (node_n[elem[trg[i2],6],3] − c_tll   node_n[elem[trg[i2],7],3] + c_tll)ᵀ
    let nty = [
        here.at_line(6).finite(node_n[(elem[(trg[i2], 6)], 3)] - *c_tll)?,
        here.at_line(6).finite(node_n[(elem[(trg[i2], 7)], 3)] + *c_tll)?,
    ];
    let [x, y] = [2, 3].map(|column| node_n[(cnt[i1], column)]);
    // No operand of it fails: the order in which they are evaluated (R4) decides nothing.
    //#  7 ct[i1] ← trg[i2] if min(ntx) ≤ node_n[cnt[i1],2] ∧ node_n[cnt[i1],2] ≤ max(ntx) ∧ min(nty) ≤ node_n[cnt[i1],3] ∧ node_n[cnt[i1],3] ≤ max(nty)
    if min(ntx) <= x && x <= max(ntx) && min(nty) <= y && y <= max(nty) {
        ct[i1] = trg[i2];
    }
    Ok(())
}

/// Measures the vertical distance from each contact node to its target line, `yt`: lines 8 to 10.
///
/// # Errors
/// The line is vertical, or a distance overflows.
pub fn distances<T: Scalar>(
    sheet: &Worksheet<T>,
    node_n: &Table<T>,
    ct: &Column<usize>,
) -> Result<Column<T>, Failure> {
    let Worksheet { elem, cnt, .. } = sheet;
    let mut yt = Column::filled(rows(cnt), T::zero());
    //#  8 for i1 ∈ 1 .. rows(cnt)
    for i1 in 1..=rows(cnt) {
        let here = Line { i1, ct: ct[i1], ..Line::default() };
        //#  9 yt[i1] ← 0
        yt[i1] = T::zero();
        //# 10 yt[i1] ← ((node_n[elem[ct[i1],7],3] − node_n[elem[ct[i1],6],3]) / (node_n[elem[ct[i1],7],2] − node_n[elem[ct[i1],6],2])) · (node_n[cnt[i1],2] − node_n[elem[ct[i1],6],2]) + node_n[elem[ct[i1],6],3] − node_n[cnt[i1],3] if ct[i1] > 0
        if ct[i1] > 0 {
            yt[i1] = here.at_line(10).finite(
                here.at_line(10).quotient(
                    node_n[(elem[(ct[i1], 7)], 3)] - node_n[(elem[(ct[i1], 6)], 3)],
                    node_n[(elem[(ct[i1], 7)], 2)] - node_n[(elem[(ct[i1], 6)], 2)],
                )? * (node_n[(cnt[i1], 2)] - node_n[(elem[(ct[i1], 6)], 2)])
                    + node_n[(elem[(ct[i1], 6)], 3)]
                    - node_n[(cnt[i1], 3)],
            )?;
        }
    }
    Ok(yt)
}

/// Computes `dy` and `k_cnt`: lines 11 to 14, and in them the status that `status` decides for row
/// i1 of `cnt` (the listing's own is [`status`]) and lines 19 to 30.
///
/// # Errors
/// Those of `status`; a weight has a zero x difference, or overflows.
pub fn weights<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    ct: &Column<usize>,
    status: &dyn Fn(usize) -> Result<usize, Failure>,
) -> Result<(Column<usize>, Table<T>), Failure> {
    let R = sheet.R();
    let mut dy = Column::filled(rows(&sheet.cnt), 0);
    let mut k_cnt = Table::filled(R, 4, T::zero());
    //# 11 for i1 ∈ 1 .. R
    for i1 in 1..=R {
        //# 12 for i2 ∈ 1 .. 4
        for i2 in 1..=4 {
            //# 13 k_cnt[i1,i2] ← 0
            k_cnt[(i1, i2)] = T::zero();
        }
        // AMBIGUOUS R1: the weights loop is beside the zeroing loop (it runs once, after the last
        // row is zeroed), or inside it (it runs after each row).
        if reading.r1.is_beside() && i1 < R {
            continue;
        }
        //# 14 for i1 ∈ 1 .. rows(cnt)
        for i1 in 1..=rows(&sheet.cnt) {
            dy[i1] = status(i1)?;
            link(sheet, reading, node_n, ct, &dy, i1, &mut k_cnt)?;
        }
    }
    Ok((dy, k_cnt))
}

/// Decides the status of row `i1` of `cnt`, `dy[i1]`: lines 15 to 18.
///
/// # Errors
/// Reading R4 evaluates an entry of `yt` that does not exist.
pub fn status<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    ct: &Column<usize>,
    yt: &Column<T>,
    i1: usize,
) -> Result<usize, Failure> {
    //# 15 dy[i1] ← 0
    let mut dy = 0;
    //# 16 dy[i1] ← 1 if |yt[i1]| < c_tll ∧ ct[i1] > 0
    if and(Conjunction::LeftToRight, &is_near(ct, yt, sheet.c_tll, i1))? {
        dy = 1;
    }
    // AMBIGUOUS R4: at i1 = rows(cnt) line 17 names yt[i1+1], and at i1 = 1 line 18 names yt[0].
    //# 17 dy[i1] ← 1 if i1 < rows(cnt) ∧ yt[i1] < 0 ∧ yt[i1+1] > 0 ∧ ct[i1] > 0
    if and(reading.r4, &is_jumped_after(ct, yt, i1))? {
        dy = 1;
    }
    //# 18 dy[i1] ← 1 if yt[i1] < 0 ∧ yt[i1−1] > 0 ∧ i1 ≥ 2 ∧ ct[i1] > 0
    if and(reading.r4, &is_jumped_before(ct, yt, i1))? {
        dy = 1;
    }
    Ok(dy)
}

/// Adds the weights of row `i1` of `cnt` to `k_cnt` if `dy[i1]` is 1: lines 19 to 30.
///
/// # Errors
/// A zero x difference, or an overflow.
pub fn link<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    ct: &Column<usize>,
    dy: &Column<usize>,
    i1: usize,
    k_cnt: &mut Table<T>,
) -> Result<(), Failure> {
    let Worksheet { elem, cnt, .. } = sheet;
    let here = Line { i1, ct: ct[i1], ..Line::default() };
    //# 19 if dy[i1] = 1
    if dy[i1] == 1 {
        //# 20 trace(ct[i1])
        // Writes to Mathcad's trace window, no numeric effect.
        //# 21 k_cnt[cnt[i1],1] ← elem[ct[i1],6]
        k_cnt[(cnt[i1], 1)] = T::from_number(elem[(ct[i1], 6)]);
        let [k1, k2] = own_weights(sheet, reading, node_n, ct, i1)?;
        //# 24 k_cnt[cnt[i1],2] ← k1 + k_cnt[cnt[i1],2]
        k_cnt[(cnt[i1], 2)] = here.at_line(24).finite(k1 + k_cnt[(cnt[i1], 2)])?;
        //# 25 k_cnt[cnt[i1],3] ← elem[ct[i1],7]
        k_cnt[(cnt[i1], 3)] = T::from_number(elem[(ct[i1], 7)]);
        //# 26 k_cnt[cnt[i1],4] ← k2 + k_cnt[cnt[i1],4]
        k_cnt[(cnt[i1], 4)] = here.at_line(26).finite(k2 + k_cnt[(cnt[i1], 4)])?;
        //# 27 k_cnt[elem[ct[i1],6],1] ← cnt[i1]
        k_cnt[(elem[(ct[i1], 6)], 1)] = T::from_number(cnt[i1]);
        //# 28 k_cnt[elem[ct[i1],6],2] ← k1 + k_cnt[elem[ct[i1],6],2]
        k_cnt[(elem[(ct[i1], 6)], 2)] =
            here.at_line(28).finite(k1 + k_cnt[(elem[(ct[i1], 6)], 2)])?;
        //# 29 k_cnt[elem[ct[i1],7],1] ← cnt[i1]
        k_cnt[(elem[(ct[i1], 7)], 1)] = T::from_number(cnt[i1]);
        //# 30 k_cnt[elem[ct[i1],7],2] ← k2 + k_cnt[elem[ct[i1],7],2]
        k_cnt[(elem[(ct[i1], 7)], 2)] =
            here.at_line(30).finite(k2 + k_cnt[(elem[(ct[i1], 7)], 2)])?;
    }
    Ok(())
}

/// Computes k1 and k2, the weights of the two ends of the edge of row `i1` of `cnt`: lines 22 and 23.
///
/// # Errors
/// A zero x difference, or an overflow.
pub fn own_weights<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
    ct: &Column<usize>,
    i1: usize,
) -> Result<[T; 2], Failure> {
    let Worksheet { elem, cnt, .. } = sheet;
    let here = Line { i1, ct: ct[i1], ..Line::default() };
    // AMBIGUOUS R5: initial coordinates, as printed, or current ones.
    let node = weights_from(sheet, reading, node_n);
    //# 22 k1 ← 1 − (node[cnt[i1],2] − node[elem[ct[i1],6],2]) / (node[elem[ct[i1],7],2] − node[elem[ct[i1],6],2])
    let k1 = here.at_line(22).finite(
        T::one()
            - here.at_line(22).quotient(
                node[(cnt[i1], 2)] - node[(elem[(ct[i1], 6)], 2)],
                node[(elem[(ct[i1], 7)], 2)] - node[(elem[(ct[i1], 6)], 2)],
            )?,
    )?;
    //# 23 k2 ← 1 − (node[elem[ct[i1],7],2] − node[cnt[i1],2]) / (node[elem[ct[i1],7],2] − node[elem[ct[i1],6],2])
    let k2 = here.at_line(23).finite(
        T::one()
            - here.at_line(23).quotient(
                node[(elem[(ct[i1], 7)], 2)] - node[(cnt[i1], 2)],
                node[(elem[(ct[i1], 7)], 2)] - node[(elem[(ct[i1], 6)], 2)],
            )?,
    )?;
    Ok([k1, k2])
}

/// Returns the coordinates from which weights are computed: R5.
pub fn weights_from<'a, T: Scalar>(
    sheet: &'a Worksheet<T>,
    reading: &Reading,
    node_n: &'a Table<T>,
) -> &'a Table<T> {
    match reading.r5 {
        NodeTable::Node => &sheet.node,
        NodeTable::NodeN => node_n,
    }
}
