//! Contact: how the pairs that `c_cnt` finds enter the equations, and the iterations.

mod elimination;
mod run;
mod variant;

pub use elimination::{Elimination, Tie, ties};
pub use run::{Cycle, Iteration, Outcome, max_displacement, run};
pub use variant::{Coupling, Variant};
