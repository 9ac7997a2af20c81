//! Speed against accuracy: what each number type and solver and each of the paper's own parameters
//! costs, and how accurate it is.
//!
//! ```text
//!  Request, Varied --trials--> Trial --> Request --measure--> seconds, bytes, Solution
//!                                                              |
//!  words <-- Section (rows, orders of convergence) <-- errors, order, pareto
//! ```
//!
//! Everything but times, peak memory and the Pareto front, which is drawn from the times, is the
//! same on every run.

mod accuracy;
mod errors;
mod geometry;
mod limit;
mod measure;
mod order;
pub mod peak;
mod rows;
mod trials;
mod words;

pub use accuracy::{AccurateSolution, Outcome, check_accuracy, solve_to};
pub use errors::Errors;
pub use geometry::geometry;
pub use limit::{Approach, Limit};
pub use measure::{Options, PATIENCE, measure, pareto, steps};
pub use order::Order;
pub use rows::{Ladder, Row, Section, Trade};
pub use trials::{FINEST, Trial, find, trials};

use base::choices;

choices! {
    /// What is varied: number type, solver, mesh, a parameter of contact, half of a scene, or what the
    /// paper leaves open.
    Varied {
        /// The number type in which a run computes.
        Arithmetic = "arithmetic",
        /// How the equations are solved.
        Solver = "solver",
        /// The element size: meshes with true arcs where a generator makes the scene, else refinement.
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
        /// What the paper leaves open of its example: radii, mesh, shape of the stamp, unit of c_tol.
        Geometry = "geometry",
    }
}
