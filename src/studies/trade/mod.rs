//! Speed against accuracy: what each number type and solver and each of the paper's own parameters
//! costs, and how accurate it is.
//!
//! ```text
//!  Request, Axis --trials--> Trial --TimedTrial--> seconds, Solution
//!                                             |
//!    Section (rows, orders of convergence) <-- errors, order, pareto
//! ```
//!
//! Everything but times and the Pareto front, which is drawn from the times, is the same on every run.

mod accuracy;
mod axis;
pub(crate) mod command;
mod errors;
mod measure;
mod order;
mod rows;
mod trial;
pub mod trial_tables;

pub use accuracy::{AccurateSolution, Rounding, check_accuracy, solve_to};
pub use axis::{AXES, Axis, Truth};
pub use errors::{Contact, Errors};
pub use measure::{Plan, Point, measure, pareto, plan};
pub use order::Order;
pub use rows::{Row, Section, Trade};
pub use trial::Trial;
