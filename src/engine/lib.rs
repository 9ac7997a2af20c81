//! The answer: a request, its solution, and the estimated errors of its numbers.
#![forbid(unsafe_code)]

mod assessment;
pub mod contact;
mod decisions;
mod distance;
mod elimination;
mod equations;
pub mod error;
pub mod estimates;
pub mod fast;
mod hertz;
mod memory;
mod published;
pub mod quantities;
mod range;
mod request;
mod residual;
mod session;
mod solution;
mod solve;
mod sparse;
mod stiffness;
mod support;
mod unilateral;

pub use assessment::{Assessment, SolutionDistance};
pub use decisions::{Decision, decisions};
pub use distance::{BodyDistance, Distance, distance, over};
pub use elimination::{Constraint, Elimination, Motion};
pub use fast::condensation::kept_equations;
pub use hertz::Hertz;
pub use memory::Bytes;
pub use quantities::{
    BodySummary, ContactNode, IterationRow, NodeFields, Quantity, TriangleState, TriangleValues,
    summaries,
};
pub use range::{beyond_range, locking};
pub use request::Request;
pub use session::Session;
pub use solution::{
    Cycle, Detail, Equilibrium, FoundPairs, Margin, NearestDecision, OtherEquilibrium, Path,
    Published, Solution, Start, Step, StepBounds, Unilateral, Uniqueness, last_under_each_load,
    max_displacement,
};
pub use solve::{check, solve};
pub use sparse::dense_matrices;
pub use stiffness::Stiffness;
