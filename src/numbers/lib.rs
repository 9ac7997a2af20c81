//! Numbers: the scalar types that a run may be done in, the solvers of linear systems, the largest of
//! several values, and what is joined.
#![forbid(unsafe_code)]

pub mod joined;
pub mod largest;
pub mod scalar;
pub mod solve;
