//! The solution of A x = b in each scalar by each solver.
//!
//! | | `f32`, `f64x2`, `f64x2-bounded`, `exact` | `f64`, `f64-bounded` |
//! |---|---|---|
//! | `dense-lu` | own | faer |
//! | `sparse-lu` | - | faer |
//! | `sparse-cholesky` | LDLᵀ | faer |

use dashu_ratio::RBig;
use nalgebra::DVector;

use super::arithmetic::Solver;
use super::dense::DenseLu;
use super::elimination::solve_dense;
use super::error_bound::error_bound;
use super::factors::{Factors, Lu, Singular};
use super::ldlt::Ldlt;
use super::sparse::SparseCholesky;
use super::sparse_lu::SparseLu;
use super::symmetric::SparseSymmetric;
use mathcad::SparseSquare;
use numbers::scalar::{Bounded, BoundedDouble, Exact, F64x2, Rounded, Scalar, WithBound, scope};

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
            Solver::DenseLu => Ok(solved(&DenseLu::new(a.dense())?, b)),
            Solver::SparseLu => Ok(solved(&SparseLu::new(a)?, b)),
            Solver::SparseCholesky => Self::solve_symmetric(&lower(a), b),
        }
    }

    fn solve_symmetric(a: &SparseSymmetric<Self>, b: &DVector<Self>) -> SolvedOrSingular<Self> {
        let x = SparseCholesky::new(a.clone())?.solve(b);
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

impl Precision for Bounded {
    /// Solves as in `f64`, digit for digit; every entry of x carries the bound on the largest error
    /// of an entry.
    fn solve(a: &SparseSquare<Self>, b: &DVector<Self>, by: Solver) -> SolvedOrSingular<Self> {
        let (values, f) = (a.map(Scalar::to_f64), b.map(Scalar::to_f64));
        match by {
            Solver::DenseLu => {
                let lu = DenseLu::new(values.dense())?;
                Ok(with_bound(&lu, a.entries(), b, solved(&lu, &f)))
            }
            Solver::SparseLu => {
                let lu = SparseLu::new(&values)?;
                Ok(with_bound(&lu, a.entries(), b, solved(&lu, &f)))
            }
            Solver::SparseCholesky => Self::solve_symmetric(&lower(a), b),
        }
    }

    fn solve_symmetric(a: &SparseSymmetric<Self>, b: &DVector<Self>) -> SolvedOrSingular<Self> {
        let factors = SparseCholesky::new(a.map(|x| x.to_f64()))?;
        let f = b.map(Scalar::to_f64);
        let x = factors.solve(&f);
        let solved = Solved { residual: factors.residual(&x, &f), x };
        Ok(with_bound(&factors, whole(a), b, solved))
    }
}

impl Precision for BoundedDouble {
    /// Solves as in double-double, digit for digit; every entry of x carries the bound on the
    /// largest error of an entry.
    fn solve(a: &SparseSquare<Self>, b: &DVector<Self>, by: Solver) -> SolvedOrSingular<Self> {
        let factors = SparseLu::new(&a.map(Scalar::to_f64))?;
        let solved = F64x2::solve(&a.map(WithBound::value), &b.map(WithBound::value), by)?;
        Ok(with_bound(&factors, a.entries(), b, solved))
    }

    fn solve_symmetric(a: &SparseSymmetric<Self>, b: &DVector<Self>) -> SolvedOrSingular<Self> {
        let factors = SparseCholesky::new(a.map(|x| x.to_f64()))?;
        let solved = F64x2::solve_symmetric(&a.map(|x| x.value()), &b.map(WithBound::value))?;
        Ok(with_bound(&factors, whole(a), b, solved))
    }
}

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

/// Returns a solution of A x = b with the bound on its error, by factors of A rounded to `f64`;
/// `entries` are those of the whole of A.
fn with_bound<V: Rounded>(
    factors: &dyn Factors,
    entries: impl Iterator<Item = (usize, usize, WithBound<V>)>,
    b: &DVector<WithBound<V>>,
    solved: Solved<V>,
) -> Solved<WithBound<V>> {
    let error = error_bound(factors, entries, b, &solved.x);
    Solved { x: solved.x.map(|x| WithBound::new(x, error)), residual: solved.residual }
}

fn solved(lu: &impl Lu, b: &DVector<f64>) -> Solved<f64> {
    let x = lu.solve(b);
    Solved { residual: lu.residual(&x, b), x }
}

/// Returns the lower triangle of a matrix, which is taken for symmetric.
fn lower<T: Scalar>(matrix: &SparseSquare<T>) -> SparseSymmetric<T> {
    SparseSymmetric::new(matrix.size(), matrix.entries())
}

/// Returns the entries of both triangles of a symmetric matrix.
fn whole<T: Scalar>(matrix: &SparseSymmetric<T>) -> impl Iterator<Item = (usize, usize, T)> {
    let both = |(i, j, a)| [Some((i, j, a)), (i != j).then_some((j, i, a))];
    matrix.entries().flat_map(both).flatten()
}
