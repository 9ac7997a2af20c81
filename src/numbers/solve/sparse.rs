//! Sparse symmetric matrices, and Cholesky factors of those that are positive definite, by the
//! library faer.

use std::marker::PhantomData;
use std::ops::AddAssign;

use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
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
    /// Where each column starts, and where the last one ends.
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<T>,
}

impl<T: Copy> SparseSymmetric<T> {
    /// Sums `entries` (row, column, value) into an n x n matrix, in their order and without those
    /// above the diagonal. They are gone through twice.
    pub fn new(n: usize, entries: impl Iterator<Item = (usize, usize, T)> + Clone) -> Self
    where
        T: AddAssign,
    {
        let lower = entries.filter(|(i, j, _)| i >= j);
        let mut ends = vec![0; n + 1];
        lower.clone().for_each(|(_, j, _)| ends[j + 1] += 1);
        (0..n).for_each(|j| ends[j + 1] += ends[j]);
        let any = lower.clone().next();
        let mut by_column = any.map_or(Vec::new(), |(i, _, value)| vec![(i, value); ends[n]]);
        for (i, j, value) in lower {
            by_column[ends[j]] = (i, value);
            ends[j] += 1;
        }
        let mut matrix = SparseSymmetric { starts: vec![0], rows: Vec::new(), values: Vec::new() };
        let mut from = 0;
        for end in &ends[..n] {
            let column = &mut by_column[from..*end];
            column.sort_by_key(|(i, _)| *i);
            matrix.push(column);
            from = *end;
        }
        matrix
    }

    /// Adds a column of entries (row, value), rows ascending; those of one row are summed.
    fn push(&mut self, column: &[(usize, T)])
    where
        T: AddAssign,
    {
        let start = self.rows.len();
        for &(i, value) in column {
            match self.values.last_mut() {
                Some(sum) if self.rows.len() > start && self.rows.last() == Some(&i) => {
                    *sum += value
                }
                _ => {
                    self.rows.push(i);
                    self.values.push(value);
                }
            }
        }
        self.starts.push(self.rows.len());
    }
}

impl<T: Clone> SparseSymmetric<T> {
    /// Returns the number of rows, which is that of the columns.
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns the entries of the lower triangle: row, column, value.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, T)> {
        (0..self.size()).flat_map(move |j| self.column(j).map(move |(i, value)| (i, j, value)))
    }

    /// Returns the entries of a column of the lower triangle: row, value.
    pub(super) fn column(&self, j: usize) -> impl Iterator<Item = (usize, T)> {
        (self.starts[j]..self.starts[j + 1]).map(|at| (self.rows[at], self.values[at].clone()))
    }

    pub fn map<U>(&self, f: impl Fn(&T) -> U) -> SparseSymmetric<U> {
        self.try_map(|a| Some(f(a))).expect("every entry has a value")
    }

    /// Returns the matrix with `f` of each entry; None where it is None of any.
    pub(super) fn try_map<U>(&self, f: impl Fn(&T) -> Option<U>) -> Option<SparseSymmetric<U>> {
        let values = self.values.iter().map(f).collect::<Option<Vec<U>>>()?;
        Some(SparseSymmetric { starts: self.starts.clone(), rows: self.rows.clone(), values })
    }

    /// Returns the values of the entries, column by column.
    pub(super) fn values(&self) -> &[T] {
        &self.values
    }

    /// Returns the pattern as faer takes it.
    pub(super) fn pattern(&self) -> SymbolicSparseColMatRef<'_, usize> {
        let n = self.size();
        SymbolicSparseColMatRef::new_checked(n, n, &self.starts, None, &self.rows)
    }
}

impl<T: Scalar> SparseSymmetric<T> {
    /// Takes the lower triangle of a dense matrix, zeros left out.
    pub fn of_lower(matrix: &DMatrix<T>) -> Self {
        let n = matrix.nrows();
        let lower = (0..n).flat_map(|j| (j..n).map(move |i| (i, j, matrix[(i, j)])));
        SparseSymmetric::new(n, lower.filter(|(_, _, value)| !value.is_zero()))
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
        let of_column = |j: usize| {
            let first = self.starts[j];
            (first < self.starts[j + 1] && self.rows[first] == j).then(|| self.values[first])
        };
        DVector::from_fn(self.size(), |j, _| of_column(j).unwrap_or(T::zero()))
    }

    /// Returns the matrix with each diagonal entry made 1 + `part` times as large.
    pub fn with_diagonal(&self, part: f64) -> Self {
        self.map_diagonal(|_, a| a * T::from_f64(1.0 + part))
    }

    /// Returns the matrix with `f` of each row's diagonal entry.
    pub(super) fn map_diagonal(&self, f: impl Fn(usize, T) -> T) -> Self {
        let mut matrix = self.clone();
        for (at, (i, j, value)) in self.entries().enumerate() {
            if i == j {
                matrix.values[at] = f(i, value);
            }
        }
        matrix
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
        let Some(factors) = factor(&matrix) else {
            return Err(mechanism(&matrix));
        };
        let cholesky = SparseCholesky { matrix, factors };
        match probe(&cholesky.factors, &cholesky.matrix.diagonal()) {
            None => Ok(cholesky),
            Some((column, size)) => {
                match size.max(largest_motion(&cholesky, &cholesky.matrix.diagonal())) {
                    size if size.is_finite() && size < UNBOUNDED / T::EPSILON => Ok(cholesky),
                    size => Err(Singular { column, pivot: 1.0 / size }),
                }
            }
        }
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

/// Returns the largest motion under loads of 1, both scaled to a unit diagonal: what no single trial
/// load is sure to find.
pub fn largest_motion<T: Native>(factors: &impl Factors<T>, diagonal: &DVector<T>) -> f64 {
    let scale = diagonal.map(|d| d.to_f64().sqrt());
    let ones = DVector::from_element(scale.len(), 1.0);
    inverse_norm(&Scaled { factors, scale, scalar: PhantomData }, &ones)
}

/// The factors of A scaled to a unit diagonal.
struct Scaled<'a, T, F> {
    factors: &'a F,
    scale: DVector<f64>,
    scalar: PhantomData<T>,
}

impl<T: Native, F: Factors<T>> Factors<f64> for Scaled<'_, T, F> {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let load = b.component_mul(&self.scale).map(T::from_f64);
        self.factors.solve(&load).map(Scalar::to_f64).component_mul(&self.scale)
    }
}

/// Returns the Cholesky factors of A, or nothing where a pivot is not positive.
fn factor<T: Native>(matrix: &SparseSymmetric<T>) -> Option<Llt<usize, T>> {
    SparseColMatRef::new(matrix.pattern(), matrix.values()).sp_cholesky(Side::Lower).ok()
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
    let shifted = factor(&matrix.with_diagonal(SHIFT * T::EPSILON));
    let shifted = shifted.and_then(|factors| probe(&factors, &diagonal));
    let (column, size) = shifted.unwrap_or((0, f64::INFINITY));
    Singular { column, pivot: 1.0 / size }
}
