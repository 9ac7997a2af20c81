//! The Cholesky factor of a sparse matrix, L Lᵀ = P A Pᵀ, by the library faer.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, Par, Side};
use nalgebra::{DMatrix, DVector};
use numbers::ordering::{order, places};

use super::factors::of_columns_mut;
use super::symmetric::SparseSymmetric;

/// Returns whether a pivot is more than what rounding may leave of its diagonal entry `a`, even in a
/// matrix whose entries are of very different sizes.
pub(super) fn is_large(pivot: f64, a: f64) -> bool {
    /// The least part of `a`: half of its digits are left. By what rounding alone leaves (`is_lost`) contact
    /// states that little holds are searched on a matrix of few digits: a ring among the hard scenes is lost.
    const LEAST: f64 = 1e-8;
    pivot > LEAST * a
}

/// The operations for each entry of L, over faer's own limit of 40, beyond which it is made and applied
/// by supernodes, small dense blocks. Below that its entries one by one are quicker.
const BY_SUPERNODES: f64 = 1.6;

/// The factor L, and the order P of the equations.
pub(super) struct Cholesky {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
}

/// L, column by column or by supernodes.
enum Lower<'a> {
    Entries(SparseColMatRef<'a, usize, f64>),
    Blocks(SupernodalLltRef<'a, usize, f64>),
}

impl Cholesky {
    /// Factors a matrix in an order of small fill; None where a pivot is not positive.
    pub(super) fn new(matrix: &SparseSymmetric) -> Option<Self> {
        Self::factored(matrix, SymmetricOrdering::Amd)
    }

    /// Factors a matrix with some equations, in their order, behind all others; None where a pivot is not
    /// positive.
    pub(super) fn with_last(matrix: &SparseSymmetric, last: &[usize]) -> Option<Self> {
        let order = order_with_last(matrix, last);
        let place = places(&order);
        let order = PermRef::new_checked(&order, &place, order.len());
        Self::factored(matrix, SymmetricOrdering::Custom(order))
    }

    fn factored(matrix: &SparseSymmetric, order: SymmetricOrdering<usize>) -> Option<Self> {
        let side = Side::Lower;
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold(BY_SUPERNODES),
            ..CholeskySymbolicParams::default()
        };
        let symbolic = factorize_symbolic_cholesky(matrix.pattern(), side, order, params);
        let symbolic = symbolic.expect("a pattern fits in memory");
        let mut values = vec![0.0; symbolic.len_val()];
        // One thread: faster for plane problems, and faer's bits depend on the number of threads.
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::new(scratch);
        let a = SparseColMatRef::new(matrix.pattern(), matrix.values());
        let (regularization, stack) = (LltRegularization::default(), MemStack::new(&mut memory));
        let params = Default::default();
        // The one error is a pivot that is not positive.
        symbolic
            .factorize_numeric_llt(&mut values, a, side, regularization, Par::Seq, stack, params)
            .ok()?;
        Some(Cholesky { symbolic, values })
    }

    /// Returns the solutions x of A x = b for the columns b of a matrix.
    pub(super) fn solve(&self, mut b: DMatrix<f64>) -> DMatrix<f64> {
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(b.ncols(), Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            of_columns_mut(&mut b),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        b
    }

    /// Returns whether every pivot, the square of a diagonal entry of L, is more than rounding leaves of the
    /// matrix's `diagonal`.
    pub(super) fn has_large_pivots(&self, diagonal: &DVector<f64>) -> bool {
        let order = self.symbolic.perm().map(|order| order.arrays().0);
        let equation = |place: usize| order.map_or(place, |order| order[place]);
        let is_large = |place: usize, l: f64| is_large(l * l, diagonal[equation(place)]);
        match self.lower() {
            Lower::Entries(l) => (0..l.ncols()).all(|j| is_large(j, l.val_of_col(j)[0])),
            Lower::Blocks(l) => (0..l.symbolic().n_supernodes()).all(|s| {
                let (start, block) = (l.supernode(s).start(), l.supernode(s).val());
                (0..block.ncols()).all(|j| is_large(start + j, block[(j, j)]))
            }),
        }
    }

    /// Returns the lower triangle of L from the row and column `from` on.
    pub(super) fn last_block(&self, from: usize) -> DMatrix<f64> {
        let last = self.symbolic.nrows() - from;
        let mut block = DMatrix::zeros(last, last);
        match self.lower() {
            Lower::Entries(l) => {
                for j in from..l.ncols() {
                    let entries = l.row_idx_of_col(j).zip(l.val_of_col(j));
                    entries.for_each(|(i, l)| block[(i - from, j - from)] = *l);
                }
            }
            Lower::Blocks(l) => {
                let ends = l.symbolic().supernode_end();
                for s in ends.partition_point(|end| *end <= from)..l.symbolic().n_supernodes() {
                    let supernode = l.supernode(s);
                    let (start, values) = (supernode.start(), supernode.val());
                    let columns = values.ncols();
                    for j in from.saturating_sub(start)..columns {
                        let rows =
                            (start + j..start + columns).chain(supernode.pattern().iter().copied());
                        for (i, k) in rows.zip(j..) {
                            block[(i - from, start + j - from)] = values[(k, j)];
                        }
                    }
                }
            }
        }
        block
    }

    /// Returns L in the form in which it was made.
    fn lower(&self) -> Lower<'_> {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(symbolic) => {
                Lower::Entries(SparseColMatRef::new(symbolic.factor(), &self.values))
            }
            SymbolicCholeskyRaw::Supernodal(symbolic) => {
                Lower::Blocks(SupernodalLltRef::new(symbolic, &self.values))
            }
        }
    }
}

/// Returns the other equations in an order of small fill, then the `last` ones.
fn order_with_last(matrix: &SparseSymmetric, last: &[usize]) -> Vec<usize> {
    const LAST: usize = usize::MAX;
    let mut number = vec![0; matrix.size()];
    last.iter().for_each(|e| number[*e] = LAST);
    let first: Vec<usize> = (0..matrix.size()).filter(|e| number[*e] != LAST).collect();
    first.iter().enumerate().for_each(|(k, e)| number[*e] = k);
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for j in &first {
        rows.extend(matrix.column(*j).map(|(i, _)| number[i]).filter(|i| *i != LAST));
        starts.push(rows.len());
    }
    let n = first.len();
    let order = order(SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &rows));
    order.into_iter().map(|k| first[k]).chain(last.iter().copied()).collect()
}
