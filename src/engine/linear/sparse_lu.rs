//! LU of the entries of a matrix that are not 0, with row exchanges, by the library faer.

use super::rounding;
use faer::Par;
use faer::sparse::linalg::solvers;
use nalgebra::DVector;
use numbers::sparse_lu::columns;
use numbers::square::SparseSquare;

use super::dense::DenseLu;
use super::factors::{Factors, Singular, solve};
use super::sparse::{largest_motion, mechanism};
use super::symmetric::SparseSymmetric;

/// The motion under loads of 1, over that which a pivot of dense LU that counts as 0 would bring,
/// beyond which dense LU says whether a matrix is singular.
const DOUBTFUL: f64 = 1e-3;

/// The number of equations beyond which the motion itself says so: dense LU would take too long.
const LARGEST_DENSE: usize = 3000;

/// The sparse LU factors of a matrix.
pub struct SparseLu(solvers::Lu<usize, f64>);

impl SparseLu {
    /// Factors an n x n `matrix`, which should be symmetric but for rounding.
    ///
    /// # Errors
    /// Those of [`DenseLu`], which judges a matrix that loads move far; of a large one, the
    /// equation that it leaves free to move.
    pub fn new(matrix: &SparseSquare) -> Result<Self, Singular> {
        faer::set_global_parallelism(Par::Seq);
        let Ok(factors) = columns(matrix).sp_lu() else {
            // A pivot is 0: it is singular, also where dense LU, which exchanges rows otherwise, finds none.
            let singular = || mechanism(&SparseSymmetric::new(matrix.size(), matrix.entries()));
            return Err(judged(matrix, f64::INFINITY).unwrap_or_else(singular));
        };
        let lu = SparseLu(factors);
        // Under loads of 1, both scaled to columns whose largest entry is 1.
        let scale = |j, _| matrix.column(j).fold(0.0, |most: f64, (_, a)| most.max(a.abs()));
        let motion = largest_motion(&lu, &DVector::from_fn(matrix.size(), scale));
        if motion < DOUBTFUL * farthest(matrix.size()) {
            return Ok(lu);
        }
        judged(matrix, motion).map_or(Ok(lu), Err)
    }
}

impl Factors for SparseLu {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        solve(&self.0, b)
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
