//! Speed against accuracy: what each number type and solver and each of the paper's own knobs
//! costs, and what it gives.
//!
//! ```text
//!  Request, Knob --trials--> Trial --> Request --measure--> seconds, bytes, Solution
//!                                                              |
//!  words <-- Section (rows, orders of convergence) <-- errors, pareto, order
//! ```
//!
//! Everything but times, peak memory and the Pareto front, which is drawn from the times, is the
//! same on every run.

mod accuracy;
mod errors;
mod measure;
mod order;
mod pareto;
pub mod peak;
mod rows;
mod trials;
mod words;

pub use accuracy::{Attempt, Reached, solve_to};
pub use errors::Errors;
pub use measure::{Options, measure};
pub use order::Order;
pub use pareto::pareto;
pub use rows::{Row, Section, Trade};
pub use trials::{Against, Setting, Trial, find, trials};

use crate::choices;

choices! {
    /// What is varied.
    Knob {
        /// The number type.
        Arithmetic = "arithmetic",
        /// How the equations are solved.
        Solver = "solver",
        /// The element size.
        Mesh = "mesh",
        /// The tolerance of the contact search.
        Tolerance = "c_tll",
        /// The number of iterations, or of steps.
        Iterations = "iterations",
        /// Who is in contact.
        Status = "status",
        /// How a contact node is bound.
        Coupling = "coupling",
        /// Half of a symmetric scene.
        Symmetry = "symmetry",
    }
}
