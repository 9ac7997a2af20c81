//! Sparse LDLᵀ without pivoting, for `f32`, double-doubles and rationals.
//!
//! Source: T. A. Davis, *Algorithm 849: a concise sparse Cholesky factorization package*, ACM TOMS 31(4),
//! 2005 (up-looking, by the elimination tree, which tells where rows have entries: J. W. H. Liu, *The role of
//! elimination trees in sparse factorization*, SIAM J. Matrix Anal. Appl. 11(1), 1990); the order of the
//! equations is that of `numbers::ordering`.

use super::factors::Singular;
use super::is_lost;
use super::symmetric::SparseSymmetric;
use numbers::ordering::{order, places};
use numbers::scalar::Field;

/// A symmetric matrix as L D Lᵀ, in an order of its equations that keeps L sparse.
pub struct Ldlt<F> {
    /// The equation that stands at each place of the order.
    order: Vec<usize>,
    /// The columns of L below its unit diagonal: row and value, rows ascending.
    columns: Vec<Vec<(usize, F)>>,
    pivots: Vec<F>,
}

impl<F: Field> Ldlt<F> {
    /// Factors an n x n `matrix`.
    ///
    /// # Errors
    /// Names a pivot that is 0, or below 16 n · eps of its own diagonal entry. A matrix
    /// that is not semidefinite may have one and yet a unique solution.
    pub fn new(matrix: &SparseSymmetric<F>) -> Result<Self, Singular> {
        let n = matrix.size();
        let order = order(matrix.pattern());
        // The columns of the upper triangle in the new order: row and value.
        let (place, mut upper) = (places(&order), vec![Vec::new(); n]);
        for (i, j, value) in matrix.entries() {
            let (p, q) = (place[i], place[j]);
            upper[p.max(q)].push((p.min(q), value));
        }
        let mut factors =
            Ldlt { order, columns: vec![Vec::new(); n], pivots: Vec::with_capacity(n) };
        // The elimination tree, as far as the rows done so far tell it.
        let (mut parent, mut seen_in) = (vec![usize::MAX; n], vec![usize::MAX; n]);
        let mut y = vec![F::zero(); n];
        for (k, column) in upper.into_iter().enumerate() {
            // Row k of L has entries where the tree leads to from those of A left of the diagonal.
            let mut path = Vec::new();
            seen_in[k] = k;
            for mut i in column.iter().map(|(i, _)| *i) {
                while seen_in[i] != k {
                    seen_in[i] = k;
                    path.push(i);
                    if parent[i] == usize::MAX {
                        parent[i] = k;
                    }
                    i = parent[i];
                }
            }
            // Each before what it changes.
            path.sort_unstable();
            for (i, a) in column {
                y[i] = a;
            }
            let before = y[k].size();
            let pivot = factors.row(k, &path, &mut y);
            if is_lost(&pivot, before, n) {
                return Err(Singular { column: factors.order[k], pivot: pivot.size() });
            }
            factors.pivots.push(pivot);
        }
        Ok(factors)
    }

    /// Computes row k of L, whose entries stand at `path`; returns the pivot and leaves `y` 0.
    fn row(&mut self, k: usize, path: &[usize], y: &mut [F]) -> F {
        let mut pivot = std::mem::replace(&mut y[k], F::zero());
        for &i in path {
            let value = std::mem::replace(&mut y[i], F::zero());
            if value.vanishes() {
                continue;
            }
            for (row, l) in &self.columns[i] {
                y[*row].subtract_product(l, &value);
            }
            let l = value.over(&self.pivots[i]);
            pivot.subtract_product(&l, &value);
            self.columns[i].push((k, l));
        }
        pivot
    }

    /// Returns the solution x of A x = `b`.
    pub fn solve(&self, b: &[F]) -> Vec<F> {
        let mut y: Vec<F> = self.order.iter().map(|&e| b[e].clone()).collect();
        for (j, column) in self.columns.iter().enumerate() {
            let value = y[j].clone();
            for (row, l) in column {
                y[*row].subtract_product(l, &value);
            }
        }
        for (j, column) in self.columns.iter().enumerate().rev() {
            let mut value = y[j].over(&self.pivots[j]);
            for (row, l) in column {
                value.subtract_product(l, &y[*row]);
            }
            y[j] = value;
        }
        let mut x = vec![F::zero(); y.len()];
        for (value, &e) in y.into_iter().zip(&self.order) {
            x[e] = value;
        }
        x
    }
}
