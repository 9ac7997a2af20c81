//! Numbers: the scalar types that a run may be done in, and the solvers of linear systems.

pub mod scalar;
pub mod solve;
