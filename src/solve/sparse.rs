//! Sparse Cholesky factors of a symmetric positive definite matrix, by the library faer.

use std::collections::BTreeMap;

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{MatRef, Par, Side};
use nalgebra::DVector;

use super::dense::Singular;

/// Displacements under a load of the size of the stiffness beyond which a matrix counts as singular, both scaled to a unit diagonal.
const UNBOUNDED: f64 = 1e13;

/// What is added to a unit diagonal to see how a singular matrix moves.
const SHIFT: f64 = 1e-10;

/// A symmetric matrix: the entries of its lower triangle, column by column, rows ascending.
#[derive(Clone, Debug)]
pub struct SparseSymmetric {
    columns: Vec<Vec<(usize, f64)>>,
}

impl SparseSymmetric {
    /// Sums entries (row, column, value) into an n x n matrix; those above the diagonal are left out.
    pub fn new(n: usize, entries: impl Iterator<Item = (usize, usize, f64)>) -> Self {
        let mut columns: Vec<BTreeMap<usize, f64>> = vec![BTreeMap::new(); n];
        for (i, j, value) in entries.filter(|(i, j, _)| i >= j) {
            *columns[j].entry(i).or_insert(0.0) += value;
        }
        SparseSymmetric { columns: columns.into_iter().map(|c| c.into_iter().collect()).collect() }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.columns.len()
    }

    /// The entries of the lower triangle: row, column, value.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let columns = self.columns.iter().enumerate();
        columns.flat_map(|(j, column)| column.iter().map(move |&(i, value)| (i, j, value)))
    }

    /// A x.
    pub fn times(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut product = DVector::zeros(x.len());
        for (i, j, value) in self.entries() {
            product[i] += value * x[j];
            if i != j {
                product[j] += value * x[i];
            }
        }
        product
    }

    /// The diagonal.
    pub fn diagonal(&self) -> DVector<f64> {
        let of_column = |j: usize| self.columns[j].first().filter(|(i, _)| *i == j);
        DVector::from_fn(self.size(), |j, _| of_column(j).map_or(0.0, |(_, value)| *value))
    }

    /// Largest row sum of |A|.
    pub fn norm(&self) -> f64 {
        let mut sums = DVector::<f64>::zeros(self.size());
        for (i, j, value) in self.entries() {
            sums[i] += value.abs();
            if i != j {
                sums[j] += value.abs();
            }
        }
        sums.amax()
    }
}

/// A symmetric positive definite matrix and its Cholesky factors.
pub struct SparseCholesky {
    matrix: SparseSymmetric,
    factors: Llt<usize, f64>,
}

impl SparseCholesky {
    /// Factors `matrix`.
    ///
    /// # Errors
    /// It is singular or nearly so: a trial load, scaled by the diagonal, moves one equation without bound. That equation is named.
    pub fn new(matrix: SparseSymmetric) -> Result<Self, Singular> {
        // One thread: faster for plane problems, and faer's bits depend on the number of threads.
        faer::set_global_parallelism(Par::Seq);
        let Some(factors) = factor(&matrix, 0.0) else {
            return Err(mechanism(&matrix));
        };
        let cholesky = SparseCholesky { matrix, factors };
        match probe(&cholesky.factors, &cholesky.matrix.diagonal()) {
            Some((_, size)) if size.is_finite() && size < UNBOUNDED => Ok(cholesky),
            None => Ok(cholesky),
            Some((column, size)) => Err(Singular { column, pivot: 1.0 / size }),
        }
    }

    /// The solution x of A x = `b`.
    pub fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        solve(&self.factors, b)
    }

    /// Relative residual |A x − b| / (|A| |x| + |b|) in the largest-entry norm of vectors; 0 when x and b are 0.
    pub fn residual(&self, x: &DVector<f64>, b: &DVector<f64>) -> f64 {
        let residual = (self.matrix.times(x) - b).amax();
        if residual == 0.0 {
            return 0.0;
        }
        residual / (self.matrix.norm() * x.amax() + b.amax())
    }
}

