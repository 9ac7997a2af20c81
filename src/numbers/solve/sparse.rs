//! Sparse symmetric matrices, and Cholesky factors of those that are positive definite, by the
//! library faer.

use std::collections::BTreeMap;
use std::ops::AddAssign;

use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Par, Side};
use nalgebra::{DMatrix, DVector};

use super::error_bound::inverse_norm;
use super::factors::{Factors, Native, Singular, backward_error, solve};
use crate::numbers::scalar::Scalar;

/// Beyond this over the scalar's epsilon (5e14 in f64), the displacements under a load of the size
/// of the stiffness mean a singular matrix; both are scaled to a unit diagonal.
const UNBOUNDED: f64 = 0.1;

/// What is added to a unit diagonal to see how a singular matrix moves, in units of the scalar's
/// epsilon (1e-10 in f64).
const SHIFT: f64 = 1e-10 / f64::EPSILON;

/// A symmetric matrix: the entries of its lower triangle, column by column, rows ascending.
#[derive(Clone, Debug)]
pub struct SparseSymmetric<T = f64> {
    columns: Vec<Vec<(usize, T)>>,
}

impl<T: Clone> SparseSymmetric<T> {
    /// Sums entries (row, column, value) into an n x n matrix, without those above the diagonal.
    pub fn new(n: usize, entries: impl Iterator<Item = (usize, usize, T)>) -> Self
    where
        T: AddAssign,
    {
        let mut columns: Vec<BTreeMap<usize, T>> = vec![BTreeMap::new(); n];
        for (i, j, value) in entries.filter(|(i, j, _)| i >= j) {
            match columns[j].get_mut(&i) {
                Some(sum) => *sum += value,
                None => drop(columns[j].insert(i, value)),
            }
        }
        SparseSymmetric { columns: columns.into_iter().map(|c| c.into_iter().collect()).collect() }
    }

    /// Makes an n x n matrix of entries (row, column, value) on and below the diagonal, none twice,
    /// rows ascending.
    pub(super) fn of_entries(n: usize, entries: impl Iterator<Item = (usize, usize, T)>) -> Self {
        let mut columns = vec![Vec::new(); n];
        entries.for_each(|(i, j, value)| columns[j].push((i, value)));
        SparseSymmetric { columns }
    }

    /// Returns the number of rows, which is that of the columns.
    pub fn size(&self) -> usize {
        self.columns.len()
    }

    /// Returns the entries of the lower triangle: row, column, value.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, T)> {
        let columns = self.columns.iter().enumerate();
        columns.flat_map(|(j, column)| column.iter().map(move |(i, value)| (*i, j, value.clone())))
    }

    pub fn map<U>(&self, f: impl Fn(&T) -> U) -> SparseSymmetric<U> {
        let mapped = |column: &Vec<(usize, T)>| column.iter().map(|(i, a)| (*i, f(a))).collect();
        SparseSymmetric { columns: self.columns.iter().map(mapped).collect() }
    }
}

impl<T: Scalar> SparseSymmetric<T> {
    /// Takes the lower triangle of a dense matrix, zeros left out.
    pub fn of_lower(matrix: &DMatrix<T>) -> Self {
        let column = |j: usize| {
            let below = (j..matrix.nrows()).map(|i| (i, matrix[(i, j)]));
            below.filter(|(_, value)| !value.is_zero()).collect()
        };
        SparseSymmetric { columns: (0..matrix.ncols()).map(column).collect() }
    }

    /// Returns the entries of the whole matrix: row, column, value.
    pub fn both_triangles(&self) -> impl Iterator<Item = (usize, usize, T)> {
        self.entries().flat_map(|(i, j, value)| {
            let mirrored = (i != j).then_some((j, i, value));
            std::iter::once((i, j, value)).chain(mirrored)
        })
    }

    pub fn times(&self, x: &DVector<T>) -> DVector<T> {
        let mut product = DVector::from_element(x.len(), T::zero());
        for (i, j, value) in self.entries() {
            product[i] += value * x[j];
            if i != j {
                product[j] += value * x[i];
            }
        }
        product
    }

    pub fn diagonal(&self) -> DVector<T> {
        let of_column = |j: usize| self.columns[j].first().filter(|(i, _)| *i == j);
        DVector::from_fn(self.size(), |j, _| of_column(j).map_or(T::zero(), |(_, value)| *value))
    }

    /// Returns the largest row sum of |A|.
    pub fn norm(&self) -> f64 {
        let mut sums = vec![0.0_f64; self.size()];
        for (i, j, value) in self.entries() {
            let size = Scalar::abs(value).to_f64();
            sums[i] += size;
            if i != j {
                sums[j] += size;
            }
        }
        sums.into_iter().fold(0.0, f64::max)
    }

    /// Returns the relative residual |A x − b| / (|A| |x| + |b|) in the largest-entry norm of
    /// vectors, 0 when x and b are 0.
    pub fn residual(&self, x: &DVector<T>, b: &DVector<T>) -> f64 {
        backward_error(&(self.times(x) - b), self.norm(), x, b)
    }
}

