//! The numbers and the solver of a run.

use plane_contact::numbers::solve::{Arithmetic, Inputs, ScalarName, Solver};

#[derive(Clone, Copy, clap::Args)]
pub struct ArithmeticArgs {
    #[arg(long, value_name = "NAME", default_value = "f64", help = ScalarName::help())]
    scalar: ScalarName,
    #[arg(long, value_name = "NAME", help = format!(
        "{} [default: sparse-cholesky; sparse-lu under printed in f64 and f64-bounded]",
        Solver::help()
    ))]
    solver: Option<Solver>,
    #[arg(long, value_name = "NAME", default_value = "binary", help = format!(
        "What the numbers of the scene stand for. {}",
        Inputs::help()
    ))]
    inputs: Inputs,
}

impl From<ArithmeticArgs> for Arithmetic {
    fn from(args: ArithmeticArgs) -> Self {
        let ArithmeticArgs { scalar, solver, inputs } = args;
        Arithmetic { scalar, solver, inputs }
    }
}
