//! The solution of A x = b in each scalar by each solver.
//!
//! | | `f32` | `f64`, `f64-bounded` | `f64x2`, `f64x2-bounded` | `exact` |
//! |---|---|---|---|---|
//! | `dense-lu` | own | faer | own | own |
//! | `sparse-lu` | - | faer | - | - |
//! | `dense-cholesky` | - | faer | - | - |
//! | `sparse-cholesky` | LDLᵀ | faer | LDLᵀ | LDLᵀ modulo a prime, lifted |
//! | `cg` | to `tol` | to `tol` | to `tol`; - with a bound | - |
//! | `refined` | - | factors in f32 | factors in f64; - with a bound | - |

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};

use super::arithmetic::Solver;
use super::dense::{DenseCholesky, DenseLu};
use super::elimination::{Field, solve_dense};
use super::error_bound::error_bound;
use super::factors::{Factors, Lu};
use super::iterative::{Unsolved, conjugate_gradients, refine};
use super::ldlt::Ldlt;
use super::lifting::lift;
use super::sparse::SparseCholesky;
use super::sparse_lu::SparseLu;
use super::square::SparseSquare;
use super::symmetric::SparseSymmetric;
use crate::scalar::{Bounded, BoundedDouble, Exact, F64x2, Rounded, Scalar, WithBound, scope};

/// A solution of linear equations.
#[derive(Clone, Debug)]
pub struct Solved<T> {
    /// The unknowns.
    pub x: DVector<T>,
    /// The relative residual |A x − b| / (|A| |x| + |b|), exactly 0 of an exact solution.
    pub residual: f64,
}

/// What came of A x = b.
pub type Outcome<T> = Result<Solved<T>, Unsolved>;

/// A scalar in whose precision linear equations are solved.
pub trait Precision: Scalar {
    /// Solves `a` x = `b` by a solver that [`check`](super::arithmetic::Arithmetic::check) must
    /// have passed; every solver but `dense-lu` and `sparse-lu` takes A for symmetric and reads its lower
    /// triangle. Of those that the scalar does not offer the direct ones count as `sparse-cholesky`.
    ///
    /// # Errors
    /// A is singular, or an iteration did not converge.
    fn solve(a: DMatrix<Self>, b: &DVector<Self>, by: Solver, tol: Option<f64>) -> Outcome<Self>;

    /// Solves by `sparse-lu` from a matrix that is sparse already.
    ///
    /// # Errors
    /// The matrix is singular.
    fn solve_sparse(a: &SparseSquare<Self>, b: &DVector<Self>) -> Outcome<Self> {
        Self::solve(a.dense(), b, Solver::SparseLu, None)
    }

    /// Does `work`, and frees every number that it made but its result.
    ///
    /// # Errors
    /// Those of `work`.
    fn sweep<E>(work: impl FnOnce() -> Result<Solved<Self>, E>) -> Result<Solved<Self>, E> {
        work()
    }
}

/// A scalar in which A x = b is solved to a tolerance, by products with A and factors in fewer digits.
pub trait Iterates: Precision {
    /// Solves by Cholesky factors in fewer digits, refined to `tol`; by `cg` where there are none.
    ///
    /// # Errors
    /// The factors tell that A is singular, or the iteration did not converge.
    fn refined(a: &SparseSymmetric<Self>, b: &DVector<Self>, tol: f64) -> Outcome<Self>;

    /// Solves by `cg` or `refined` to `tol`, A symmetric and positive definite.
    ///
    /// # Errors
    /// The factors tell that A is singular, or the iteration did not converge.
    fn iterate(
        a: &SparseSymmetric<Self>,
        b: &DVector<Self>,
        by: Solver,
        tol: Option<f64>,
    ) -> Outcome<Self> {
        let tol = tol.unwrap_or(TOL * Self::EPSILON);
        match by {
            Solver::Refined => Self::refined(a, b, tol),
            Solver::Cg => by_gradients(a, b, tol),
            Solver::DenseLu | Solver::SparseLu | Solver::DenseCholesky | Solver::SparseCholesky => {
                unreachable!("{by} does not iterate")
            }
        }
    }
}

