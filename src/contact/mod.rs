//! Contact: how the pairs that `c_cnt` finds enter the equations, and the iterations; and the converged answer beside them.

mod elimination;
mod pairing;
mod pressure;
mod published;
mod run;
mod stiffness;
mod summary;
mod support;
mod unilateral;
mod variant;

pub use elimination::{Elimination, Motion, Tie, interpolations, ties};
pub use pairing::{Coupling, Pairing, Surfaces};
pub use pressure::ContactNode;
pub use run::{Cycle, Iteration, Outcome, free_stiffness, max_displacement, run, run_in, shape};
pub use stiffness::Stiffness;
pub use summary::{BodySummary, summaries};
pub use variant::{Friction, Model, Variant};
