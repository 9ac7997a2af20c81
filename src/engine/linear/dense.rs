//! Dense LU with partial pivoting, and Cholesky factors of what is left of a matrix, by the library faer.

use super::is_lost;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::lu::partial_pivoting::solve::{solve_in_place, solve_in_place_scratch};
use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::linalg::solvers::{Llt, Solve};
use faer::perm::Perm;
use faer::{Accum, MatMut, Par, Side};
use nalgebra::{DMatrix, DVector};

use super::cholesky::is_large;
use super::factors::{Factors, Singular, largest, of_columns, of_columns_mut, solve};

/// LU factors of a matrix.
pub struct DenseLu {
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
        let columns = matrix.column_iter().map(|column| largest(column.as_slice()));
        let (columns, mut factors) = (columns.collect::<Vec<f64>>(), matrix);
        let [mut order, mut back] = [0, 0].map(|at| vec![at; n]);
        // One thread: faer's bits depend on the number of threads.
        let (par, params) = (Par::Seq, Default::default());
        let mut memory = MemBuffer::new(lu_in_place_scratch::<usize, f64>(n, n, par, params));
        let (view, stack) = (of_columns_mut(&mut factors), MemStack::new(&mut memory));
        lu_in_place(view, &mut order, &mut back, par, stack, params);
        if let Some(column) = (0..n).find(|&j| is_lost(&factors[(j, j)], columns[j], n)) {
            return Err(Singular { column, pivot: factors[(column, column)] });
        }
        let rows = Perm::new_checked(order.into(), back.into(), n);
        Ok(DenseLu { factors, rows })
    }
}

impl Factors for DenseLu {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let (mut x, par) = (b.clone(), Par::Seq);
        let factors = of_columns(&self.factors);
        let n = x.len();
        let mut memory = MemBuffer::new(solve_in_place_scratch::<usize, f64>(n, 1, par));
        let stack = MemStack::new(&mut memory);
        let rows = self.rows.as_ref();
        let column = MatMut::from_column_major_slice_mut(x.as_mut_slice(), n, 1);
        solve_in_place(factors, factors, rows, column, par, stack);
        x
    }
}

/// Cholesky factors of a dense symmetric positive definite matrix.
pub struct DenseCholesky(Llt<f64>);

impl DenseCholesky {
    /// Factors a `matrix`, of which the lower triangle is read; None where it is not positive definite, or
    /// nearly not.
    pub fn new(matrix: &DMatrix<f64>) -> Option<Self> {
        faer::set_global_parallelism(Par::Seq);
        let factors = Llt::new(of_columns(matrix), Side::Lower).ok()?;
        let pivots = factors.L().diagonal().column_vector();
        let is_held = |j: usize| is_large(pivots[j] * pivots[j], matrix[(j, j)]);
        (0..matrix.nrows()).all(is_held).then_some(DenseCholesky(factors))
    }
}

impl Factors for DenseCholesky {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        solve(&self.0, b)
    }

    fn solve_all(&self, b: DMatrix<f64>) -> DMatrix<f64> {
        let x = self.0.solve(of_columns(&b));
        DMatrix::from_fn(b.nrows(), b.ncols(), |i, j| x[(i, j)])
    }
}

/// Returns L Lᵀ of a lower triangle L.
pub(super) fn square(l: &DMatrix<f64>) -> DMatrix<f64> {
    let mut square = DMatrix::zeros(l.nrows(), l.nrows());
    let view = of_columns(l);
    matmul(
        of_columns_mut(&mut square),
        BlockStructure::TriangularLower,
        Accum::Replace,
        view,
        BlockStructure::TriangularLower,
        view.transpose(),
        BlockStructure::TriangularUpper,
        1.0,
        Par::Seq,
    );
    square.fill_upper_triangle_with_lower_triangle();
    square
}
