//! Numbers: the scalar types that a run may be done in, the solvers of linear systems, and the largest
//! of several values.

pub mod largest;
pub mod scalar;
pub mod solve;
