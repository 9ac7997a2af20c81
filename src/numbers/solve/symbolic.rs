//! What Cholesky factors of a sparse matrix will cost, from its pattern alone: a symbolic
//! factorisation by the library faer, with the same ordering as that of `sparse`.

use faer::Side;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};

use super::symmetric::Pattern;

#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct FactorSize {
    pub equations: usize,
    /// The number of entries of the lower triangle of A that are not 0.
    pub entries: usize,
    /// The number of entries that the factors keep.
    pub nonzeros: usize,
    /// The number of multiplications and additions of the factorisation.
    pub operations: f64,
}

impl FactorSize {
    /// Returns the size of dense LU of `n` equations: 2/3 n³ operations.
    pub fn dense_lu(n: usize) -> Self {
        FactorSize { operations: 2.0 * cube(n) / 3.0, ..FactorSize::full(n, n * n) }
    }

    /// Returns the size of dense Cholesky of `n` equations: 1/3 n³ operations.
    pub fn dense_cholesky(n: usize) -> Self {
        FactorSize { operations: cube(n) / 3.0, ..FactorSize::full(n, n * n) }
    }

    /// Returns the size of sparse Cholesky of a matrix with this pattern.
    pub fn sparse_cholesky(pattern: &Pattern) -> Self {
        let pattern = pattern.view();
        let factors = factorize_symbolic_cholesky(
            pattern,
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .expect("a pattern that fits in memory");
        let columns = columns(factors.raw());
        FactorSize {
            equations: pattern.nrows(),
            entries: pattern.compute_nnz(),
            nonzeros: factors.len_val(),
            // Column by column: a square root, divisions, and the update of what lies to its right.
            operations: columns.map(|below| (below * below) as f64).sum(),
        }
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

/// Returns the number of entries of each column of L, the diagonal included.
fn columns(raw: &SymbolicCholeskyRaw<usize>) -> Box<dyn Iterator<Item = usize> + '_> {
    match raw {
        SymbolicCholeskyRaw::Simplicial(l) => Box::new(l.col_ptr().windows(2).map(|w| w[1] - w[0])),
        SymbolicCholeskyRaw::Supernodal(l) => Box::new((0..l.n_supernodes()).flat_map(|s| {
            let width = l.supernode_end()[s] - l.supernode_begin()[s];
            let below = l.supernode(s).pattern().len();
            (0..width).map(move |k| width - k + below)
        })),
    }
}
