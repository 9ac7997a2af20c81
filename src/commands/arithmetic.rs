//! The numbers and the solver of a run.

use plane_contact::numbers::solve::{Arithmetic, Inputs, ScalarName, Solver};

#[derive(Clone, Copy, clap::Args)]
pub struct ArithmeticArgs {
    /// f64, f32, f64x2 (31 digits), f64-bounded and f64x2-bounded (the same with a bound on the error
    /// of the displacements), exact (rational numbers, for some hundred equations).
    #[arg(long, value_name = "NAME", default_value = "f64")]
    scalar: ScalarName,
    /// dense-lu (Mathcad's own), sparse-lu, dense-cholesky, sparse-cholesky, cg (conjugate gradients
    /// to --tol), refined (factors in the scalar below, refined to --tol) [default: sparse-cholesky;
    /// sparse-lu under printed in f64 and f64-bounded].
    #[arg(long, value_name = "NAME")]
    solver: Option<Solver>,
    /// Largest relative residual |A x - b| / (|A| |x| + |b|) at which cg and refined stop; cg also
    /// takes that of A scaled to a unit diagonal, refined the next change of x over x [default: 16 eps
    /// of the scalar].
    #[arg(long, value_name = "T")]
    tol: Option<f64>,
    /// What the numbers of the scene stand for: binary, the exact value of their f64; decimal, the
    /// shortest decimal that reads back to it.
    #[arg(long, value_name = "NAME", default_value = "binary")]
    inputs: Inputs,
}

impl From<ArithmeticArgs> for Arithmetic {
    fn from(args: ArithmeticArgs) -> Self {
        let ArithmeticArgs { scalar, solver, tol, inputs } = args;
        Arithmetic { scalar, solver, tol, inputs }
    }
}
