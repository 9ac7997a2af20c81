//! Studies: what many runs show, or a run beside another code.
#![forbid(unsafe_code)]

pub mod audit;
pub mod calculix;
pub mod command;
pub mod compare;
pub mod extremes;
mod guide;
pub mod lesson;
mod listing;
mod mathcad;
pub mod report;
mod scene;
pub mod snapshot;
mod solve;
pub mod sweep;
pub mod trade;

pub use scene::benchmark;
