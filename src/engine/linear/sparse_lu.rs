//! LU of the entries of a matrix that are not 0, with row exchanges, by the library faer.

use super::rounding;
use faer::Par;
use faer::sparse::linalg::solvers::{self, SymbolicLu};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use mathcad::SparseSquare;
use nalgebra::DVector;

use super::dense::DenseLu;
use super::factors::{Factors, Lu, Singular, backward_error, largest, solve};
use super::sparse::{largest_motion, mechanism};
use super::symmetric::SparseSymmetric;

/// The motion under loads of 1, over that which a pivot of dense LU that counts as 0 would bring,
/// beyond which dense LU says whether a matrix is singular.
const DOUBTFUL: f64 = 1e-3;

/// The number of equations beyond which the motion itself says so: dense LU would take too long.
const LARGEST_DENSE: usize = 3000;

/// A matrix and its sparse LU factors.
pub struct SparseLu {
    matrix: SparseColMat<usize, f64>,
    factors: solvers::Lu<usize, f64>,
}

impl SparseLu {
    /// Factors an n x n `matrix`, which should be symmetric but for rounding.
    ///
    /// # Errors
    /// Those of [`DenseLu`], which judges a matrix that loads move far; of a large one, the
    /// equation that it leaves free to move.
    pub fn new(matrix: &SparseSquare) -> Result<Self, Singular> {
        let Some(lu) = SparseLu::unjudged(matrix) else {
            return Err(judged(matrix, f64::INFINITY).expect("a pivot is 0"));
        };
        let motion = motion(&lu, &lu.matrix);
        if motion < DOUBTFUL * farthest(matrix.size()) {
            return Ok(lu);
        }
        judged(matrix, motion).map_or(Ok(lu), Err)
    }

    /// Factors an n x n `matrix`, however near to a singular one it is; None where a pivot is 0.
    pub fn unjudged(matrix: &SparseSquare) -> Option<Self> {
        let matrix = columns(matrix);
        faer::set_global_parallelism(Par::Seq);
        let symbolic = SymbolicLu::try_new(matrix.symbolic()).expect("a pattern fits in memory");
        let factors = solvers::Lu::try_new_with_symbolic(symbolic, matrix.as_ref()).ok()?;
        Some(SparseLu { matrix, factors })
    }
}

/// Returns the largest motion of a matrix by its factors, under loads of 1, both scaled to columns whose
/// largest entry is 1.
fn motion(factors: &impl Factors, matrix: &SparseColMat<usize, f64>) -> f64 {
    let scale = |j| largest(matrix.val_of_col(j));
    let scale = DVector::from_fn(matrix.ncols(), |j, _| scale(j));
    largest_motion(factors, &scale)
}

impl Factors for SparseLu {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        solve(&self.factors, b)
    }
}

impl Lu for SparseLu {
    fn residual(&self, x: &DVector<f64>, b: &DVector<f64>) -> f64 {
        let mut rest = -b;
        let mut row_sums = DVector::<f64>::zeros(x.len());
        for entry in self.matrix.triplet_iter() {
            rest[entry.row] += *entry.val * x[entry.col];
            row_sums[entry.row] += entry.val.abs();
        }
        backward_error(&rest, largest(row_sums.as_slice()), x, b)
    }
}

/// Returns the motion under loads of 1 that a pivot of dense LU that counts as 0 would bring.
fn farthest(n: usize) -> f64 {
    1.0 / rounding(n, f64::EPSILON)
}

/// Returns why a matrix is taken for singular that loads of 1 move by `motion`; None where it is not.
fn judged(matrix: &SparseSquare, motion: f64) -> Option<Singular> {
    let n = matrix.size();
    if n <= LARGEST_DENSE {
        return DenseLu::new(matrix.dense()).err();
    }
    let moves_too_far = motion.is_nan() || motion >= farthest(n);
    moves_too_far.then(|| mechanism(&SparseSymmetric::new(n, matrix.entries())))
}

/// Returns the entries that are not 0, column by column.
fn columns(matrix: &SparseSquare) -> SparseColMat<usize, f64> {
    let n = matrix.size();
    let (mut starts, mut rows, mut values) = (vec![0; n + 1], Vec::new(), Vec::new());
    for (row, column, value) in matrix.entries() {
        rows.push(row);
        values.push(value);
        starts[column + 1] = rows.len();
    }
    // A column without entries starts where the last one ended.
    (0..n).for_each(|j| starts[j + 1] = starts[j + 1].max(starts[j]));
    SparseColMat::new(SymbolicSparseColMat::new_checked(n, n, starts, None, rows), values)
}
