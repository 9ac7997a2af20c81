//! The solution of A x = b in each scalar by each solver.
//!
//! | | `f32`, `f64x2`, `exact` | `f64` |
//! |---|---|---|
//! | `dense-lu` | own | faer |
//! | `sparse-lu` | - | faer |
//! | `sparse-cholesky` | LDLᵀ | faer |

use dashu_ratio::RBig;
use nalgebra::DVector;

use super::arithmetic::Solver;
use super::dense::DenseLu;
use super::elimination::solve_dense;
use super::factors::{Factors, Singular, residual};
use super::ldlt::Ldlt;
use super::sparse::SparseCholesky;
use super::sparse_lu::SparseLu;
use super::symmetric::SparseSymmetric;
use numbers::scalar::{Exact, F64x2, Scalar, scope};
use numbers::square::SparseSquare;

/// A solution of linear equations.
#[derive(Clone, Debug)]
pub struct Solved<T> {
    /// The unknowns.
    pub x: DVector<T>,
    /// The relative residual |A x − b| / (|A| |x| + |b|), exactly 0 of an exact solution.
    pub residual: f64,
}

/// What came of A x = b.
pub type SolvedOrSingular<T> = Result<Solved<T>, Singular>;

/// A scalar in whose precision linear equations are solved.
pub trait Precision: Scalar {
    /// Solves `a` x = `b` by a solver that [`check`](super::arithmetic::Arithmetic::check) must
    /// have passed; `sparse-cholesky` takes A for symmetric and reads its lower triangle.
    ///
    /// # Errors
    /// A is singular.
    fn solve(a: &SparseSquare<Self>, b: &DVector<Self>, by: Solver) -> SolvedOrSingular<Self>;

    /// Solves `a` x = `b` by `sparse-cholesky`, A positive definite.
    ///
    /// # Errors
    /// A is singular.
    fn solve_symmetric(a: &SparseSymmetric<Self>, b: &DVector<Self>) -> SolvedOrSingular<Self>;

    /// Does `work`, and frees every number that it made but its result.
    ///
    /// # Errors
    /// Those of `work`.
    fn sweep<E>(work: impl FnOnce() -> Result<Solved<Self>, E>) -> Result<Solved<Self>, E> {
        work()
    }
}

impl Precision for f64 {
    fn solve(a: &SparseSquare<Self>, b: &DVector<Self>, by: Solver) -> SolvedOrSingular<Self> {
        match by {
            Solver::DenseLu => Ok(solved(&DenseLu::new(a.dense())?, a, b)),
            Solver::SparseLu => Ok(solved(&SparseLu::new(a)?, a, b)),
            Solver::SparseCholesky => Self::solve_symmetric(&lower(a), b),
        }
    }

    fn solve_symmetric(a: &SparseSymmetric<Self>, b: &DVector<Self>) -> SolvedOrSingular<Self> {
        let x = SparseCholesky::new(a)?.solve(b);
        Ok(Solved { residual: a.residual(&x, b), x })
    }
}

/// Solves in a scalar by elimination of our own alone.
macro_rules! by_own_elimination {
    ($($scalar:ty),+) => {$(
        impl Precision for $scalar {
            fn solve(a: &SparseSquare<Self>, b: &DVector<Self>, by: Solver) -> SolvedOrSingular<Self> {
                let symmetric = lower(a);
                match by {
                    Solver::DenseLu => {
                        let x = solve_dense(|i, j| a[(i, j)], b.as_slice().to_vec())?;
                        let x = DVector::from_vec(x);
                        Ok(Solved { residual: symmetric.residual(&x, b), x })
                    }
                    Solver::SparseLu => unreachable!("it is offered in f64 alone"),
                    Solver::SparseCholesky => Self::solve_symmetric(&symmetric, b),
                }
            }

            fn solve_symmetric(a: &SparseSymmetric<Self>, b: &DVector<Self>) -> SolvedOrSingular<Self> {
                let x = DVector::from_vec(Ldlt::new(a)?.solve(b.as_slice()));
                Ok(Solved { residual: a.residual(&x, b), x })
            }
        }
    )+};
}

by_own_elimination!(f32, F64x2);

impl Precision for Exact {
    fn solve(a: &SparseSquare<Self>, b: &DVector<Self>, by: Solver) -> SolvedOrSingular<Self> {
        match by {
            Solver::DenseLu => {
                let b = b.iter().map(|x| value(*x)).collect();
                Ok(exact(solve_dense(|i, j| value(a[(i, j)]), b)?))
            }
            Solver::SparseLu => unreachable!("it is offered in f64 alone"),
            Solver::SparseCholesky => Self::solve_symmetric(&lower(a), b),
        }
    }

    fn solve_symmetric(a: &SparseSymmetric<Self>, b: &DVector<Self>) -> SolvedOrSingular<Self> {
        let b: Vec<RBig> = b.iter().map(|x| value(*x)).collect();
        Ok(exact(Ldlt::new(&a.map(|x| value(*x)))?.solve(&b)))
    }

    fn sweep<E>(work: impl FnOnce() -> Result<Solved<Exact>, E>) -> Result<Solved<Exact>, E> {
        let (x, residual) = scope(|| {
            let solved = work()?;
            Ok((solved.x.iter().map(|x| value(*x)).collect::<Vec<_>>(), solved.residual))
        })?;
        Ok(Solved { residual, ..exact(x) })
    }
}

/// Returns the rational number itself: every intermediate one is freed at once.
fn value(x: Exact) -> RBig {
    x.to_rational().expect("the equations are finite")
}

fn exact(x: Vec<RBig>) -> Solved<Exact> {
    let x = DVector::from_iterator(x.len(), x.into_iter().map(Exact::new));
    Solved { x, residual: 0.0 }
}

fn solved(factors: &impl Factors, a: &SparseSquare, b: &DVector<f64>) -> Solved<f64> {
    let x = factors.solve(b);
    Solved { residual: residual(a, &x, b), x }
}

/// Returns the lower triangle of a matrix, which is taken for symmetric.
fn lower<T: Scalar>(matrix: &SparseSquare<T>) -> SparseSymmetric<T> {
    SparseSymmetric::new(matrix.size(), matrix.entries())
}
