//! The scalar and the solver that are asked for.

use serde::Serialize;

use base::choices;
use base::error::{InputError, Result};
use problem::modelling::Coupling;

choices! {
    /// The number type that a run computes in.
    ScalarName {
        /// 16 digits, as Mathcad.
        F64 = "f64",
        /// 7 digits.
        F32 = "f32",
        /// 31 digits.
        F64x2 = "f64x2",
        /// Rational numbers, for some hundred equations.
        Exact = "exact",
    }
}

choices! {
    /// How the equations of an iteration are solved.
    Solver {
        /// LU of the full matrix, with row exchanges, as Mathcad.
        DenseLu = "dense-lu",
        /// LU of the entries that are not 0, with row exchanges.
        SparseLu = "sparse-lu",
        /// Cholesky of the entries that are not 0.
        SparseCholesky = "sparse-cholesky",
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

/// What is known of a scalar.
pub struct Properties {
    /// The decimal digits that it keeps; None where it keeps all.
    pub digits: Option<u32>,
    /// The solvers that are offered.
    pub solvers: &'static [Solver],
}

impl ScalarName {
    /// Returns whether it keeps all digits.
    pub fn is_exact(self) -> bool {
        self.properties().digits.is_none()
    }

    /// Returns why the weights of a coupling are not computed in it; None where they are.
    pub fn refuses(self, coupling: Coupling) -> Option<&'static str> {
        match (coupling, self) {
            (Coupling::Nts, _) | (Coupling::Mortar, ScalarName::F64 | ScalarName::F64x2) => None,
            (Coupling::Mortar, ScalarName::F32) => Some("its integrals lose too many digits"),
            (Coupling::Mortar, ScalarName::Exact) => Some("its integrals take square roots"),
        }
    }

    /// Returns what is known of it.
    pub fn properties(self) -> Properties {
        const OWN: &[Solver] = &[Solver::DenseLu, Solver::SparseCholesky];
        let (digits, solvers) = match self {
            ScalarName::F64 => (Some(16), Solver::ALL),
            ScalarName::F32 => (Some(7), OWN),
            ScalarName::F64x2 => (Some(31), OWN),
            ScalarName::Exact => (None, OWN),
        };
        Properties { digits, solvers }
    }
}

/// In which numbers, and by which solver, a run computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Arithmetic {
    /// The number type.
    pub scalar: ScalarName,
    /// The solver; null: sparse-cholesky, but sparse-lu under printed in f64.
    pub solver: Option<Solver>,
    /// What the numbers of the scene stand for.
    pub inputs: Inputs,
}

impl Arithmetic {
    /// Returns the solver asked for; else sparse LU in `f64` for a matrix that is
    /// `printed`, which need not be positive definite, and sparse Cholesky for every other one.
    pub fn solver(&self, printed: bool) -> Solver {
        let offers_sparse_lu = self.scalar.properties().solvers.contains(&Solver::SparseLu);
        let own =
            if printed && offers_sparse_lu { Solver::SparseLu } else { Solver::SparseCholesky };
        self.solver.unwrap_or(own)
    }

    /// Returns whether it is `f64` by a solver that nobody chose.
    pub fn is_default(&self) -> bool {
        *self == Arithmetic::default()
    }

    /// Checks that the solver is offered in the scalar.
    ///
    /// # Errors
    /// Names the solvers that are offered.
    pub fn check(&self) -> Result<()> {
        let (solver, offered) = (self.solver(true), self.scalar.properties().solvers);
        if !offered.contains(&solver) {
            let names: Vec<&str> = offered.iter().map(|solver| solver.name()).collect();
            let what = format!("{solver} does not solve in {}", self.scalar);
            return Err(InputError::new("solver", what, format!("use {}", names.join(", "))));
        }
        Ok(())
    }
}
