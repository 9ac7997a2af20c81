//! Dense LU with partial pivoting, by the library faer, behind one narrow interface.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{MatRef, Par};
use nalgebra::{DMatrix, DVector};

/// A square matrix and its LU factors.
pub struct DenseLu {
    matrix: DMatrix<f64>,
    factors: PartialPivLu<f64>,
}

/// A column whose pivot vanished: the matrix has no unique solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singular {
    /// The column, from 0.
    pub column: usize,
    /// Its pivot.
    pub pivot: f64,
}

impl DenseLu {
    /// Factors `matrix`.
    ///
    /// # Errors
    /// A pivot below 16 n · eps of its own column's largest entry counts as zero (rounding leaves some n · eps where the exact
    /// pivot is 0): column by column, so that a body of soft material beside one of hard material is not taken for singular.
    pub fn new(matrix: DMatrix<f64>) -> Result<Self, Singular> {
        let n = matrix.nrows();
        // One thread: faer's bits depend on the number of threads.
        faer::set_global_parallelism(Par::Seq);
        let view = MatRef::from_column_major_slice(matrix.as_slice(), n, n);
        let factors = PartialPivLu::new(view);
        let pivots = factors.U().diagonal().column_vector();
        let singular = (0..n).find(|&j| {
            let largest = matrix.column(j).amax();
            pivots[j].is_nan() || pivots[j].abs() <= 16.0 * n as f64 * f64::EPSILON * largest
        });
        match singular {
            Some(column) => Err(Singular { column, pivot: pivots[column] }),
            None => Ok(DenseLu { matrix, factors }),
        }
    }

    /// The solution x of A x = `b`.
    pub fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let rhs = MatRef::from_column_major_slice(b.as_slice(), b.len(), 1);
        let x = self.factors.solve(rhs);
        DVector::from_fn(b.len(), |i, _| x[(i, 0)])
    }

    /// Relative residual |A x − b| / (|A| |x| + |b|) in the largest-entry norm of vectors (Rigal and Gaches' normwise
    /// backward error); 0 when x and b are 0.
    pub fn residual(&self, x: &DVector<f64>, b: &DVector<f64>) -> f64 {
        let residual = (&self.matrix * x - b).amax();
        // The largest row sum, gathered column by column as the matrix lies in memory.
        let mut row_sums = DVector::<f64>::zeros(x.len());
        for column in self.matrix.column_iter() {
            row_sums.zip_apply(&column, |sum, a| *sum += a.abs());
        }
        let norm = row_sums.amax();
        let scale = norm * x.amax() + b.amax();
        if residual == 0.0 { 0.0 } else { residual / scale }
    }
}
