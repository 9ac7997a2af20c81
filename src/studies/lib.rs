//! Studies: what many runs show, or a run beside another code.
#![forbid(unsafe_code)]

pub mod audit;
pub mod benchmark;
pub mod calculix;
pub mod extremes;
pub mod lesson;
pub mod snapshot;
pub mod sweep;
pub mod trade;
