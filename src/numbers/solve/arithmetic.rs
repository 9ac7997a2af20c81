//! The scalar and the solver that are asked for.

use crate::choices;
use crate::error::InputError;

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
        /// Computes with rational numbers, without rounding.
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

/// In which numbers, by which solver, and to which tolerance a run computes.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Arithmetic {
    pub scalar: ScalarName,
    /// The solver; with none, the scalar's own: dense LU in numbers of the machine, sparse LDLᵀ in
    /// others.
    pub solver: Option<Solver>,
    /// The largest relative residual |A x − b| / (|A| |x| + |b|) that `cg` and `refined` stop at;
    /// with none, 16 eps of the scalar.
    pub tol: Option<f64>,
    pub inputs: Inputs,
}

impl Default for Arithmetic {
    fn default() -> Self {
        Arithmetic { scalar: ScalarName::F64, solver: None, tol: None, inputs: Inputs::Binary }
    }
}

impl Arithmetic {
    /// Returns the solver asked for, or the scalar's own.
    pub fn solver(&self) -> Solver {
        self.solver.unwrap_or(match self.scalar {
            ScalarName::F64x2 | ScalarName::Exact => Solver::SparseCholesky,
            _ => Solver::DenseLu,
        })
    }

    /// Returns whether it is `f64` by a solver that nobody chose.
    pub fn is_default(&self) -> bool {
        *self == Arithmetic::default()
    }

    /// Checks that the solver is offered in the scalar, and that the tolerance is between 0 and 1.
    /// Errors: names the solvers that are offered, or the fault of the tolerance.
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
