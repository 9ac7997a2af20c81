//! The elimination tree of a sparse symmetric matrix: where its factor has entries.
//!
//! Source: J. W. H. Liu, *The role of elimination trees in sparse factorization*, SIAM J. Matrix Anal.
//! Appl. 11(1), 1990.

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
