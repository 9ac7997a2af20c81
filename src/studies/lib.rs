//! Studies: what many runs show, or a run beside another code.
#![forbid(unsafe_code)]

pub mod audit;
pub mod benchmark;
pub mod calculix;
pub mod command;
pub mod document;
pub mod extremes;
pub mod field;
mod guide;
pub mod lesson;
mod listing;
mod scene;
pub mod snapshot;
mod solve;
pub mod sweep;
pub mod trade;
mod worksheet;
