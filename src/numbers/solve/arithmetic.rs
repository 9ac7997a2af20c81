//! The scalar and the solver that are asked for.

use base::choices;
use base::error::{InputError, Result};

choices! {
    /// The number type that a run computes in.
    ScalarName {
        /// Computes with 16 digits: Mathcad's own.
        F64 = "f64",
        /// Computes with 7 digits.
        F32 = "f32",
        /// Computes with 31 digits.
        F64x2 = "f64x2",
        /// Computes with 16 digits, and a bound on the error.
        Bounded = "f64-bounded",
        /// Computes with 31 digits, and a bound on the error.
        BoundedDouble = "f64x2-bounded",
        /// Computes with rational numbers, without rounding.
        Exact = "exact",
    }
}

choices! {
    /// How the equations of an iteration are solved.
    Solver {
        /// LU of the full matrix, with row exchanges.
        DenseLu = "dense-lu",
        /// LU of the entries that are not 0, with row exchanges.
        SparseLu = "sparse-lu",
        /// Cholesky of the full matrix.
        DenseCholesky = "dense-cholesky",
        /// Cholesky of the entries that are not 0; LDLᵀ where the scalar has no square root.
        SparseCholesky = "sparse-cholesky",
        /// Conjugate gradients, preconditioned by the diagonal, to the tolerance.
        Cg = "cg",
        /// Sparse Cholesky in the scalar of half the digits, refined to the tolerance.
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

impl Solver {
    /// Returns whether it comes nearer to the solution step by step, to a tolerance.
    pub fn iterates(self) -> bool {
        matches!(self, Solver::Cg | Solver::Refined)
    }
}

/// In which numbers, by which solver, and to which tolerance a run computes.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    serde::Serialize,
    serde::Deserialize,
    schemars::JsonSchema,
)]
pub struct Arithmetic {
    /// The number type.
    pub scalar: ScalarName,
    /// The solver; null: sparse-cholesky, but sparse-lu under printed in f64 and f64-bounded.
    pub solver: Option<Solver>,
    /// The relative residual |A x - b| / (|A| |x| + |b|) at which cg and refined stop; null: 16 eps
    /// of the scalar.
    pub tol: Option<f64>,
    /// What the numbers of the scene stand for.
    pub inputs: Inputs,
}

impl Arithmetic {
    /// Returns the solver asked for; else sparse LU in `f64` for a matrix that is
    /// `printed`, which need not be positive definite, and sparse Cholesky for every other one.
    pub fn solver(&self, printed: bool) -> Solver {
        use ScalarName::{Bounded, F64};
        let by_faer = matches!(self.scalar, F64 | Bounded);
        let own = if printed && by_faer { Solver::SparseLu } else { Solver::SparseCholesky };
        self.solver.unwrap_or(own)
    }

    /// Returns whether it is `f64` by a solver that nobody chose.
    pub fn is_default(&self) -> bool {
        *self == Arithmetic::default()
    }

    /// Checks that the solver is offered in the scalar, and that the tolerance is between 0 and 1.
    /// Errors: names the solvers that are offered, or the fault of the tolerance.
    pub fn check(&self) -> Result<()> {
        use {ScalarName as Name, Solver::*};
        let offered: &[Solver] = match self.scalar {
            Name::F64 | Name::Bounded => {
                &[DenseLu, SparseLu, DenseCholesky, SparseCholesky, Cg, Refined]
            }
            Name::F32 => &[DenseLu, SparseCholesky, Cg],
            Name::F64x2 => &[DenseLu, SparseCholesky, Cg, Refined],
            Name::Exact | Name::BoundedDouble => &[DenseLu, SparseCholesky],
        };
        if !offered.contains(&self.solver(true)) {
            let names: Vec<&str> = offered.iter().map(|solver| solver.name()).collect();
            let what = format!("{} does not solve in {}", self.solver(true), self.scalar);
            return Err(InputError::new("--solver", what, format!("use {}", names.join(", "))));
        }
        match self.tol {
            Some(_) if !self.solver(true).iterates() => {
                let what = format!("{} solves directly: it has no tolerance", self.solver(true));
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
