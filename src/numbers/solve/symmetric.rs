//! Sparse symmetric matrices.

use std::ops::AddAssign;

use faer::sparse::SymbolicSparseColMatRef;
use nalgebra::{DMatrix, DVector};

use super::factors::backward_error;
use crate::numbers::scalar::Scalar;

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
