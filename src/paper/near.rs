//! The listings on large scenes, the same to the bit: `c_cnt` with the boxes of its lines 5 to 7 in a
//! tree, without a look at every edge for every contact node, and `Km` without the zeros of `MJS`, and
//! anew only where mates are.
#![allow(non_snake_case, reason = "the paper's own names")]

use std::ops::{Index, IndexMut};

use super::mathcad::array::{Table, rows};
use super::mirror::{Failure, Km_of, Pairs, Reading, Worksheet, c_cnt_near};
use crate::numbers::scalar::Scalar;
use crate::numbers::solve::SparseSquare;
use crate::problem::tree::{Bounds, Tree};

/// The boxes of the target edges in a shape.
pub(super) struct Boxes<'a, T: Scalar> {
    sheet: &'a Worksheet<T>,
    node_n: &'a Table<T>,
    tree: Tree,
}

/// Finds the pairs of `c_cnt` in the current shape `node_n` (R x 4).
///
/// # Errors
/// The listing fails as printed.
pub fn c_cnt<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
    node_n: &Table<T>,
) -> Result<Pairs<T>, Failure> {
    match Boxes::new(sheet, node_n) {
        Some(boxes) => c_cnt_near(sheet, reading, node_n, &|i1| boxes.near(i1)),
        // A box that overflows fails the listing where it meets it first.
        None => super::mirror::c_cnt(sheet, reading, node_n),
    }
}

/// A matrix that counts from 1.
struct FromOne<T>(SparseSquare<T>);

/// `Km` of a worksheet, for one table of mates after the other.
pub struct Assembler<'a, T> {
    sheet: &'a Worksheet<T>,
    reading: &'a Reading,
    /// `MJS` without mates; None where an entry of it overflows.
    apart: Option<SparseSquare<T>>,
}

impl<'a, T: Scalar> Assembler<'a, T> {
    /// Assembles what no mates change.
    pub fn new(sheet: &'a Worksheet<T>, reading: &'a Reading) -> Self {
        let mut assembler = Assembler { sheet, reading, apart: None };
        let none = Table::filled(sheet.R(), 4, T::zero());
        assembler.apart = assembler.of(1..=sheet.M(), &none).ok();
        assembler
    }

    /// Assembles `MJS` (2R x 2R, force/length) from the contact pairs `k_cnt` (R x 4).
    ///
    /// # Errors
    /// Those of the listing's [`Km`](super::mirror::Km).
    pub fn Km(&self, k_cnt: &Table<T>) -> Result<SparseSquare<T>, Failure> {
        // What fails is the first element that does, of all of them.
        self.mated(k_cnt).map_or_else(|| self.of(1..=self.sheet.M(), k_cnt), Ok)
    }

    /// Returns `MJS` without mates but for the entries between mates, to which alone lines 23 and 33 add:
    /// those are assembled anew, of all elements at a mate or at the node of one. None where an element
    /// fails.
    fn mated(&self, k_cnt: &Table<T>) -> Option<SparseSquare<T>> {
        let Worksheet { EL, ind_1, .. } = self.sheet;
        let mut matrix = self.apart.clone()?;
        let mut is_mate = vec![false; self.sheet.R() + 1];
        let mut is_near = is_mate.clone();
        for node in 1..=self.sheet.R() {
            let mates = [1, 3].map(|column| k_cnt[(node, column)]);
            for mate in mates.into_iter().filter(|mate| *mate > T::zero()) {
                (is_mate[mate.at()], is_near[mate.at()], is_near[node]) = (true, true, true);
            }
        }
        let at = |n: usize| (0..3).map(move |i| EL[(n, ind_1 + i)]);
        let near = (1..=self.sheet.M()).filter(|n| at(*n).any(|node| is_near[node]));
        let anew = self.of(near, k_cnt).ok()?;
        let joins = |(i, j): (usize, usize)| is_mate[i / 2 + 1] && is_mate[j / 2 + 1];
        anew.written().filter(|(i, j, _)| joins((*i, *j))).for_each(|(i, j, x)| matrix[(i, j)] = x);
        Some(matrix)
    }

    fn of(
        &self,
        elements: impl IntoIterator<Item = usize>,
        k_cnt: &Table<T>,
    ) -> Result<SparseSquare<T>, Failure> {
        let MJS = FromOne(SparseSquare::zeros(2 * self.sheet.R()));
        Ok(Km_of(elements, self.sheet, self.reading, k_cnt, MJS)?.0)
    }
}

impl<T: Scalar> Index<(usize, usize)> for FromOne<T> {
    type Output = T;
    fn index(&self, (i, j): (usize, usize)) -> &T {
        &self.0[(i - 1, j - 1)]
    }
}

impl<T: Scalar> IndexMut<(usize, usize)> for FromOne<T> {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut T {
        &mut self.0[(i - 1, j - 1)]
    }
}

impl<'a, T: Scalar> Boxes<'a, T> {
    /// Makes the boxes in the shape `node_n` (R x 4); None where one overflows.
    pub(super) fn new(sheet: &'a Worksheet<T>, node_n: &'a Table<T>) -> Option<Self> {
        let of_row = |i2| (i2, corners(sheet, node_n, i2));
        let boxes: Vec<_> = (1..=rows(&sheet.trg)).map(of_row).collect();
        let is_finite = boxes.iter().flat_map(|b| b.1.as_flattened()).all(|x| x.is_finite());
        is_finite.then(|| Boxes { sheet, node_n, tree: Tree::new(boxes) })
    }

    /// Returns the rows of `trg`, ascending, whose boxes have contact node `i1`, among them all of
    /// which rounding leaves that open.
    pub(super) fn near(&self, i1: usize) -> Vec<usize> {
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
