//! Factors of a sparse symmetric matrix: an order of its equations in which they fill little, by the
//! library faer, and the elimination tree, which tells where they have entries.
//!
//! Source: J. W. H. Liu, *The role of elimination trees in sparse factorization*, SIAM J. Matrix Anal.
//! Appl. 11(1), 1990.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// Returns the equations in an order of small fill (approximate minimum degree), from the lower triangle of the matrix.
pub(super) fn order(pattern: SymbolicSparseColMatRef<'_, usize>) -> Vec<usize> {
    let n = pattern.ncols();
    let (mut order, mut place) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, pattern.compute_nnz()));
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut place, pattern, amd::Control::default(), stack)
        .expect("the indices fit");
    order
}

/// Returns the place of each equation in an order.
pub(super) fn places(order: &[usize]) -> Vec<usize> {
    let mut places = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, equation)| places[*equation] = place);
    places
}

/// The elimination tree, as far as the rows done so far tell it.
pub(super) struct Tree {
    parent: Vec<usize>,
    seen_in: Vec<usize>,
}

const NONE: usize = usize::MAX;

impl Tree {
    /// Returns the tree of `n` rows, none of which is done.
    pub(super) fn new(n: usize) -> Self {
        Tree { parent: vec![NONE; n], seen_in: vec![NONE; n] }
    }

    /// Visits where row k of L has entries, from the places of its `entries` in A left of the diagonal;
    /// the rows are done in turn.
    pub(super) fn row(
        &mut self,
        k: usize,
        entries: impl Iterator<Item = usize>,
        mut visit: impl FnMut(usize),
    ) {
        self.seen_in[k] = k;
        for mut i in entries {
            while self.seen_in[i] != k {
                self.seen_in[i] = k;
                visit(i);
                if self.parent[i] == NONE {
                    self.parent[i] = k;
                }
                i = self.parent[i];
            }
        }
    }
}
