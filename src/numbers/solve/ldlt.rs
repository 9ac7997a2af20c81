//! Sparse LDLᵀ without pivoting, for numbers that no library factors: double-doubles and rationals.
//!
//! Source: T. A. Davis, *Algorithm 849: a concise sparse Cholesky factorization package*, ACM TOMS
//! 31(4), 2005 (up-looking, by the elimination tree); the order of the equations is faer's
//! approximate minimum degree.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::amd;
use faer::sparse::{SparseColMat, Triplet};

use super::factors::Singular;
use super::field::Field;
use super::symmetric::SparseSymmetric;

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
    /// Errors: names a pivot that is 0, or below 16 n · eps of its own diagonal entry. A matrix
    /// that is not semidefinite may have one and yet a unique solution.
    pub fn new(matrix: &SparseSymmetric<F>) -> Result<Self, Singular> {
        let n = matrix.size();
        let order = order(matrix);
        let upper = permuted(matrix, &order);
        let mut factors =
            Ldlt { order, columns: vec![Vec::new(); n], pivots: Vec::with_capacity(n) };
        let mut tree = Tree { parent: vec![None; n], seen_in: vec![usize::MAX; n] };
        let mut y = vec![F::zero(); n];
        for (k, column) in upper.into_iter().enumerate() {
            let path = tree.row(k, column.iter().map(|(i, _)| *i));
            for (i, a) in column {
                y[i] = a;
            }
            let least = 16.0 * n as f64 * F::EPSILON * y[k].size();
            let pivot = factors.row(k, &path, &mut y);
            if pivot.vanishes() || pivot.size().is_nan() || pivot.size() < least {
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

/// The elimination tree, as far as the rows done so far tell it.
struct Tree {
    parent: Vec<Option<usize>>,
    seen_in: Vec<usize>,
}

impl Tree {
    /// Returns where row k of L has entries, each before what it changes, from the places of its
    /// entries in A.
    fn row(&mut self, k: usize, entries: impl Iterator<Item = usize>) -> Vec<usize> {
        self.seen_in[k] = k;
        let mut path = Vec::new();
        for mut i in entries {
            while self.seen_in[i] != k {
                self.seen_in[i] = k;
                path.push(i);
                i = *self.parent[i].get_or_insert(k);
            }
        }
        // A parent comes after its children.
        path.sort_unstable();
        path
    }
}

/// Returns the equations in an order of small fill.
fn order<F: Field>(matrix: &SparseSymmetric<F>) -> Vec<usize> {
    let n = matrix.size();
    let upper: Vec<Triplet<usize, usize, f64>> =
        matrix.entries().map(|(i, j, _)| Triplet::new(j, i, 1.0)).collect();
    let upper = SparseColMat::try_new_from_triplets(n, n, &upper)
        .expect("rows and columns are within the matrix");
    let (mut order, mut place) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, upper.compute_nnz()));
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut place, upper.symbolic(), amd::Control::default(), stack)
        .expect("the indices fit");
    order
}

/// Returns the columns of the upper triangle in the new order: row and value.
fn permuted<F: Field>(matrix: &SparseSymmetric<F>, order: &[usize]) -> Vec<Vec<(usize, F)>> {
    let mut place = vec![0; order.len()];
    for (k, &e) in order.iter().enumerate() {
        place[e] = k;
    }
    let mut columns = vec![Vec::new(); order.len()];
    for (i, j, value) in matrix.entries() {
        let (p, q) = (place[i], place[j]);
        columns[p.max(q)].push((p.min(q), value));
    }
    columns
}
