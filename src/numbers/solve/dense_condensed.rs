//! A dense symmetric matrix of which the first equations are eliminated, and what is left of it on
//! the last ones (the Schur complement).
//!
//! ```text
//!   A = | A_ff      |  first     A_ff = L Lᵀ     X = L⁻¹ A_lfᵀ     S = A_ll − Xᵀ X
//!       | A_lf A_ll |  last
//! ```

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, Par};
use nalgebra::{DMatrix, DVector};

use super::dense::DenseCholesky;
use super::factors::{column, of_columns, of_columns_mut};

/// A symmetric matrix condensed to its last equations.
pub struct DenseCondensed {
    first: DenseCholesky,
    /// X, a column for each of the last equations.
    across: DMatrix<f64>,
    /// The lower triangle of S.
    schur: DMatrix<f64>,
}

impl DenseCondensed {
    /// Eliminates the first equations of a `matrix`, of which the lower triangle is read; None where
    /// theirs is not positive definite.
    pub fn new(matrix: &DMatrix<f64>, first: usize) -> Option<Self> {
        let last = matrix.nrows() - first;
        let factors = DenseCholesky::new(&matrix.view((0, 0), (first, first)).into_owned()).ok()?;
        let lower = factors.lower();
        let mut across = matrix.view((first, 0), (last, first)).transpose();
        solve_lower_triangular_in_place(lower, of_columns_mut(&mut across), Par::Seq);
        let mut schur = matrix.view((first, first), (last, last)).into_owned();
        let x = of_columns(&across);
        matmul(
            of_columns_mut(&mut schur),
            BlockStructure::TriangularLower,
            Accum::Add,
            x.transpose(),
            BlockStructure::Rectangular,
            x,
            BlockStructure::Rectangular,
            -1.0,
            Par::Seq,
        );
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
    pub fn first(&self) -> &DenseCholesky {
        &self.first
    }
}
