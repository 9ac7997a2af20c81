//! Sparse matrices that need not be symmetric, made entry by entry.

use std::ops::{Index, IndexMut};

use nalgebra::{DMatrix, DVector};

use crate::scalar::Scalar;

/// A square matrix, counted from 0: of each column the entries that were written, rows ascending.
#[derive(Clone, Debug)]
pub struct SparseSquare<T = f64> {
    columns: Vec<Vec<(usize, T)>>,
    /// What every other entry is.
    zero: T,
}

impl<T: Scalar> SparseSquare<T> {
    /// Makes the n x n matrix of zeros.
    pub fn zeros(n: usize) -> Self {
        SparseSquare { columns: vec![Vec::new(); n], zero: T::zero() }
    }

    /// Takes the entries of a dense matrix, zeros left out.
    pub fn from_dense(matrix: &DMatrix<T>) -> Self {
        let entries = |(i, value): (usize, &T)| (!value.is_zero()).then_some((i, *value));
        let column = |j| matrix.column(j).into_iter().enumerate().filter_map(entries).collect();
        SparseSquare { columns: (0..matrix.ncols()).map(column).collect(), zero: T::zero() }
    }

    /// Returns the number of rows, which is that of the columns.
    pub fn size(&self) -> usize {
        self.columns.len()
    }

    /// Returns the entries that are not 0, column by column, rows ascending: row, column, value.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, T)> + Clone {
        self.written().filter(|(_, _, value)| !value.is_zero())
    }

    /// Returns the entries that were written, zeros among them, in the same way.
    pub fn written(&self) -> impl Iterator<Item = (usize, usize, T)> + Clone {
        let columns = self.columns.iter().enumerate();
        columns.flat_map(|(j, column)| column.iter().map(move |(i, a)| (*i, j, *a)))
    }

    /// Returns the entries of a column that were written, rows ascending: row, value.
    pub fn column(&self, j: usize) -> impl Iterator<Item = &(usize, T)> {
        self.columns[j].iter()
    }

    /// Returns the entries of the difference from another matrix of the size that are not 0.
    pub fn differences<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = T> + 'a {
        let own = self.entries().map(|(i, j, value)| value - other[(i, j)]);
        let others = other.entries().filter(|(i, j, _)| self[(*i, *j)].is_zero());
        own.chain(others.map(|(_, _, value)| -value)).filter(|value| !value.is_zero())
    }

    /// Returns the diagonal.
    pub fn diagonal(&self) -> DVector<T> {
        DVector::from_fn(self.size(), |i, _| self[(i, i)])
    }

    /// Returns the same matrix with all its zeros.
    pub fn dense(&self) -> DMatrix<T> {
        DMatrix::from_fn(self.size(), self.size(), |i, j| self[(i, j)])
    }

    fn find(&self, (i, j): (usize, usize)) -> Result<usize, usize> {
        self.columns[j].binary_search_by_key(&i, |(row, _)| *row)
    }
}

impl<T: Scalar> Index<(usize, usize)> for SparseSquare<T> {
    type Output = T;
    fn index(&self, at: (usize, usize)) -> &T {
        self.find(at).map_or(&self.zero, |k| &self.columns[at.1][k].1)
    }
}

impl<T: Scalar> IndexMut<(usize, usize)> for SparseSquare<T> {
    fn index_mut(&mut self, at: (usize, usize)) -> &mut T {
        let k = self.find(at).unwrap_or_else(|k| {
            self.columns[at.1].insert(k, (at.0, self.zero));
            k
        });
        &mut self.columns[at.1][k].1
    }
}

impl SparseSquare {
    /// Returns the largest size of an entry.
    pub fn amax(&self) -> f64 {
        self.entries().fold(0.0, |most, (_, _, value)| most.max(value.abs()))
    }
}
