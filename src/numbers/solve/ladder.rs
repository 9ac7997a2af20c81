//! The ladder: which scalar and which solver, and how each rung solves A x = b.
//!
//! | | `f32` | `f64`, `f64-bounded` | `f64x2` | `exact` |
//! |---|---|---|---|---|
//! | `dense-lu` | faer | faer | own | own |
//! | `dense-cholesky` | faer | faer | - | - |
//! | `sparse-cholesky` | faer | faer | LDLᵀ | LDLᵀ modulo a prime, lifted |
//! | `cg` | to `tol` | to `tol` | to `tol` | - |
//! | `refined` | - | factors in f32 | factors in f64 | - |

use dashu_ratio::RBig;
use nalgebra::{DMatrix, DVector};

use super::dense::{DenseCholesky, DenseLu, Factors, Native, Singular};
use super::error_bound::error_bound;
use super::field::Field;
use super::iterative::{NotConverged, conjugate_gradients, refine};
use super::ldlt::Ldlt;
use super::lifting::lift;
use super::lu::solve_dense;
use super::sparse::{SparseCholesky, SparseSymmetric};
use crate::choices;
use crate::error::InputError;
use crate::numbers::scalar::{Bounded, Exact, F64x2, Scalar};

choices! {
    /// The number type of a run.
    ScalarName {
        /// 16 digits: Mathcad's own.
        F64 = "f64",
        /// 7 digits.
        F32 = "f32",
        /// 31 digits.
        F64x2 = "f64x2",
        /// 16 digits, and a bound on the error.
        Bounded = "f64-bounded",
        /// Rational numbers.
        Exact = "exact",
    }
}

choices! {
    /// How the equations of an iteration are solved.
    Solver {
        /// LU of the full matrix, with row exchanges.
        DenseLu = "dense-lu",
        /// Cholesky of the full matrix.
        DenseCholesky = "dense-cholesky",
        /// Cholesky of the entries that are not 0; LDLᵀ where the scalar has no square root.
        SparseCholesky = "sparse-cholesky",
        /// Conjugate gradients to the tolerance.
        Cg = "cg",
        /// Factors in the scalar below, refined to the tolerance.
        Refined = "refined",
    }
}

choices! {
    /// What the numbers of a scene stand for.
    Inputs {
        /// The exact value of the `f64`.
        Binary = "binary",
        /// The shortest decimal that reads back to the `f64`: 0.2 is 1/5.
        Decimal = "decimal",
    }
}

/// In which numbers, by which solver, and to which tolerance a run computes.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Arithmetic {
    /// The number type.
    pub scalar: ScalarName,
    /// The solver; nothing: the scalar's own, dense LU in numbers of the machine, sparse LDLᵀ in others.
    pub solver: Option<Solver>,
    /// Largest relative residual |A x − b| / (|A| |x| + |b|) that `cg` and `refined` stop at; nothing: 16 eps of the scalar.
    pub tol: Option<f64>,
    /// What the scene's numbers stand for.
    pub inputs: Inputs,
}

impl Default for Arithmetic {
    fn default() -> Self {
        Arithmetic { scalar: ScalarName::F64, solver: None, tol: None, inputs: Inputs::Binary }
    }
}

impl Arithmetic {
    /// The solver.
    pub fn solver(&self) -> Solver {
        self.solver.unwrap_or(match self.scalar {
            ScalarName::F64x2 | ScalarName::Exact => Solver::SparseCholesky,
            _ => Solver::DenseLu,
        })
    }

    /// Whether it is `f64` by a solver that nobody chose.
    pub fn is_default(&self) -> bool {
        *self == Arithmetic::default()
    }