impl Iterates for f64 {
    fn refined(a: &SparseSymmetric<Self>, b: &DVector<Self>, tol: f64) -> Outcome<Self> {
        let factors = Ldlt::new(&a.map(|x| *x as f32))?;
        let x = refine(&factors, a, b, [tol, tol])?;
        Ok(Solved { residual: a.residual(&x, b), x })
    }
}

impl Iterates for f32 {
    fn refined(a: &SparseSymmetric<Self>, b: &DVector<Self>, tol: f64) -> Outcome<Self> {
        by_gradients(a, b, tol)
    }
}

impl Iterates for F64x2 {
    fn refined(a: &SparseSymmetric<Self>, b: &DVector<Self>, tol: f64) -> Outcome<Self> {
        let factors = SparseCholesky::new(a.map(|x| x.to_f64()))?;
        let x = refine(&factors, a, b, [tol, tol])?;
        Ok(Solved { residual: a.residual(&x, b), x })
    }
}

/// The tolerance where none is given, in units of the scalar's epsilon.
const TOL: f64 = 16.0;

impl Precision for f64 {
    fn solve(a: DMatrix<Self>, b: &DVector<Self>, by: Solver, tol: Option<f64>) -> Outcome<Self> {
        native(a, b, by, tol)
    }

    fn solve_sparse(a: &SparseSquare<Self>, b: &DVector<Self>) -> Outcome<Self> {
        Ok(solved(&SparseLu::new(a)?, b))
    }
}

impl Precision for f32 {
    fn solve(a: DMatrix<Self>, b: &DVector<Self>, by: Solver, tol: Option<f64>) -> Outcome<Self> {
        own(&a, b, by, tol)
    }
}

impl Precision for Bounded {
    /// Solves as in `f64`, digit for digit; every entry of x carries the bound on the largest error
    /// of an entry.
    fn solve(a: DMatrix<Self>, b: &DVector<Self>, by: Solver, tol: Option<f64>) -> Outcome<Self> {
        let a = SparseSquare::from_dense(&a);
        let (values, f) = (a.map(Scalar::to_f64).dense(), b.map(Scalar::to_f64));
        match by {
            Solver::SparseLu => Self::solve_sparse(&a, b),
            Solver::DenseLu => {
                let lu = DenseLu::new(values)?;
                Ok(with_bound(&lu, &a, b, solved(&lu, &f)))
            }
            Solver::DenseCholesky | Solver::SparseCholesky | Solver::Cg | Solver::Refined => {
                let factors = SparseCholesky::new(SparseSymmetric::of_lower(&values))?;
                Ok(with_bound(&factors, &a, b, f64::solve(values, &f, by, tol)?))
            }
        }
    }

    fn solve_sparse(a: &SparseSquare<Self>, b: &DVector<Self>) -> Outcome<Self> {
        let (factors, f) = (SparseLu::new(&a.map(Scalar::to_f64))?, b.map(Scalar::to_f64));
        let solved = solved(&factors, &f);
        Ok(with_bound(&factors, a, b, solved))
    }
}

impl Precision for BoundedDouble {
    /// Solves as in double-double, digit for digit; every entry of x carries the bound on the
    /// largest error of an entry.
    fn solve(a: DMatrix<Self>, b: &DVector<Self>, by: Solver, tol: Option<f64>) -> Outcome<Self> {
        let entries = SparseSquare::from_dense(&a);
        let factors = SparseLu::new(&entries.map(Scalar::to_f64))?;
        let solved = F64x2::solve(a.map(WithBound::value), &b.map(WithBound::value), by, tol)?;
        Ok(with_bound(&factors, &entries, b, solved))
    }
}

/// Returns a solution of A x = b with the bound on its error, by factors of A rounded to `f64`.
fn with_bound<V: Rounded>(
    factors: &dyn Factors,
    a: &SparseSquare<WithBound<V>>,
    b: &DVector<WithBound<V>>,
    solved: Solved<V>,
) -> Solved<WithBound<V>> {
    let error = error_bound(factors, a.entries(), b, &solved.x);
    Solved { x: solved.x.map(|x| WithBound::new(x, error)), residual: solved.residual }
}

