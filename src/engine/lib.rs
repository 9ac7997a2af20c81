//! The answer: a request, its solution, and the estimated errors of its numbers.
#![forbid(unsafe_code)]

mod assessment;
pub mod contact;
mod distance;
mod elimination;
mod equations;
pub mod error;
pub mod estimates;
mod fields;
pub mod held;
mod hertz;
pub mod linear;
pub mod options;
pub mod plan;
mod published;
pub mod quantities;
mod range;
mod reactions;
pub mod reduction;
mod request;
mod solution;
mod solve;
mod stiffness;
mod stretches;
mod unilateral;

pub use assessment::{Assessment, SolutionDistance};
pub use distance::{BodyDistance, Distance, distance, over};
pub use elimination::{Constraint, Elimination, Motion};
pub use hertz::Hertz;
pub use quantities::{
    BodySummary, ContactNode, IterationRow, NodeFields, Quantity, SupportForce, TriangleValues,
    summaries,
};
pub use range::{beyond_range, locking, locking_of};
pub use reactions::share_of_load;
pub use request::Request;
pub use solution::{
    Cycle, Detail, Equilibrium, Margin, NearestDecision, OtherEquilibrium, Overlap, Path, Solution,
    Start, Step, Unilateral, Uniqueness, last_under_each_load, max_displacement,
};
pub use solve::{check, solve};
pub use stiffness::Stiffness;
pub use stretches::{Resultant, Stretch, resultant, resultant_of_field, stretches};
pub use unilateral::{Implied, implied};
