//! `c_cnt` on long surfaces, the same to the last bit: the boxes of its lines 5 to 7 stand in a tree, so
//! that a contact node is not compared with every edge.

use mathcad::array::{Column, Table, rows};
use numbers::scalar::Scalar;
use paper::mirror::{self, Failure, Pairs, Reading, Worksheet};
use problem::tree::{Bounds, Tree};

/// The boxes of the target edges in a shape.
pub struct Boxes<'a, T: Scalar> {
    sheet: &'a Worksheet<T>,
    node_n: &'a Table<T>,
    tree: Tree,
}

/// Finds the pairs of `c_cnt` in the current shape `node_n` (R x 4): line 4 goes through the rows of
/// `trg` near a contact node only.
///
/// # Errors
/// The listing fails as printed.
pub fn c_cnt<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
) -> Result<Pairs<T>, Failure> {
    // A box that overflows fails the listing where it meets it first.
    let Some(boxes) = Boxes::new(sheet, node_n) else {
        return mirror::c_cnt(sheet, reading, node_n);
    };
    let mut ct = Column::filled(rows(&sheet.cnt), 0);
    for i1 in 1..=rows(&sheet.cnt) {
        for i2 in boxes.containing(i1) {
            mirror::edge(sheet, node_n, i1, i2, &mut ct)?;
        }
    }
    mirror::on_edges(sheet, reading, node_n, ct)
}

impl<'a, T: Scalar> Boxes<'a, T> {
    /// Makes the boxes in the shape `node_n` (R x 4); None where one overflows.
    pub fn new(sheet: &'a Worksheet<T>, node_n: &'a Table<T>) -> Option<Self> {
        let of_row = |i2| (i2, corners(sheet, node_n, i2));
        let boxes: Vec<_> = (1..=rows(&sheet.trg)).map(of_row).collect();
        let is_finite = boxes.iter().flat_map(|b| b.1.as_flattened()).all(|x| x.is_finite());
        is_finite.then(|| Boxes { sheet, node_n, tree: Tree::new(boxes) })
    }

    /// Returns the rows of `trg`, ascending, whose boxes have contact node `i1`, among them all of
    /// which rounding leaves that open.
    pub fn containing(&self, i1: usize) -> Vec<usize> {
        let at = [2, 3].map(|column| self.node_n[(self.sheet.cnt[i1], column)]);
        let (p, reach) = (at.map(Scalar::to_f64), at.map(room)[0].max(at.map(room)[1]));
        let mut found = Vec::new();
        let key = |bounds: Bounds| (bounds.distance(p) <= reach).then_some(0.0);
        self.tree.visit(&key, &mut |i2| found.push(i2));
        found.sort_unstable();
        found
    }
}

/// Returns two corners of a box around that of row `i2` of `trg`: in numbers of more digits, or with
/// a bound on their error, with room for their rounding.
fn corners<T: Scalar>(sheet: &Worksheet<T>, node_n: &Table<T>, i2: usize) -> [[f64; 2]; 2] {
    let Worksheet { elem, trg, c_tll, .. } = sheet;
    let at = |end: usize, column: usize| node_n[(elem[(trg[i2], end)], column)];
    let ends = [2, 3].map(|column| {
        let [a, b] = [at(6, column) - *c_tll, at(7, column) + *c_tll];
        let (x, y, room) = (a.to_f64(), b.to_f64(), room(a).max(room(b)));
        let [low, high] = if x < y { [x, y] } else { [y, x] };
        [(low - room).next_down(), (high + room).next_up()]
    });
    [0, 1].map(|end| ends.map(|span| span[end]))
}

/// Returns the room that a number's error needs beside it where it is compared: more than its bound,
/// as a difference adds its own rounding to the bounds of both sides.
fn room<T: Scalar>(x: T) -> f64 {
    4.0 * x.error_bound().unwrap_or(0.0)
}