impl Precision for F64x2 {
    fn solve(a: DMatrix<Self>, b: &DVector<Self>, by: Solver, tol: Option<f64>) -> Outcome<Self> {
        own(&a, b, by, tol)
    }
}

/// Solves by elimination of our own, or to a tolerance.
fn own<T: Field + Iterates>(
    a: &DMatrix<T>,
    b: &DVector<T>,
    by: Solver,
    tol: Option<f64>,
) -> Outcome<T> {
    let sparse = SparseSymmetric::of_lower(a);
    let x = match by {
        Solver::Cg | Solver::Refined => return T::iterate(&sparse, b, by, tol),
        Solver::DenseLu => solve_dense(|i, j| a[(i, j)], b.as_slice().to_vec())?,
        Solver::SparseLu | Solver::DenseCholesky | Solver::SparseCholesky => {
            Ldlt::new(&sparse)?.solve(b.as_slice())
        }
    };
    let x = DVector::from_vec(x);
    Ok(Solved { residual: sparse.residual(&x, b), x })
}

impl Precision for Exact {
    fn solve(a: DMatrix<Self>, b: &DVector<Self>, by: Solver, _: Option<f64>) -> Outcome<Self> {
        // On the rationals themselves: every intermediate one is freed at once.
        let value = |x: Exact| x.to_rational().expect("the matrix is finite");
        let b: Vec<RBig> = b.iter().map(|x| value(*x)).collect();
        let x = match by {
            Solver::DenseLu => solve_dense(|i, j| value(a[(i, j)]), b)?,
            Solver::SparseLu
            | Solver::DenseCholesky
            | Solver::SparseCholesky
            | Solver::Cg
            | Solver::Refined => {
                let matrix = SparseSymmetric::of_lower(&a).map(|x| value(*x));
                match lift(&matrix, &b) {
                    Some(x) => x,
                    // The prime was an unlucky one, or the matrix is singular: LDLᵀ names the
                    // pivot.
                    None => Ldlt::new(&matrix)?.solve(&b),
                }
            }
        };
        let x = DVector::from_iterator(x.len(), x.into_iter().map(Exact::new));
        Ok(Solved { x, residual: 0.0 })
    }

    fn sweep<E>(work: impl FnOnce() -> Result<Solved<Exact>, E>) -> Result<Solved<Exact>, E> {
        let (x, residual) = scope(|| {
            let value = |x: &Exact| x.to_rational().expect("a solution is finite");
            work().map(|solved| (solved.x.iter().map(value).collect::<Vec<_>>(), solved.residual))
        })?;
        let x = DVector::from_iterator(x.len(), x.into_iter().map(Exact::new));
        Ok(Solved { x, residual })
    }
}

/// Solves by faer, or to a tolerance.
fn native(a: DMatrix<f64>, b: &DVector<f64>, by: Solver, tol: Option<f64>) -> Outcome<f64> {
    let symmetric = SparseSymmetric::of_lower(&a);
    let x = match by {
        Solver::DenseLu => return Ok(solved(&DenseLu::new(a)?, b)),
        Solver::SparseLu => return f64::solve_sparse(&SparseSquare::from_dense(&a), b),
        Solver::Cg | Solver::Refined => return f64::iterate(&symmetric, b, by, tol),
        Solver::DenseCholesky => DenseCholesky::new(&a)?.solve(b),
        Solver::SparseCholesky => SparseCholesky::new(symmetric.clone())?.solve(b),
    };
    Ok(Solved { residual: symmetric.residual(&x, b), x })
}

fn solved(lu: &impl Lu, b: &DVector<f64>) -> Solved<f64> {
    let x = lu.solve(b);
    Solved { residual: lu.residual(&x, b), x }
}

fn by_gradients<T: Iterates>(a: &SparseSymmetric<T>, b: &DVector<T>, tol: f64) -> Outcome<T> {
    let x = conjugate_gradients(a, b, tol, T::EPSILON)?;
    Ok(Solved { residual: a.residual(&x, b), x })
}
