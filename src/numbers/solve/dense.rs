//! Dense LU with partial pivoting and dense Cholesky, by the library faer, behind one narrow
//! interface.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::lu::partial_pivoting::solve::{solve_in_place, solve_in_place_scratch};
use faer::linalg::solvers::Llt;
use faer::perm::Perm;
use faer::{MatRef, Par, Side};
use nalgebra::{DMatrix, DVector};

use super::factors::{
    Factors, Lu, Singular, backward_error, column, largest, of_columns, of_columns_mut, solve,
};
use super::square::SparseSquare;

/// LU factors of a matrix, of which the entries that are not 0 are kept beside them.
pub struct DenseLu {
    matrix: SparseSquare,
    /// L, its diagonal of ones left out, and U.
    factors: DMatrix<f64>,
    rows: Perm<usize>,
}

impl DenseLu {
    /// Factors an n x n `matrix`, in its place.
    ///
    /// # Errors
    /// Names a pivot below 16 n · eps of its own column's largest entry, which counts as
    /// zero (rounding leaves some n · eps where the exact pivot is 0): column by column, so that a
    /// body of soft material beside one of hard material is not taken for singular.
    pub fn new(matrix: DMatrix<f64>) -> Result<Self, Singular> {
        let n = matrix.nrows();
        let (entries, mut factors) = (SparseSquare::from_dense(&matrix), matrix);
        let [mut order, mut back] = [0, 0].map(|at| vec![at; n]);
        // One thread: faer's bits depend on the number of threads.
        let (par, params) = (Par::Seq, Default::default());
        let mut memory = MemBuffer::new(lu_in_place_scratch::<usize, f64>(n, n, par, params));
        let (view, stack) = (of_columns_mut(&mut factors), MemStack::new(&mut memory));
        lu_in_place(view, &mut order, &mut back, par, stack, params);
        let singular = (0..n).find(|&j| {
            let sizes = entries.column(j).map(|(_, value)| value.abs());
            let largest = sizes.fold(0.0, f64::max);
            let pivot = factors[(j, j)];
            pivot.is_nan() || pivot.abs() <= 16.0 * n as f64 * f64::EPSILON * largest
        });
        match singular {
            Some(column) => Err(Singular { column, pivot: factors[(column, column)] }),
            None => {
                let rows = Perm::new_checked(order.into(), back.into(), n);
                Ok(DenseLu { matrix: entries, factors, rows })
            }
        }
    }
}

impl Factors for DenseLu {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let (mut x, par) = (b.clone(), Par::Seq);
        let factors = of_columns(&self.factors);
        let mut memory =
            MemBuffer::new(solve_in_place_scratch::<usize, f64>(self.matrix.size(), 1, par));
        let stack = MemStack::new(&mut memory);
        let rows = self.rows.as_ref();
        solve_in_place(factors, factors, rows, column(x.as_mut_slice()), par, stack);
        x
    }
}

impl Lu for DenseLu {
    fn residual(&self, x: &DVector<f64>, b: &DVector<f64>) -> f64 {
        let [mut product, mut row_sums] = [0, 1].map(|_| DVector::<f64>::zeros(x.len()));
        for (i, j, a) in self.matrix.entries() {
            product[i] += a * x[j];
            row_sums[i] += a.abs();
        }
        backward_error(&(product - b), largest(row_sums.as_slice()), x, b)
    }
}

/// Cholesky factors of a symmetric positive definite matrix.
pub struct DenseCholesky {
    factors: Llt<f64>,
}

impl DenseCholesky {
    /// Factors an n x n `matrix`, of which the lower triangle is read.
    ///
    /// # Errors
    /// Names a pivot that is not positive, or below 16 n · eps of its own diagonal entry.
    pub fn new(matrix: &DMatrix<f64>) -> Result<Self, Singular> {
        let n = matrix.nrows();
        faer::set_global_parallelism(Par::Seq);
        let factors =
            Llt::new(of_columns(matrix), Side::Lower).map_err(|_| not_positive(matrix))?;
        let diagonal = factors.L().diagonal().column_vector();
        let pivot = |j: usize| diagonal[j] * diagonal[j];
        let least = |j: usize| 16.0 * n as f64 * f64::EPSILON * matrix[(j, j)];
        match (0..n).find(|&j| pivot(j).is_nan() || pivot(j) <= least(j)) {
            Some(column) => Err(Singular { column, pivot: pivot(column) }),
            None => Ok(DenseCholesky { factors }),
        }
    }

    /// Returns the lower triangle L of the factors.
    pub(super) fn lower(&self) -> MatRef<'_, f64> {
        self.factors.L()
    }
}

impl Factors for DenseCholesky {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        solve(&self.factors, b)
    }
}

/// Returns the column where a matrix ceases to be positive definite. LU tells it, unless the matrix
/// is indefinite and no column is to blame.
fn not_positive(matrix: &DMatrix<f64>) -> Singular {
    let mut full = matrix.clone();
    full.fill_upper_triangle_with_lower_triangle();
    DenseLu::new(full).err().unwrap_or(Singular { column: 0, pivot: f64::NAN })
}