    /// That the rung is there, and the tolerance sound.
    ///
    /// # Errors
    /// It is not.
    pub fn check(&self) -> Result<(), InputError> {
        use {ScalarName as Name, Solver::*};
        let offered: &[Solver] = match self.scalar {
            Name::F64 | Name::Bounded => &[DenseLu, DenseCholesky, SparseCholesky, Cg, Refined],
            Name::F32 => &[DenseLu, DenseCholesky, SparseCholesky, Cg],
            Name::F64x2 => &[DenseLu, SparseCholesky, Cg, Refined],
            Name::Exact => &[DenseLu, SparseCholesky],
        };
        if !offered.contains(&self.solver()) {
            let names: Vec<&str> = offered.iter().map(|solver| solver.name()).collect();
            let what = format!("{} does not solve in {}", self.solver(), self.scalar);
            return Err(InputError::new("--solver", what, format!("use {}", names.join(", "))));
        }
        match self.tol {
            Some(_) if ![Cg, Refined].contains(&self.solver()) => {
                let what = format!("{} solves directly: it has no tolerance", self.solver());
                Err(InputError::new("--tol", what, "leave it out, or use --solver cg or refined"))
            }
            Some(tol) if !(tol > 0.0 && tol < 1.0) => {
                let what = format!("the tolerance {tol:e} is not between 0 and 1");
                Err(InputError::new("--tol", what, "give the largest relative residual, as 1e-12"))
            }
            _ => Ok(()),
        }
    }
}

/// A solution of A x = b.
#[derive(Clone, Debug)]
pub struct Solved<T> {
    /// x.
    pub x: DVector<T>,
    /// Relative residual |A x − b| / (|A| |x| + |b|); exactly 0 of an exact solution.
    pub residual: f64,
}

/// Why A x = b was not solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unsolved {
    /// A has no unique solution, or is too near to such a matrix.
    Singular(Singular),
    /// An iteration stopped short of its tolerance.
    NotConverged(NotConverged),
}

impl From<Singular> for Unsolved {
    fn from(singular: Singular) -> Self {
        Unsolved::Singular(singular)
    }
}

impl From<NotConverged> for Unsolved {
    fn from(not_converged: NotConverged) -> Self {
        Unsolved::NotConverged(not_converged)
    }
}

/// A scalar that the ladder solves in.
pub trait Rung: Scalar {
    /// Solves A x = `b` by `solver`, which [`Arithmetic::check`] must have passed; every solver but `dense-lu` takes A for symmetric and
    /// reads its lower triangle.
    ///
    /// # Errors
    /// A is singular, or an iteration did not converge.
    fn solve(
        matrix: DMatrix<Self>,
        b: &DVector<Self>,
        solver: Solver,
        tol: Option<f64>,
    ) -> Result<Solved<Self>, Unsolved>;

    /// Does `work`, and frees every number that it made but its result.
    fn sweep<E>(work: impl FnOnce() -> Result<Solved<Self>, E>) -> Result<Solved<Self>, E> {
        work()
    }
}

/// Tolerance where none is given, in units of the scalar's epsilon.
const TOL: f64 = 16.0;

impl Rung for f64 {
    fn solve(
        matrix: DMatrix<f64>,
        b: &DVector<f64>,
        solver: Solver,
        tol: Option<f64>,
    ) -> Result<Solved<f64>, Unsolved> {
        match solver {
            Solver::Refined => refined::<f32, f64>(&matrix, b, tol.unwrap_or(TOL * f64::EPSILON)),
            _ => native(matrix, b, solver, tol),
        }
    }
}

impl Rung for f32 {
    fn solve(
        matrix: DMatrix<f32>,
        b: &DVector<f32>,
        solver: Solver,
        tol: Option<f64>,
    ) -> Result<Solved<f32>, Unsolved> {
        native(matrix, b, solver, tol)
    }
}

impl Rung for Bounded {
    /// As in `f64`, digit for digit; every entry of x carries the bound on the largest error of an entry.
    fn solve(
        matrix: DMatrix<Bounded>,
        b: &DVector<Bounded>,
        solver: Solver,
        tol: Option<f64>,
    ) -> Result<Solved<Bounded>, Unsolved> {
        let (values, f) = (matrix.map(Scalar::to_f64), b.map(Scalar::to_f64));
        let (factors, solved): (Box<dyn Factors<f64>>, _) = if solver == Solver::DenseLu {
            let lu = DenseLu::new(values)?;
            let x = lu.solve(&f);
            let residual = lu.residual(&x, &f);
            (Box::new(lu), Solved { x, residual })
        } else {
            let factors = SparseCholesky::new(SparseSymmetric::of_lower(&values))?;
            (Box::new(factors), f64::solve(values, &f, solver, tol)?)
        };
        let columns = matrix.column_iter().enumerate();
        let entries = columns.flat_map(|(j, column)| {
            column.iter().copied().enumerate().map(move |(i, a)| (i, j, a)).collect::<Vec<_>>()
        });
        let entries = entries.filter(|(_, _, a)| a.to_f64() != 0.0 || a.error() > 0.0);
        let error = error_bound(&*factors, entries, b, &solved.x);
        Ok(Solved { x: solved.x.map(|x| Bounded::new(x, error)), residual: solved.residual })
    }
}

