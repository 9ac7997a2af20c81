//! Speed against accuracy: what each number type and solver and each of the paper's own parameters
//! costs, and how accurate it is.
//!
//! ```text
//!  Request, Varied --trials--> Trial --> Request --measure--> seconds, Solution
//!                                                     |
//!            Section (rows, orders of convergence) <-- errors, order, pareto
//! ```
//!
//! Everything but times and the Pareto front, which is drawn from the times, is the same on every run.

mod accuracy;
pub(crate) mod command;
mod errors;
mod measure;
mod order;
mod rows;
pub mod table;
mod trials;

pub use accuracy::{AccurateSolution, Outcome, check_accuracy, solve_to};
pub use errors::Errors;
pub use measure::{Options, Point, measure, pareto, steps};
pub use order::Order;
pub use rows::{Row, Section, Trade};
pub use trials::{Trial, trials};

use base::choices;

choices! {
    /// What is varied: number type, solver, mesh, a parameter of contact, or half of a scene.
    Varied {
        /// The number type in which a run computes.
        Arithmetic = "arithmetic",
        /// How the equations are solved.
        Solver = "solver",
        /// The element size: each triangle divided into four, the outline kept.
        Mesh = "mesh",
        /// The tolerance of the contact search.
        Tolerance = "c_tll",
        /// The number of iterations, or of steps.
        Iterations = "iterations",
        /// The rule that decides who is in contact.
        Status = "status",
        /// How a contact node is bound.
        Coupling = "coupling",
        /// Half of a symmetric scene.
        Symmetry = "symmetry",
    }
}

impl Varied {
    /// What errors are measured against, in words.
    pub fn against(self) -> &'static str {
        match self {
            Varied::Arithmetic => "the last row that ran",
            Varied::Solver => "f64x2",
            Varied::Mesh => {
                "the reference solution on the finest mesh that ran, whose outline is the polygon of the \
                 scene's own"
            }
            Varied::Symmetry => "the whole scene under the same variant",
            Varied::Tolerance | Varied::Iterations | Varied::Status | Varied::Coupling => {
                "the equilibrium under the scene's own friction on the same mesh (unilateral, mortar)"
            }
        }
    }
}
