//! Contact: how the pairs that `c_cnt` finds enter the equations, and the iterations; and the converged answer beside them.

mod distance;
mod elimination;
mod hertz;
mod nearest;
mod operations;
mod outcome;
mod pairing;
mod pressure;
mod published;
mod run;
mod sparse;
mod status;
mod stiffness;
mod summary;
mod support;
mod task;
mod unilateral;
mod variant;

pub use distance::{BodyDistance, Distance, distance, reference};
pub use elimination::{Elimination, Motion, Tie, interpolations, ties};
pub use hertz::Hertz;
pub use nearest::{Foot, TargetSurface};
pub use operations::Operations;
pub use outcome::{Cycle, Iteration, Outcome, free_stiffness, max_displacement, shape};
pub use pairing::{Pairing, Surfaces};
pub use pressure::ContactNode;
pub use run::{run, run_in};
pub use sparse::dense_matrices;
pub use status::{Statuses, pairs, statuses};
pub use stiffness::Stiffness;
pub use summary::{BodySummary, summaries};
pub use variant::schedule;
