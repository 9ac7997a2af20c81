//! What the tests of several packages share: random scenes, tolerances, scenes that are changed.
//!
//! Random numbers come from a fixed seed, so that every run draws the same cases.
#![forbid(unsafe_code)]

pub mod draws;
pub mod random;
pub mod tolerances;

#[cfg(feature = "scenes")]
pub mod annulus;
#[cfg(feature = "scenes")]
pub mod bodies;
#[cfg(feature = "scenes")]
pub mod drawn;
#[cfg(feature = "scenes")]
pub mod embedded;
#[cfg(feature = "scenes")]
pub mod golden;
#[cfg(feature = "scenes")]
pub mod golden_file;
#[cfg(feature = "scenes")]
pub mod golden_floats;
#[cfg(feature = "scenes")]
pub mod hard;
#[cfg(feature = "scenes")]
pub mod json;
#[cfg(feature = "scenes")]
pub mod recorded;
#[cfg(feature = "scenes")]
pub mod shipped;
#[cfg(feature = "scenes")]
pub mod statuses;
#[cfg(feature = "scenes")]
pub mod worksheets;
