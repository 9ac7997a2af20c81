//! How many operations a search took: counted, not timed, so that the count is the same on every machine.

use std::cell::Cell;

/// Operations so far: additions, subtractions, multiplications, divisions, square roots and comparisons of lengths, one each.
#[derive(Debug, Default)]
pub struct Operations(Cell<u64>);

impl Operations {
    /// `orient2d` where its error bound decides, as it does but for nearly collinear points: 5 differences, 2 products, 2 signs,
    /// 1 sum, 1 product, 1 comparison.
    pub const ORIENTATION: u64 = 12;

    /// Adds `n` operations.
    pub fn add(&self, n: u64) {
        self.0.set(self.0.get() + n);
    }

    /// Their number.
    pub fn count(&self) -> u64 {
        self.0.get()
    }
}
