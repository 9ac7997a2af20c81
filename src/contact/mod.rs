//! Contact: how the pairs that `c_cnt` finds enter the equations, and the iterations.

mod elimination;
mod run;
mod summary;
mod variant;

pub use elimination::{Elimination, Tie, interpolations, ties};
pub use run::{Cycle, Iteration, Outcome, free_stiffness, max_displacement, run, shape};
pub use summary::{BodySummary, summaries};
pub use variant::{Coupling, Variant};
