//! What Cholesky factors of a sparse matrix will cost, from its pattern alone.

use super::ordering::{Tree, order, places};
use super::symmetric::Pattern;

/// The size of the factors of a sparse matrix, without its numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct FactorSize {
    /// The number of equations.
    pub equations: usize,
    /// The number of entries of the lower triangle of A that are not 0.
    pub entries: usize,
    /// The number of entries of the factors that are not 0 by the pattern.
    pub nonzeros: usize,
    /// The number of multiplications and additions of the factorisation.
    pub operations: f64,
}

impl FactorSize {
    /// Returns the size of dense LU of `n` equations: 2/3 n³ operations.
    pub fn dense_lu(n: usize) -> Self {
        FactorSize { operations: 2.0 * cube(n) / 3.0, ..FactorSize::full(n, n * n) }
    }

    /// Returns the size of sparse Cholesky of a matrix of `pattern`, in the order of `ordering`.
    pub fn sparse_cholesky(pattern: &Pattern) -> Self {
        let equations = pattern.size();
        let mut size =
            FactorSize { equations, entries: pattern.places().count(), ..FactorSize::default() };
        let mut last_first = order(pattern.view());
        last_first.reverse();
        for below in below(pattern, &last_first) {
            size.nonzeros += below + 1;
            // A square root, divisions, and the update of what lies to its right.
            size.operations += ((below + 1) as f64).powi(2);
        }
        size
    }

    /// Returns the size of sparse LU of a matrix with the pattern of these Cholesky factors, as long as
    /// no rows are exchanged.
    pub fn as_lu(self) -> Self {
        FactorSize { nonzeros: 2 * self.nonzeros, operations: 2.0 * self.operations, ..self }
    }

    fn full(n: usize, nonzeros: usize) -> Self {
        FactorSize { equations: n, entries: n * (n + 1) / 2, nonzeros, operations: 0.0 }
    }
}

fn cube(n: usize) -> f64 {
    (n as f64).powi(3)
}

/// Returns the number of entries below the diagonal in each column of L, for an order from the last
/// equation to the first.
fn below(pattern: &Pattern, last_first: &[usize]) -> Vec<usize> {
    let (n, places) = (last_first.len(), places(last_first));
    // Those that come before each, and to which it is joined.
    let before = Pattern::new(n, |visit| {
        for (i, j) in pattern.places().filter(|(i, j)| i != j) {
            visit(places[i].max(places[j]), places[i].min(places[j]));
        }
    });
    let (mut tree, mut below) = (Tree::new(n), vec![0; n]);
    for k in (0..n).rev() {
        tree.row(k, before.column(k), |i| below[i] += 1);
    }
    below
}
