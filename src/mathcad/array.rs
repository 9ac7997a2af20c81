//! Mathcad's arrays with `ORIGIN = 1`: a thin type over nalgebra.

use serde::Serialize;
use std::ops::{Index, IndexMut};

use nalgebra::{DMatrix, DVector};

use numbers::scalar::{Scalar, Subscript};
use numbers::square::SparseSquare;

/// A matrix whose rows and columns count from 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(bound = "T: nalgebra::Scalar + Serialize")]
pub struct Table<T>(DMatrix<T>);

/// A column vector whose entries count from 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(bound = "T: nalgebra::Scalar + Serialize")]
pub struct Column<T>(DVector<T>);

/// A square matrix of zeros whose rows and columns count from 1, into which a few entries are written:
/// only those are kept.
#[derive(Clone, Debug)]
pub struct Square<T>(SparseSquare<T>);

impl<T: nalgebra::Scalar> Table<T> {
    /// Makes a `rows` x `cols` table filled with `value`.
    pub fn filled(rows: usize, cols: usize, value: T) -> Self {
        Table(DMatrix::from_vec(rows, cols, vec![value; rows * cols]))
    }

    /// Makes the table whose entry `[i, j]`, from 1, is `entry(i, j)`.
    pub fn from_fn(rows: usize, cols: usize, mut entry: impl FnMut(usize, usize) -> T) -> Self {
        Table(DMatrix::from_fn(rows, cols, |i, j| entry(i + 1, j + 1)))
    }

    /// Returns the number of rows, the last row's subscript.
    pub fn rows(&self) -> usize {
        self.0.nrows()
    }

    /// Returns the number of columns, the last column's subscript.
    pub fn cols(&self) -> usize {
        self.0.ncols()
    }

    /// Returns the entries of row `i`, from 1.
    pub fn row(&self, i: usize) -> impl Iterator<Item = &T> {
        (0..self.cols()).map(move |j| &self.0[(i - 1, j)])
    }

    /// Returns the table of what `f` makes of each entry.
    pub fn map<U: nalgebra::Scalar>(&self, f: impl FnMut(T) -> U) -> Table<U> {
        Table(self.0.map(f))
    }

    /// Borrows the matrix underneath, counted from 0.
    pub fn as_matrix(&self) -> &DMatrix<T> {
        &self.0
    }

    /// Takes out the matrix underneath, counted from 0.
    pub fn into_matrix(self) -> DMatrix<T> {
        self.0
    }
}

impl<T: nalgebra::Scalar> Column<T> {
    /// Makes a column of `rows` entries, each `value`.
    pub fn filled(rows: usize, value: T) -> Self {
        Column(DVector::from_element(rows, value))
    }

    /// Makes the column of the entries `values`, in order.
    pub fn from_vec(values: Vec<T>) -> Self {
        Column(DVector::from_vec(values))
    }

    /// Returns the number of entries, the last one's subscript.
    pub fn rows(&self) -> usize {
        self.0.nrows()
    }

    /// Returns the entries in order.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.0.iter()
    }

    /// Returns the column of what `f` makes of each entry.
    pub fn map<U: nalgebra::Scalar>(&self, f: impl FnMut(T) -> U) -> Column<U> {
        Column(self.0.map(f))
    }

    /// Borrows the entries underneath, counted from 0.
    pub fn as_slice(&self) -> &[T] {
        self.0.as_slice()
    }

    /// Returns the entry at `i`, from 1, or nothing where Mathcad would say "This array index is
    /// invalid for this array."
    pub fn get(&self, i: usize) -> Option<&T> {
        self.0.get(i.checked_sub(1)?)
    }
}

impl<T: Scalar> Square<T> {
    /// Makes `rows` rows and as many columns of zeros.
    pub fn zeros(rows: usize) -> Self {
        Square(SparseSquare::zeros(rows))
    }

    /// Returns the matrix with all its zeros.
    pub fn to_table(&self) -> Table<T> {
        Table(self.0.dense())
    }

    /// Takes out the matrix underneath, counted from 0.
    pub fn into_sparse(self) -> SparseSquare<T> {
        self.0
    }
}

impl<T: Scalar> Index<(usize, usize)> for Square<T> {
    type Output = T;
    fn index(&self, (i, j): (usize, usize)) -> &T {
        &self.0[(i - 1, j - 1)]
    }
}

impl<T: Scalar> IndexMut<(usize, usize)> for Square<T> {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut T {
        &mut self.0[(i - 1, j - 1)]
    }
}

impl<T, I: Subscript, J: Subscript> Index<(I, J)> for Table<T> {
    type Output = T;
    fn index(&self, (i, j): (I, J)) -> &T {
        &self.0[(i.index() - 1, j.index() - 1)]
    }
}

impl<T, I: Subscript, J: Subscript> IndexMut<(I, J)> for Table<T> {
    fn index_mut(&mut self, (i, j): (I, J)) -> &mut T {
        &mut self.0[(i.index() - 1, j.index() - 1)]
    }
}

impl<T, I: Subscript> Index<I> for Column<T> {
    type Output = T;
    fn index(&self, i: I) -> &T {
        &self.0[i.index() - 1]
    }
}

impl<T, I: Subscript> IndexMut<I> for Column<T> {
    fn index_mut(&mut self, i: I) -> &mut T {
        &mut self.0[i.index() - 1]
    }
}

/// Returns Mathcad's `rows(v)`, the number of entries.
/// ```
/// use plane_contact_mathcad::array::{Column, rows};
/// assert_eq!(rows(&Column::from_vec(vec![1.5, 2.5])), 2);
/// ```
pub fn rows<T: nalgebra::Scalar>(v: &Column<T>) -> usize {
    v.rows()
}

/// Returns the smallest of the entries, as Mathcad's `min`.
/// ```
/// assert_eq!(plane_contact_mathcad::array::min([2.0, 1.0]), 1.0);
/// ```
pub fn min<T: Scalar>(entries: [T; 2]) -> T {
    entries[0].min(entries[1])
}

/// Returns the largest of the entries, as Mathcad's `max`.
/// ```
/// assert_eq!(plane_contact_mathcad::array::max([2.0, 1.0]), 2.0);
/// ```
pub fn max<T: Scalar>(entries: [T; 2]) -> T {
    entries[0].max(entries[1])
}
