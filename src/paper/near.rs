//! `c_cnt` with the boxes of its lines 5 to 7 in a tree: the same pairs, to the bit, without a look at
//! every edge for every contact node.
#![allow(non_snake_case, reason = "the paper's own names")]

use super::mathcad::array::{Table, rows};
use super::mirror::{Failure, Pairs, Reading, Worksheet, c_cnt_near};
use crate::numbers::scalar::Scalar;
use crate::problem::tree::Tree;

/// Finds the pairs of `c_cnt` in the current shape `node_n` (R x 4).
///
/// # Errors
/// The listing fails as printed.
pub fn c_cnt<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
) -> Result<Pairs<T>, Failure> {
    let boxes: Vec<_> = (1..=rows(&sheet.trg)).map(|i2| (i2, corners(sheet, node_n, i2))).collect();
    if boxes.iter().any(|(_, corners)| corners.as_flattened().iter().any(|x| !x.is_finite())) {
        // A box that overflows fails the listing where it meets it first.
        return super::mirror::c_cnt(sheet, reading, node_n);
    }
    let tree = Tree::new(boxes);
    c_cnt_near(sheet, reading, node_n, &|i1| {
        let p = [2, 3].map(|column| node_n[(sheet.cnt[i1], column)].to_f64());
        let mut found = Vec::new();
        tree.visit(&|bounds| (bounds.distance(p) == 0.0).then_some(0.0), &mut |i2| found.push(i2));
        found.sort_unstable();
        found
    })
}

/// Returns two corners of a box around that of row `i2` of `trg`: in numbers of more digits, with
/// room for their rounding.
fn corners<T: Scalar>(sheet: &Worksheet<T>, node_n: &Table<T>, i2: usize) -> [[f64; 2]; 2] {
    let Worksheet { elem, trg, c_tll, .. } = sheet;
    let at = |end: usize, column: usize| node_n[(elem[(trg[i2], end)], column)];
    let ends = [2, 3].map(|column| {
        let [a, b] = [at(6, column) - *c_tll, at(7, column) + *c_tll];
        let [low, high] = if a < b { [a, b] } else { [b, a] };
        [low.to_f64().next_down(), high.to_f64().next_up()]
    });
    [0, 1].map(|end| ends.map(|span| span[end]))
}
