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
use faer::{Conj, MatMut, Par, Side};
use nalgebra::{DMatrix, DVector};

use super::factors::Native;
use super::symmetric::SparseSymmetric;

/// Returns whether a pivot is more than what rounding may leave of its diagonal entry `a`, even in a
/// matrix whose entries are of very different sizes.
pub(super) fn is_large(pivot: f64, a: f64) -> bool {
    /// The least part of `a`.
    const LEAST: f64 = 1e-8;
    pivot > LEAST * a
}

/// The factor L, and the order P of the equations.
pub(super) struct Cholesky<T> {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<T>,
}

impl<T: Native> Cholesky<T> {
    /// Factors a matrix in an order of small fill; None where a pivot is not positive.
    pub(super) fn new(matrix: &SparseSymmetric<T>) -> Option<Self> {
        Self::factored(matrix, SymmetricOrdering::Amd, CholeskySymbolicParams::default())
    }

    /// Factors a matrix in an order of its own, by supernodes: `order` has the equation at each
    /// place, `place` the place of each equation. None where a pivot is not positive, and without
    /// equations.
    pub(super) fn ordered(
        matrix: &SparseSymmetric<T>,
        order: &[usize],
        place: &[usize],
    ) -> Option<Self> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        };
        let order = SymmetricOrdering::Custom(PermRef::new_checked(order, place, order.len()));
        let factor = Self::factored(matrix, order, params)?;
        matches!(factor.symbolic.raw(), SymbolicCholeskyRaw::Supernodal(_)).then_some(factor)
    }

    fn factored(
        matrix: &SparseSymmetric<T>,
        order: SymmetricOrdering<usize>,
        params: CholeskySymbolicParams,
    ) -> Option<Self> {
        let side = Side::Lower;
        let symbolic = factorize_symbolic_cholesky(matrix.pattern(), side, order, params).ok()?;
        let mut values = vec![T::from_f64(0.0); symbolic.len_val()];
        // One thread: faster for plane problems, and faer's bits depend on the number of threads.
        let scratch = symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, Default::default());
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
    pub(super) fn solve(&self, b: &DVector<T>) -> DVector<T> {
        let scratch = self.symbolic.solve_in_place_scratch::<T>(1, Par::Seq);
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
    pub(super) fn has_large_pivots(&self, diagonal: &DVector<T>) -> bool {
        let pivots = self.pivots().into_iter().zip(diagonal);
        pivots.into_iter().all(|(pivot, a)| is_large(pivot, a.to_f64()))
    }

    /// Returns the square of each diagonal entry of L, the pivots, by equation.
    fn pivots(&self) -> Vec<f64> {
        let mut pivots = vec![0.0; self.symbolic.nrows()];
        let order = self.symbolic.perm().map(|order| order.arrays().0);
        let mut keep = |place: usize, l: T| {
            pivots[order.map_or(place, |order| order[place])] = l.to_f64() * l.to_f64();
        };
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(symbolic) => {
                let starts = symbolic.col_ptr();
                (0..symbolic.ncols()).for_each(|j| keep(j, self.values[starts[j]]));
            }
            SymbolicCholeskyRaw::Supernodal(_) => {
                let factor = self.supernodal();
                for s in 0..factor.symbolic().n_supernodes() {
                    let (start, block) = (factor.supernode(s).start(), factor.supernode(s).val());
                    (0..block.ncols()).for_each(|j| keep(start + j, block[(j, j)]));
                }
            }
        }
        pivots
    }

    /// Solves L z = z in place; z is in the order of the factor, which is one by supernodes.
    pub(super) fn solve_lower(&self, z: &mut [T]) {
        self.triangular(z, |factor, z, stack| {
            factor.l_solve_with_conj(Conj::No, z, Par::Seq, stack);
        });
    }

    /// Solves Lᵀ x = x in place; x is in the order of the factor, which is one by supernodes.
    pub(super) fn solve_lower_transposed(&self, x: &mut [T]) {
        self.triangular(x, |factor, x, stack| {
            factor.l_transpose_solve_with_conj(Conj::No, x, Par::Seq, stack);
        });
    }

    fn triangular(
        &self,
        x: &mut [T],
        solve: impl Fn(&SupernodalLltRef<'_, usize, T>, MatMut<'_, T>, &mut MemStack),
    ) {
        let factor = self.supernodal();
        let scratch = factor.symbolic().solve_in_place_scratch::<T>(1, Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut memory);
        solve(&factor, column(x), stack);
    }

    /// Returns the block of L from the row and column `from` on; the factor is one by supernodes.
    pub(super) fn last_block(&self, from: usize) -> DMatrix<T> {
        let factor = self.supernodal();
        let size = factor.symbolic().nrows() - from;
        let mut last = DMatrix::from_element(size, size, T::from_f64(0.0));
        for s in 0..factor.symbolic().n_supernodes() {
            let supernode = factor.supernode(s);
            let (start, block) = (supernode.start(), supernode.val());
            let row = |i: usize| match i.checked_sub(block.ncols()) {
                None => start + i,
                Some(below) => supernode.pattern()[below],
            };
            for column in (0..block.ncols()).filter(|j| start + j >= from) {
                for i in column..block.nrows() {
                    last[(row(i) - from, start + column - from)] = block[(i, column)];
                }
            }
        }
        last
    }

    fn supernodal(&self) -> SupernodalLltRef<'_, usize, T> {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else {
            unreachable!("the factor was asked for by supernodes")
        };
        SupernodalLltRef::new(symbolic, &self.values)
    }
}

/// A vector as faer takes it.
fn column<T>(x: &mut [T]) -> MatMut<'_, T> {
    let n = x.len();
    MatMut::from_column_major_slice_mut(x, n, 1)
}
