//! The answer: a request, its solution, and the estimated errors of its numbers.

mod assessment;
pub mod condensation;
pub mod contact;
mod distance;
mod elimination;
mod equations;
pub mod error;
pub mod estimates;
mod factors;
mod found;
mod held;
mod hertz;
mod memory;
mod not_finite;
mod printed;
mod probe;
mod published;
mod range;
mod request;
mod residual;
mod side_by_side;
mod solution;
mod solve;
mod sparse;
mod stiffness;
mod summary;
mod support;
mod unilateral;

pub use assessment::{Assessment, Measured, Others};
pub use condensation::kept_equations;
pub use distance::{BodyDistance, Distance, distance, over};
pub use elimination::{Constraint, Elimination, Motion};
pub use factors::Kept;
pub use found::FoundPairs;
pub use hertz::Hertz;
pub use memory::Bytes;
pub use printed::condenses_printed;
pub use probe::{Probe, Quantity, check_points};
pub use range::{beyond_range, locking};
pub use request::Request;
pub use side_by_side::side_by_side;
pub use solution::{
    Choice, Cycle, Detail, Equilibrium, Other, Path, Published, Solution, Start, Step, StepBounds,
    Unilateral, Uniqueness, last_under_each_load, max_displacement,
};
pub use solve::{check, check_memory, equilibrium, solve};
pub use sparse::dense_matrices;
pub use stiffness::Stiffness;
pub use summary::{BodySummary, summaries};
