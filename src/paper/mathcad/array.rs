//! Mathcad's arrays with `ORIGIN = 1`: a thin type over nalgebra.

use std::ops::{Index, IndexMut};

use nalgebra::{DMatrix, DVector};

use crate::numbers::scalar::{Scalar, Subscript};

/// A matrix whose rows and columns count from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Table<T>(DMatrix<T>);

/// A column vector whose entries count from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Column<T>(DVector<T>);

impl<T: nalgebra::Scalar> Table<T> {
    /// A `rows` x `cols` table filled with `value`.
    pub fn filled(rows: usize, cols: usize, value: T) -> Self {
        Table(DMatrix::from_element(rows, cols, value))
    }

    /// The table whose entry `[i, j]`, from 1, is `entry(i, j)`.
    pub fn from_fn(rows: usize, cols: usize, mut entry: impl FnMut(usize, usize) -> T) -> Self {
        Table(DMatrix::from_fn(rows, cols, |i, j| entry(i + 1, j + 1)))
    }

    /// Number of rows, the last row's subscript.
    pub fn rows(&self) -> usize {
        self.0.nrows()
    }

    /// Number of columns, the last column's subscript.
    pub fn cols(&self) -> usize {
        self.0.ncols()
    }

    /// The entries of row `i`.
    pub fn row(&self, i: usize) -> impl Iterator<Item = &T> {
        (0..self.cols()).map(move |j| &self.0[(i - 1, j)])
    }

    /// The entry at `[i, j]`, or nothing outside the table.
    pub fn get(&self, i: usize, j: usize) -> Option<&T> {
        self.0.get((i.checked_sub(1)?, j.checked_sub(1)?))
    }

    /// The same table with every entry mapped.
    pub fn map<U: nalgebra::Scalar>(&self, f: impl FnMut(T) -> U) -> Table<U> {
        Table(self.0.map(f))
    }

    /// The matrix underneath, counted from 0.
    pub fn as_matrix(&self) -> &DMatrix<T> {
        &self.0
    }

    /// The matrix itself, counted from 0.
    pub fn into_matrix(self) -> DMatrix<T> {
        self.0
    }
}

impl<T: nalgebra::Scalar> Column<T> {
    /// `rows` entries, each `value`.
    pub fn filled(rows: usize, value: T) -> Self {
        Column(DVector::from_element(rows, value))
    }

    /// The entries of `values`, in order.
    pub fn from_vec(values: Vec<T>) -> Self {
        Column(DVector::from_vec(values))
    }

    /// Number of entries, the last one's subscript.
    pub fn rows(&self) -> usize {
        self.0.nrows()
    }

    /// The entries in order.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.0.iter()
    }

    /// The same column with every entry mapped.
    pub fn map<U: nalgebra::Scalar>(&self, f: impl FnMut(T) -> U) -> Column<U> {
        Column(self.0.map(f))
    }

    /// The entries underneath, counted from 0.
    pub fn as_slice(&self) -> &[T] {
        self.0.as_slice()
    }

    /// The entry at `i`, or nothing where Mathcad would say "This array index is invalid for this array."
    pub fn get(&self, i: usize) -> Option<&T> {
        self.0.get(i.checked_sub(1)?)
    }
}

impl<T, I: Subscript, J: Subscript> Index<(I, J)> for Table<T> {
    type Output = T;
    fn index(&self, (i, j): (I, J)) -> &T {
        &self.0[(i.at() - 1, j.at() - 1)]
    }
}

impl<T, I: Subscript, J: Subscript> IndexMut<(I, J)> for Table<T> {
    fn index_mut(&mut self, (i, j): (I, J)) -> &mut T {
        &mut self.0[(i.at() - 1, j.at() - 1)]
    }
}

impl<T, I: Subscript> Index<I> for Column<T> {
    type Output = T;
    fn index(&self, i: I) -> &T {
        &self.0[i.at() - 1]
    }
}

impl<T, I: Subscript> IndexMut<I> for Column<T> {
    fn index_mut(&mut self, i: I) -> &mut T {
        &mut self.0[i.at() - 1]
    }
}

/// Mathcad's `rows(v)`.
pub fn rows<T: nalgebra::Scalar>(v: &Column<T>) -> usize {
    v.rows()
}

/// The smallest of the entries, as Mathcad's `min`.
pub fn min<T: Scalar>(entries: [T; 2]) -> T {
    entries[0].min(entries[1])
}

/// The largest of the entries, as Mathcad's `max`.
pub fn max<T: Scalar>(entries: [T; 2]) -> T {
    entries[0].max(entries[1])
}
