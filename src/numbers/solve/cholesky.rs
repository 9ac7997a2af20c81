//! The Cholesky factor of a sparse matrix, L Lᵀ = P A Pᵀ, by the library faer.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::{Conj, Par, Side};
use nalgebra::DVector;

use super::factors::column;
use super::symmetric::SparseSymmetric;

/// Returns whether a pivot is more than what rounding may leave of its diagonal entry `a`, even in a
/// matrix whose entries are of very different sizes.
pub fn is_large(pivot: f64, a: f64) -> bool {
    /// The least part of `a`.
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

    /// Factors a matrix in an order of its own: `order` has the equation at each place, `place` the
    /// place of each equation. None where a pivot is not positive.
    pub(super) fn ordered(
        matrix: &SparseSymmetric,
        order: &[usize],
        place: &[usize],
    ) -> Option<Self> {
        let order = PermRef::new_checked(order, place, order.len());
        Self::factored(matrix, SymmetricOrdering::Custom(order))
    }

    fn factored(matrix: &SparseSymmetric, order: SymmetricOrdering<usize>) -> Option<Self> {
        let side = Side::Lower;
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold(BY_SUPERNODES),
            ..CholeskySymbolicParams::default()
        };
        let symbolic = factorize_symbolic_cholesky(matrix.pattern(), side, order, params).ok()?;
        let mut values = vec![0.0; symbolic.len_val()];
        // One thread: faster for plane problems, and faer's bits depend on the number of threads.
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::new(scratch);
        let a = SparseColMatRef::new(matrix.pattern(), matrix.values());
        let (regularization, stack) = (LltRegularization::default(), MemStack::new(&mut memory));
        let params = Default::default();
        symbolic
            .factorize_numeric_llt(&mut values, a, side, regularization, Par::Seq, stack, params)
            .ok()?;
        Some(Cholesky { symbolic, values })
    }

    /// Returns the solution x of A x = `b`.
    pub(super) fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        let mut x = b.clone();
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            column(x.as_mut_slice()),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        x
    }

    /// Returns whether every pivot is more than rounding leaves of the matrix's `diagonal`.
    pub(super) fn has_large_pivots(&self, diagonal: &DVector<f64>) -> bool {
        let pivots = self.pivots().into_iter().zip(diagonal);
        pivots.into_iter().all(|(pivot, a)| is_large(pivot, *a))
    }

    /// Returns the square of each diagonal entry of L, the pivots, by equation.
    fn pivots(&self) -> Vec<f64> {
        let mut pivots = vec![0.0; self.symbolic.nrows()];
        let order = self.symbolic.perm().map(|order| order.arrays().0);
        let mut keep = |place: usize, l: f64| {
            pivots[order.map_or(place, |order| order[place])] = l * l;
        };
        match self.lower() {
            Lower::Entries(l) => (0..l.ncols()).for_each(|j| keep(j, l.val_of_col(j)[0])),
            Lower::Blocks(l) => {
                for s in 0..l.symbolic().n_supernodes() {
                    let (start, block) = (l.supernode(s).start(), l.supernode(s).val());
                    (0..block.ncols()).for_each(|j| keep(start + j, block[(j, j)]));
                }
            }
        }
        pivots
    }

    /// Visits the entries of L from the row and column `from` on, columns in turn: row and column from
    /// there, value.
    pub(super) fn visit_last(&self, from: usize, mut visit: impl FnMut(usize, usize, f64)) {
        let mut visit = |i: usize, j: usize, l: &f64| visit(i - from, j - from, *l);
        match self.lower() {
            Lower::Entries(l) => {
                for j in from..l.ncols() {
                    l.row_idx_of_col(j).zip(l.val_of_col(j)).for_each(|(i, l)| visit(i, j, l));
                }
            }
            Lower::Blocks(l) => {
                let ends = l.symbolic().supernode_end();
                for s in ends.partition_point(|end| *end <= from)..l.symbolic().n_supernodes() {
                    let supernode = l.supernode(s);
                    let (start, block) = (supernode.start(), supernode.val());
                    for j in from.saturating_sub(start)..block.ncols() {
                        let rows = (start + j..start + block.ncols())
                            .chain(supernode.pattern().iter().copied());
                        let column = block.col(j).subrows(j, block.nrows() - j);
                        rows.zip(column.iter()).for_each(|(i, l)| visit(i, start + j, l));
                    }
                }
            }
        }
    }

    /// Solves L z = b for the first entries of z, up to `inside`, in place, and leaves in the others
    /// what those leave of b; in the order of the factor.
    pub(super) fn eliminate(&self, inside: usize, z: &mut [f64]) {
        match self.lower() {
            Lower::Entries(l) => {
                for j in 0..inside {
                    let (rows, column) = (l.row_idx_of_col_raw(j), l.val_of_col(j));
                    // Of a load on few equations most stay 0.
                    if z[j] == 0.0 {
                        continue;
                    }
                    z[j] /= column[0];
                    let x = z[j];
                    rows[1..].iter().zip(&column[1..]).for_each(|(i, l)| z[*i] -= *l * x);
                }
            }
            Lower::Blocks(l) => {
                with_scratch(&l, |stack| l.l_solve_with_conj(Conj::No, column(z), Par::Seq, stack));
                let last = taken(&mut z[inside..]);
                self.visit_last(inside, |i, j, l| z[inside + i] += l * last[j]);
            }
        }
    }

    /// Solves Lᵀ x = z for the first entries of x, up to `inside`, in place, where the others are those of
    /// x already; in the order of the factor.
    pub(super) fn substitute(&self, inside: usize, x: &mut [f64]) {
        match self.lower() {
            Lower::Entries(l) => {
                for j in (0..inside).rev() {
                    let (rows, column) = (l.row_idx_of_col_raw(j), l.val_of_col(j));
                    x[j] = (x[j] - product(&rows[1..], &column[1..], x)) / column[0];
                }
            }
            Lower::Blocks(l) => {
                let last = taken(&mut x[inside..]);
                self.visit_last(inside, |i, j, l| x[inside + j] += l * last[i]);
                with_scratch(&l, |stack| {
                    l.l_transpose_solve_with_conj(Conj::No, column(x), Par::Seq, stack);
                });
                // What was given is returned to the bit.
                x[inside..].copy_from_slice(&last);
            }
        }
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

/// Returns the sum of the products of the entries of a column with those of `x` in their `rows`, in four
/// parts, as no one of which waits for another.
fn product(rows: &[usize], column: &[f64], x: &[f64]) -> f64 {
    let (rows, column) = (rows.chunks_exact(4), column.chunks_exact(4));
    let last = rows.remainder().iter().zip(column.remainder());
    let last = last.fold(0.0, |sum, (i, l)| sum + *l * x[*i]);
    let mut sums = [0.0; 4];
    for (rows, column) in rows.zip(column) {
        (0..4).for_each(|k| sums[k] += column[k] * x[rows[k]]);
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + last
}

/// Takes the numbers of a slice, and leaves zeros.
fn taken(slice: &mut [f64]) -> Vec<f64> {
    let numbers = slice.to_vec();
    slice.fill(0.0);
    numbers
}

/// Solves with the memory that a factor by supernodes needs.
fn with_scratch(factor: &SupernodalLltRef<'_, usize, f64>, solve: impl FnOnce(&mut MemStack)) {
    let scratch = factor.symbolic().solve_in_place_scratch::<f64>(1, Par::Seq);
    solve(MemStack::new(&mut MemBuffer::new(scratch)));
}
