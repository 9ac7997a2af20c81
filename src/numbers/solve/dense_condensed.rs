//! A dense symmetric matrix of which the first equations are eliminated, and what is left of it on
//! the last ones (the Schur complement).
//!
//! ```text
//!   A = | A_ff      |  first     A_ff = L Lᵀ     X = L⁻¹ A_lfᵀ     S = A_ll − Xᵀ X
//!       | A_lf A_ll |  last
//! ```

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, MatMut, Par};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::dense::DenseCholesky;
use super::factors::{column, of_columns};

/// The columns that are computed together, whatever the number of threads.
const STRIP: usize = 64;

/// The strips that are worth a thread.
const AT_ONCE: usize = 4;

/// A symmetric matrix condensed to its last equations.
pub struct DenseCondensed {
    first: DenseCholesky<f64>,
    /// X, a column for each of the last equations.
    across: DMatrix<f64>,
    /// The lower triangle of S.
    schur: DMatrix<f64>,
}

impl DenseCondensed {
    /// The number of last equations up to which no other thread is asked, and so nothing else begun on
    /// this one meanwhile.
    pub const ON_ONE_THREAD: usize = (2 * AT_ONCE - 1) * STRIP;

    /// Eliminates the first equations of a `matrix`, of which the lower triangle is read; None where
    /// theirs is not positive definite.
    pub fn new(matrix: &DMatrix<f64>, first: usize) -> Option<Self> {
        let last = matrix.nrows() - first;
        let factors = DenseCholesky::new(&matrix.view((0, 0), (first, first)).into_owned()).ok()?;
        let lower = factors.lower();
        let mut across = matrix.view((first, 0), (last, first)).transpose();
        let strips = across.as_mut_slice().par_chunks_mut((first * STRIP).max(1));
        strips.with_min_len(AT_ONCE).for_each(|strip| {
            let strip = MatMut::from_column_major_slice_mut(strip, first, strip.len() / first);
            solve_lower_triangular_in_place(lower, strip, Par::Seq);
        });
        let mut schur = matrix.view((first, first), (last, last)).into_owned();
        let x = of_columns(&across);
        let strips = schur.as_mut_slice().par_chunks_mut((last * STRIP).max(1)).enumerate();
        strips.with_min_len(AT_ONCE).for_each(|(k, strip)| {
            // Above its own columns nothing is read.
            let (start, width) = (k * STRIP, strip.len() / last);
            let strip = MatMut::from_column_major_slice_mut(strip, last, width);
            let rows = x.subcols(start, last - start).transpose();
            let strip = strip.subrows_mut(start, last - start);
            matmul(strip, Accum::Add, rows, x.subcols(start, width), -1.0, Par::Seq);
        });
        Some(DenseCondensed { first: factors, across, schur })
    }

    /// Returns the lower triangle of S.
    pub fn schur(&self) -> &DMatrix<f64> {
        &self.schur
    }

    /// Eliminates the first equations from a right-hand side: returns L⁻¹ of its first part, and what
    /// is left of the last one.
    pub fn eliminate(&self, first: DVector<f64>, last: DVector<f64>) -> [DVector<f64>; 2] {
        let mut z = first;
        solve_lower_triangular_in_place(self.first.lower(), column(z.as_mut_slice()), Par::Seq);
        let last = last - self.across.tr_mul(&z);
        [z, last]
    }

    /// Returns the solution of the first equations from that of the last ones.
    pub fn expand(&self, z: DVector<f64>, last: &DVector<f64>) -> DVector<f64> {
        let mut x = z - &self.across * last;
        let upper = self.first.lower().transpose();
        solve_upper_triangular_in_place(upper, column(x.as_mut_slice()), Par::Seq);
        x
    }

    /// Returns the factors of the first equations.
    pub fn first(&self) -> &DenseCholesky<f64> {
        &self.first
    }
}