fn solve(factors: &Llt<usize, f64>, b: &DVector<f64>) -> DVector<f64> {
    let x = factors.solve(MatRef::from_column_major_slice(b.as_slice(), b.len(), 1));
    DVector::from_fn(b.len(), |i, _| x[(i, 0)])
}

/// Cholesky factors of A with each diagonal entry made 1 + `shift` times as large; nothing where a pivot is not positive.
fn factor(matrix: &SparseSymmetric, shift: f64) -> Option<Llt<usize, f64>> {
    let entries: Vec<Triplet<usize, usize, f64>> = matrix
        .entries()
        .map(|(i, j, value)| Triplet::new(i, j, if i == j { value * (1.0 + shift) } else { value }))
        .collect();
    let n = matrix.size();
    let lower = SparseColMat::try_new_from_triplets(n, n, &entries)
        .expect("rows and columns are within the matrix");
    lower.sp_cholesky(Side::Lower).ok()
}

/// The equation that moves most under a trial load, and how far, both scaled to a unit diagonal; nothing without equations.
fn probe(factors: &Llt<usize, f64>, diagonal: &DVector<f64>) -> Option<(usize, f64)> {
    let scale = diagonal.map(f64::sqrt);
    // Signs without a pattern that a motion of the body could be orthogonal to.
    let sign = |i: usize| if (i * i + i / 3) % 5 < 2 { 1.0 } else { -1.0 };
    let load = DVector::from_fn(scale.len(), |i, _| sign(i) * scale[i]);
    let moved = solve(factors, &load).component_mul(&scale);
    let largest = moved.iter().map(|x| x.abs()).enumerate();
    largest.reduce(|a, b| if b.1 > a.1 || b.1.is_nan() { b } else { a })
}

/// The equation that a singular matrix leaves free to move.
fn mechanism(matrix: &SparseSymmetric) -> Singular {
    let diagonal = matrix.diagonal();
    if let Some(column) = diagonal.iter().position(|d| d.is_nan() || *d <= 0.0) {
        return Singular { column, pivot: diagonal[column] };
    }
    let shifted = factor(matrix, SHIFT).and_then(|factors| probe(&factors, &diagonal));
    let (column, size) = shifted.unwrap_or((0, f64::INFINITY));
    Singular { column, pivot: 1.0 / size }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of springs of stiffness 1 between `n` nodes, the first tied to the ground by `ground`.
    fn chain(n: usize, ground: f64) -> SparseSymmetric {
        let springs = (1..n).flat_map(|i| [(i, i, 1.0), (i - 1, i - 1, 1.0), (i, i - 1, -1.0)]);
        SparseSymmetric::new(n, springs.chain([(0, 0, ground)]))
    }

    #[test]
    fn a_chain_stretches_as_springs_in_series() {
        let cholesky = SparseCholesky::new(chain(5, 1.0)).unwrap();
        let pull = DVector::from_fn(5, |i, _| f64::from(i == 4));
        let u = cholesky.solve(&pull);
        assert!((u - DVector::from_fn(5, |i, _| i as f64 + 1.0)).amax() < 1e-14);
    }

    #[test]
    fn a_chain_that_nothing_holds_is_singular() {
        assert!(SparseCholesky::new(chain(5, 0.0)).is_err());
        assert!(SparseCholesky::new(chain(5, 1e-16)).is_err());
        assert!(SparseCholesky::new(chain(5, 1e-10)).is_ok());
    }

    #[test]
    fn a_matrix_without_equations_is_solved() {
        let cholesky = SparseCholesky::new(SparseSymmetric::new(0, std::iter::empty())).unwrap();
        assert_eq!(cholesky.solve(&DVector::zeros(0)).len(), 0);
    }
}
