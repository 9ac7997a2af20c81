//! Dense LU with partial pivoting and dense Cholesky, by the library faer, behind one narrow
//! interface.

use faer::linalg::solvers::{Llt, PartialPivLu};
use faer::{MatRef, Par, Side};
use nalgebra::{DMatrix, DVector};

use super::factors::{Factors, Lu, Native, Singular, backward_error, largest, solve};
use crate::numbers::scalar::Scalar;

pub struct DenseLu<T: Native = f64> {
    matrix: DMatrix<T>,
    factors: PartialPivLu<T>,
}

impl<T: Native> DenseLu<T> {
    /// Factors an n x n `matrix`.
    /// Errors: names a pivot below 16 n · eps of its own column's largest entry, which counts as
    /// zero (rounding leaves some n · eps where the exact pivot is 0): column by column, so that a
    /// body of soft material beside one of hard material is not taken for singular.
    pub fn new(matrix: DMatrix<T>) -> Result<Self, Singular> {
        let n = matrix.nrows();
        // One thread: faer's bits depend on the number of threads.
        faer::set_global_parallelism(Par::Seq);
        let view = MatRef::from_column_major_slice(matrix.as_slice(), n, n);
        let factors = PartialPivLu::new(view);
        let pivots = factors.U().diagonal().column_vector();
        let singular = (0..n).find(|&j| {
            let largest = largest(matrix.column(j).iter());
            let pivot = pivots[j].to_f64();
            pivot.is_nan() || pivot.abs() <= 16.0 * n as f64 * T::EPSILON * largest
        });
        match singular {
            Some(column) => Err(Singular { column, pivot: pivots[column].to_f64() }),
            None => Ok(DenseLu { matrix, factors }),
        }
    }
}

impl<T: Native> Factors<T> for DenseLu<T> {
    fn solve(&self, b: &DVector<T>) -> DVector<T> {
        solve(&self.factors, b)
    }
}

impl<T: Native> Lu<T> for DenseLu<T> {
    fn residual(&self, x: &DVector<T>, b: &DVector<T>) -> f64 {
        // The row sums of |A|, gathered column by column as the matrix lies in memory.
        let mut row_sums = DVector::<T>::zeros(x.len());
        for column in self.matrix.column_iter() {
            row_sums.zip_apply(&column, |sum, a| *sum += Scalar::abs(a));
        }
        backward_error(&(&self.matrix * x - b), largest(row_sums.iter()), x, b)
    }
}

/// Cholesky factors of a symmetric positive definite matrix.
pub struct DenseCholesky<T: Native> {
    factors: Llt<T>,
}

impl<T: Native> DenseCholesky<T> {
    /// Factors an n x n `matrix`, of which the lower triangle is read.
    /// Errors: names a pivot that is not positive, or below 16 n · eps of its own diagonal entry.
    pub fn new(matrix: &DMatrix<T>) -> Result<Self, Singular> {
        let n = matrix.nrows();
        faer::set_global_parallelism(Par::Seq);
        let view = MatRef::from_column_major_slice(matrix.as_slice(), n, n);
        let factors = Llt::new(view, Side::Lower).map_err(|_| not_positive(matrix))?;
        let diagonal = factors.L().diagonal().column_vector();
        let pivot = |j: usize| diagonal[j].to_f64() * diagonal[j].to_f64();
        let least = |j: usize| 16.0 * n as f64 * T::EPSILON * matrix[(j, j)].to_f64();
        match (0..n).find(|&j| pivot(j).is_nan() || pivot(j) <= least(j)) {
            Some(column) => Err(Singular { column, pivot: pivot(column) }),
            None => Ok(DenseCholesky { factors }),
        }
    }

    /// Returns the lower triangle L of the factors.
    pub(super) fn lower(&self) -> MatRef<'_, T> {
        self.factors.L()
    }
}

impl<T: Native> Factors<T> for DenseCholesky<T> {
    fn solve(&self, b: &DVector<T>) -> DVector<T> {
        solve(&self.factors, b)
    }
}

/// Returns the column where a matrix ceases to be positive definite. LU tells it, unless the matrix
/// is indefinite and no column is to blame.
fn not_positive<T: Native>(matrix: &DMatrix<T>) -> Singular {
    let mut full = matrix.clone();
    full.fill_upper_triangle_with_lower_triangle();
    DenseLu::new(full).err().unwrap_or(Singular { column: 0, pivot: f64::NAN })
}
