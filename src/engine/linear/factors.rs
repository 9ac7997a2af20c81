//! What the factorisations of a matrix share.

use faer::linalg::solvers::Solve;
use faer::{MatMut, MatRef};
use nalgebra::{DMatrix, DVector};

use numbers::scalar::Scalar;
use numbers::square::SparseSquare;

/// The factors of a square matrix A.
pub trait Factors: Sync {
    /// Returns the solution x of A x = `b`.
    fn solve(&self, b: &DVector<f64>) -> DVector<f64>;

    /// Returns the solutions x of A x = b for the columns b of a matrix.
    fn solve_all(&self, mut b: DMatrix<f64>) -> DMatrix<f64> {
        for mut column in b.column_iter_mut() {
            column.copy_from(&self.solve(&column.clone_owned()));
        }
        b
    }
}

/// A column whose pivot vanished: the matrix has no unique solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singular {
    /// The column, counted from 0.
    pub column: usize,
    /// The smallest pivot over the largest; what is below rounding is singular.
    pub pivot: f64,
}

pub fn solve(factors: &impl Solve<f64>, b: &DVector<f64>) -> DVector<f64> {
    let x = factors.solve(MatRef::from_column_major_slice(b.as_slice(), b.len(), 1));
    DVector::from_fn(b.len(), |i, _| x[(i, 0)])
}

/// A matrix as faer takes it.
pub fn of_columns<T>(matrix: &DMatrix<T>) -> MatRef<'_, T> {
    MatRef::from_column_major_slice(matrix.as_slice(), matrix.nrows(), matrix.ncols())
}

/// A matrix as faer changes it.
pub fn of_columns_mut<T>(matrix: &mut DMatrix<T>) -> MatMut<'_, T> {
    let (rows, columns) = matrix.shape();
    MatMut::from_column_major_slice_mut(matrix.as_mut_slice(), rows, columns)
}

/// Returns the largest |x|, NaN left out.
pub fn largest<T: Scalar>(numbers: &[T]) -> f64 {
    numbers.iter().map(|x| Scalar::abs(*x).to_f64()).fold(0.0, f64::max)
}

/// Returns |r| / (`norm` |x| + |b|) in the largest-entry norm, 0 where r is 0: Rigal and Gaches'
/// normwise backward error.
pub fn backward_error<T: Scalar>(
    residual: &DVector<T>,
    norm: f64,
    x: &DVector<T>,
    b: &DVector<T>,
) -> f64 {
    let [residual, x, b] = [residual, x, b].map(|numbers| largest(numbers.as_slice()));
    if residual == 0.0 { 0.0 } else { residual / (norm * x + b) }
}

/// Returns the relative residual |A x − b| / (|A| |x| + |b|) in the largest-entry norm of vectors, 0 when x
/// and b are 0.
pub fn residual(matrix: &SparseSquare, x: &DVector<f64>, b: &DVector<f64>) -> f64 {
    let (mut rest, mut row_sums) = (-b, DVector::<f64>::zeros(x.len()));
    for (i, j, a) in matrix.entries() {
        rest[i] += a * x[j];
        row_sums[i] += a.abs();
    }
    backward_error(&rest, largest(row_sums.as_slice()), x, b)
}