/// A symmetric positive definite matrix and its Cholesky factors.
pub struct SparseCholesky<T: Native = f64> {
    matrix: SparseSymmetric<T>,
    factors: Llt<usize, T>,
}

impl<T: Native> SparseCholesky<T> {
    /// Factors a `matrix` that must be positive definite.
    /// Errors: names an equation that a trial load, scaled by the diagonal, moves without bound:
    /// the matrix is singular or nearly so.
    pub fn new(matrix: SparseSymmetric<T>) -> Result<Self, Singular> {
        // One thread: faster for plane problems, and faer's bits depend on the number of threads.
        faer::set_global_parallelism(Par::Seq);
        let Some(factors) = factor(&matrix, 0.0) else {
            return Err(mechanism(&matrix));
        };
        let cholesky = SparseCholesky { matrix, factors };
        match probe(&cholesky.factors, &cholesky.matrix.diagonal()) {
            None => Ok(cholesky),
            Some((column, size)) => match size.max(cholesky.largest_motion()) {
                size if size.is_finite() && size < UNBOUNDED / T::EPSILON => Ok(cholesky),
                size => Err(Singular { column, pivot: 1.0 / size }),
            },
        }
    }

    /// Returns the largest motion under loads of 1, both scaled to a unit diagonal: what no single
    /// trial load is sure to find.
    fn largest_motion(&self) -> f64 {
        let scale = self.matrix.diagonal().map(|d| d.to_f64().sqrt());
        let ones = DVector::from_element(scale.len(), 1.0);
        inverse_norm(&Scaled { factors: &self.factors, scale }, &ones)
    }

    /// Returns the solution x of A x = `b`.
    pub fn solve(&self, b: &DVector<T>) -> DVector<T> {
        solve(&self.factors, b)
    }

    /// Returns the relative residual |A x − b| / (|A| |x| + |b|) in the largest-entry norm of
    /// vectors, 0 when x and b are 0.
    pub fn residual(&self, x: &DVector<T>, b: &DVector<T>) -> f64 {
        self.matrix.residual(x, b)
    }
}

impl<T: Native> Factors<T> for SparseCholesky<T> {
    fn solve(&self, b: &DVector<T>) -> DVector<T> {
        SparseCholesky::solve(self, b)
    }
}

/// The factors of A scaled to a unit diagonal.
struct Scaled<'a, T: Native> {
    factors: &'a Llt<usize, T>,
    scale: DVector<f64>,
}

impl<T: Native> Factors<f64> for Scaled<'_, T> {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let load = b.component_mul(&self.scale).map(T::from_f64);
        solve(self.factors, &load).map(Scalar::to_f64).component_mul(&self.scale)
    }
}

/// Returns the Cholesky factors of A with each diagonal entry made 1 + `shift` times as large, or
/// nothing where a pivot is not positive.
fn factor<T: Native>(matrix: &SparseSymmetric<T>, shift: f64) -> Option<Llt<usize, T>> {
    let factor = T::from_f64(1.0 + shift);
    let entries: Vec<Triplet<usize, usize, T>> = matrix
        .entries()
        .map(|(i, j, value)| Triplet::new(i, j, if i == j { value * factor } else { value }))
        .collect();
    let n = matrix.size();
    let lower = SparseColMat::try_new_from_triplets(n, n, &entries)
        .expect("rows and columns are within the matrix");
    lower.sp_cholesky(Side::Lower).ok()
}

/// Returns the equation that moves most under a trial load, and how far, both scaled to a unit
/// diagonal; nothing without equations.
fn probe<T: Native>(factors: &Llt<usize, T>, diagonal: &DVector<T>) -> Option<(usize, f64)> {
    let scale = diagonal.map(|d| d.to_f64().sqrt());
    // Signs without a pattern that a motion of the body could be orthogonal to.
    let sign = |i: usize| if (i * i + i / 3) % 5 < 2 { 1.0 } else { -1.0 };
    let load = DVector::from_fn(scale.len(), |i, _| T::from_f64(sign(i) * scale[i]));
    let moved = solve(factors, &load).map(Scalar::to_f64).component_mul(&scale);
    let largest = moved.iter().map(|x| x.abs()).enumerate();
    largest.reduce(|a, b| if b.1 > a.1 || b.1.is_nan() { b } else { a })
}

/// Returns the equation that a singular matrix leaves free to move.
fn mechanism<T: Native>(matrix: &SparseSymmetric<T>) -> Singular {
    let diagonal = matrix.diagonal();
    if let Some(column) = diagonal.iter().position(|d| d.to_f64().is_nan() || d.to_f64() <= 0.0) {
        return Singular { column, pivot: diagonal[column].to_f64() };
    }
    let shifted = factor(matrix, SHIFT * T::EPSILON).and_then(|factors| probe(&factors, &diagonal));
    let (column, size) = shifted.unwrap_or((0, f64::INFINITY));
    Singular { column, pivot: 1.0 / size }
}
