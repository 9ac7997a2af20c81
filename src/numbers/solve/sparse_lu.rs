//! LU of the entries of a matrix that are not 0, with row exchanges, by the library faer.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use faer::Par;
use faer::sparse::linalg::solvers::{self, SymbolicLu};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use nalgebra::DVector;

use super::dense::DenseLu;
use super::factors::{AnyLu, Factors, Lu, Native, Singular, backward_error, largest, solve};
use super::sparse::{largest_motion, mechanism};
use super::square::SparseSquare;
use super::symmetric::SparseSymmetric;
use crate::numbers::scalar::Scalar;

/// The motion under loads of 1, over that which a pivot of dense LU that counts as 0 would bring,
/// beyond which dense LU says whether a matrix is singular.
const DOUBTFUL: f64 = 1e-3;

/// The number of equations beyond which the motion itself says so: dense LU would take too long.
const LARGEST_DENSE: usize = 3000;

/// A matrix and its sparse LU factors.
pub struct SparseLu<T: Native = f64> {
    matrix: Arc<SparseColMat<usize, T>>,
    symbolic: SymbolicLu<usize>,
    factors: solvers::Lu<usize, T>,
}

impl<T: Native> SparseLu<T> {
    /// Factors an n x n `matrix`, which should be symmetric but for rounding.
    /// Errors: those of [`DenseLu`], which judges a matrix that loads move far; of a large one, the
    /// equation that it leaves free to move.
    pub fn new(matrix: &SparseSquare<T>) -> Result<Self, Singular> {
        let columns = columns(matrix);
        SparseLu::ordered(symbolic(&columns), Arc::new(columns), matrix)
    }

    /// Factors a matrix whose `columns`, and what their pattern alone says, are known.
    fn ordered(
        symbolic: SymbolicLu<usize>,
        columns: Arc<SparseColMat<usize, T>>,
        matrix: &SparseSquare<T>,
    ) -> Result<Self, Singular> {
        faer::set_global_parallelism(Par::Seq);
        let factors = solvers::Lu::try_new_with_symbolic(symbolic.clone(), (*columns).as_ref());
        let Ok(factors) = factors else {
            return Err(judged(matrix, f64::INFINITY).expect("a pivot is 0"));
        };
        let lu = SparseLu { matrix: columns, symbolic, factors };
        let motion = motion(&lu, &lu.matrix);
        if motion < DOUBTFUL * farthest::<T>(matrix.size()) {
            return Ok(lu);
        }
        judged(matrix, motion).map_or(Ok(lu), Err)
    }
}

/// Returns the largest motion of a matrix by its factors, under loads of 1, both scaled to columns whose
/// largest entry is 1.
fn motion<T: Native>(factors: &impl Factors<T>, matrix: &SparseColMat<usize, T>) -> f64 {
    let scale = |j| T::from_f64(largest(matrix.val_of_col(j)));
    let scale = DVector::from_fn(matrix.ncols(), |j, _| scale(j));
    largest_motion(factors, &scale)
}

/// Makes factors of a matrix more quickly than its LU; None where it cannot.
pub type Quick<'q> = dyn Fn(&SparseSquare) -> Option<AnyLu> + 'q;

/// The factors in `f64` that were made last: a run with bounds on its rounding factors the matrices of
/// the run that it bounds.
#[derive(Default)]
pub struct KnownLu(Mutex<Vec<Known>>);

/// A matrix whose factors are known.
#[derive(Clone)]
struct Known {
    matrix: Arc<SparseColMat<usize, f64>>,
    /// What its pattern says of its LU; None where that was not made.
    symbolic: Option<SymbolicLu<usize>>,
    factors: AnyLu,
}

impl KnownLu {
    /// How many are kept.
    const MOST: usize = 4;
    /// The number of equations of the largest that are kept.
    const LARGEST: usize = 10_000;

    /// Returns the factors of `matrix`, which are made where they are not known, by `quick` where that does.
    /// Errors: those of [`SparseLu::new`].
    pub fn factors(&self, matrix: &SparseSquare, quick: &Quick) -> Result<AnyLu, Singular> {
        let columns = Arc::new(columns(matrix));
        let is_alike = |known: &&Known| {
            let (a, b) = (known.matrix.symbolic(), columns.symbolic());
            a.col_ptr() == b.col_ptr() && a.row_idx() == b.row_idx()
        };
        let alike: Vec<Known> = self.made().iter().filter(is_alike).cloned().collect();
        if let Some(known) = alike.iter().find(|known| known.matrix.val() == columns.val()) {
            return Ok(Arc::clone(&known.factors));
        }
        let is_clear =
            |made: &AnyLu| motion(made, &columns) < DOUBTFUL * farthest::<f64>(matrix.size());
        let known = match quick(matrix).filter(is_clear) {
            Some(factors) => Known { matrix: columns, symbolic: None, factors },
            None => {
                let order = alike.into_iter().find_map(|known| known.symbolic);
                let order = order.unwrap_or_else(|| symbolic(&columns));
                let lu = SparseLu::ordered(order, columns, matrix)?;
                let (matrix, symbolic) = (Arc::clone(&lu.matrix), Some(lu.symbolic.clone()));
                Known { matrix, symbolic, factors: Arc::new(lu) }
            }
        };
        let factors = Arc::clone(&known.factors);
        if matrix.size() <= Self::LARGEST {
            let mut made = self.made();
            made.push(known);
            let beyond = made.len().saturating_sub(Self::MOST);
            made.drain(..beyond);
        }
        Ok(factors)
    }

    /// Releases all of them.
    pub fn release(&self) {
        self.made().clear();
    }

    fn made(&self) -> MutexGuard<'_, Vec<Known>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T: Native> Factors<T> for SparseLu<T> {
    fn solve(&self, b: &DVector<T>) -> DVector<T> {
        solve(&self.factors, b)
    }
}

impl<T: Native> Lu<T> for SparseLu<T> {
    fn residual(&self, x: &DVector<T>, b: &DVector<T>) -> f64 {
        let mut rest = -b;
        let mut row_sums = DVector::<T>::zeros(x.len());
        for entry in self.matrix.triplet_iter() {
            rest[entry.row] += *entry.val * x[entry.col];
            row_sums[entry.row] += Scalar::abs(*entry.val);
        }
        backward_error(&rest, largest(row_sums.as_slice()), x, b)
    }
}

/// Returns what the pattern of a matrix says of its factors.
fn symbolic<T>(columns: &SparseColMat<usize, T>) -> SymbolicLu<usize> {
    SymbolicLu::try_new(columns.symbolic()).expect("a pattern fits in memory")
}

/// Returns the motion under loads of 1 that a pivot of dense LU that counts as 0 would bring.
fn farthest<T: Native>(n: usize) -> f64 {
    1.0 / (16.0 * n as f64 * T::EPSILON)
}

/// Returns why a matrix is taken for singular that loads of 1 move by `motion`; None where it is not.
fn judged<T: Native>(matrix: &SparseSquare<T>, motion: f64) -> Option<Singular> {
    let n = matrix.size();
    if n <= LARGEST_DENSE {
        return DenseLu::new(matrix.dense()).err();
    }
    let moves_too_far = motion.is_nan() || motion >= farthest::<T>(n);
    moves_too_far.then(|| mechanism(&SparseSymmetric::new(n, matrix.entries())))
}

/// Returns the entries that are not 0, column by column.
fn columns<T: Native>(matrix: &SparseSquare<T>) -> SparseColMat<usize, T> {
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
