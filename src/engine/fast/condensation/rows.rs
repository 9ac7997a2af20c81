//! A matrix T of few entries a row, and the products with it.

use nalgebra::{DMatrix, DVector};
use smallvec::SmallVec;

/// Entries of a row: column and weight, of most rows one.
pub(super) type Row = SmallVec<[(usize, f64); 1]>;

/// Rows of few entries.
pub(super) struct Rows {
    pub(super) rows: Vec<Row>,
    pub(super) columns: usize,
}

impl Rows {
    /// Returns the lower triangle of Tᵀ S T of a dense S.
    pub(super) fn reduced(&self, s: &DMatrix<f64>) -> DMatrix<f64> {
        let mut of_column = vec![Row::new(); self.columns];
        for (l, row) in self.rows.iter().enumerate() {
            row.iter().for_each(|(column, weight)| of_column[*column].push((l, *weight)));
        }
        let mut reduced = DMatrix::zeros(self.columns, self.columns);
        let mut product = DVector::zeros(s.nrows());
        for (c, entries) in of_column.iter().enumerate() {
            product.fill(0.0);
            for (l, weight) in entries {
                product.axpy(*weight, &s.column(*l), 1.0);
            }
            for (row, value) in self.rows.iter().zip(product.iter()) {
                for (r, weight) in row.iter().filter(|(r, _)| *r >= c) {
                    reduced[(*r, c)] += weight * value;
                }
            }
        }
        reduced
    }

    /// Returns Tᵀ f.
    pub(super) fn load(&self, f: &DVector<f64>) -> DVector<f64> {
        let mut load = DVector::zeros(self.columns);
        for (row, f) in self.rows.iter().zip(f) {
            row.iter().for_each(|(column, weight)| load[*column] += weight * f);
        }
        load
    }

    /// Returns T q.
    pub(super) fn expand(&self, q: &DVector<f64>) -> DVector<f64> {
        let of_row = |row: &Row| row.iter().map(|(column, w)| w * q[*column]).sum();
        DVector::from_iterator(self.rows.len(), self.rows.iter().map(of_row))
    }

    /// Returns the columns that `place` gives one among those that are left, of which there are `columns`.
    pub(super) fn left(&self, place: &[Option<usize>], columns: usize) -> Rows {
        let entry = |(column, weight): &(usize, f64)| Some((place[*column]?, *weight));
        let rows = self.rows.iter().map(|row| row.iter().filter_map(entry).collect());
        Rows { rows: rows.collect(), columns }
    }
}
