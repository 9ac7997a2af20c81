//! Studies: what many runs, or a run beside another code, tell.

pub mod audit;
pub mod benchmark;
pub mod calculix;
pub mod extremes;
pub mod plan;
pub mod trade;
