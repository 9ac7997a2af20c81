//! What the tests of several packages share: random scenes, tolerances, scenes that are changed.
//!
//! Random numbers come from a fixed seed, so that every run draws the same cases.
#![forbid(unsafe_code)]

pub mod draws;
pub mod golden_file;
pub mod page;
pub mod random;
pub mod same_text;
pub mod tolerances;

#[cfg(feature = "scenes")]
mod scenes;
#[cfg(feature = "scenes")]
pub use scenes::*;