impl Rung for F64x2 {
    fn solve(
        matrix: DMatrix<F64x2>,
        b: &DVector<F64x2>,
        solver: Solver,
        tol: Option<f64>,
    ) -> Result<Solved<F64x2>, Unsolved> {
        let tol = tol.unwrap_or(TOL * <F64x2 as Field>::EPSILON);
        let sparse = SparseSymmetric::of_lower(&matrix);
        let x = match solver {
            Solver::Refined => return refined::<f64, F64x2>(&matrix, b, tol),
            Solver::Cg => conjugate_gradients(&sparse, b, tol)?.x,
            Solver::DenseLu => {
                DVector::from_vec(solve_dense(|i, j| matrix[(i, j)], b.as_slice().to_vec())?)
            }
            _ => DVector::from_vec(Ldlt::new(&sparse)?.solve(b.as_slice())),
        };
        Ok(Solved { residual: sparse.residual(&x, b), x })
    }
}

impl Rung for Exact {
    fn solve(
        matrix: DMatrix<Exact>,
        b: &DVector<Exact>,
        solver: Solver,
        _: Option<f64>,
    ) -> Result<Solved<Exact>, Unsolved> {
        // On the rationals themselves: every intermediate one is freed at once.
        let value = |x: Exact| x.to_rational().expect("the matrix is finite");
        let b: Vec<RBig> = b.iter().map(|x| value(*x)).collect();
        let x = match solver {
            Solver::DenseLu => solve_dense(|i, j| value(matrix[(i, j)]), b)?,
            _ => {
                let matrix = SparseSymmetric::of_lower(&matrix).map(|x| value(*x));
                // In fractions where the prime was an unlucky one, and to name the pivot of a singular matrix.
                lift(&matrix, &b)
                    .map_or_else(|| Ok(Ldlt::new(&matrix)?.solve(&b)), Ok::<_, Singular>)?
            }
        };
        let x = DVector::from_iterator(x.len(), x.into_iter().map(Exact::new));
        Ok(Solved { x, residual: 0.0 })
    }

    fn sweep<E>(work: impl FnOnce() -> Result<Solved<Exact>, E>) -> Result<Solved<Exact>, E> {
        let (x, residual) = crate::numbers::scalar::scope(|| {
            let value = |x: &Exact| x.to_rational().expect("a solution is finite");
            work().map(|solved| (solved.x.iter().map(value).collect::<Vec<_>>(), solved.residual))
        })?;
        let x = DVector::from_iterator(x.len(), x.into_iter().map(Exact::new));
        Ok(Solved { x, residual })
    }
}

/// By faer, or by conjugate gradients.
fn native<T: Native>(
    matrix: DMatrix<T>,
    b: &DVector<T>,
    solver: Solver,
    tol: Option<f64>,
) -> Result<Solved<T>, Unsolved> {
    if solver == Solver::DenseLu {
        let lu = DenseLu::new(matrix)?;
        let x = lu.solve(b);
        return Ok(Solved { residual: lu.residual(&x, b), x });
    }
    let sparse = SparseSymmetric::of_lower(&matrix);
    let x = match solver {
        Solver::DenseCholesky => DenseCholesky::new(&matrix)?.solve(b),
        Solver::Cg => conjugate_gradients(&sparse, b, tol.unwrap_or(TOL * T::EPSILON))?.x,
        _ => SparseCholesky::new(sparse.clone())?.solve(b),
    };
    Ok(Solved { residual: sparse.residual(&x, b), x })
}

/// Sparse Cholesky factors in L, residuals in T.
fn refined<L: Native, T: Scalar>(
    matrix: &DMatrix<T>,
    b: &DVector<T>,
    tol: f64,
) -> Result<Solved<T>, Unsolved> {
    let sparse = SparseSymmetric::of_lower(matrix);
    let factors = SparseCholesky::new(sparse.map(|x| L::from_f64(x.to_f64())))?;
    let x = refine(&factors, &sparse, b, tol)?.x;
    Ok(Solved { residual: sparse.residual(&x, b), x })
}
