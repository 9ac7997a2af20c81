//! Contact: how the pairs that `c_cnt` finds enter the equations, and the iterations.

mod elimination;
mod nearest;
mod operations;
mod run;
mod status;
mod summary;
mod variant;

pub use elimination::{Elimination, Tie, interpolations, ties};
pub use nearest::{Foot, TargetSurface};
pub use operations::Operations;
pub use run::{Cycle, Iteration, Outcome, free_stiffness, max_displacement, run, run_by, shape};
pub use status::{StatusRule, Statuses, pairs, statuses};
pub use summary::{BodySummary, summaries};
pub use variant::{Coupling, Variant};
