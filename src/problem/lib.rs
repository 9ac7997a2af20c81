//! The problem: triangles, materials, restraints, loads and contact surfaces, and their files.
#![forbid(unsafe_code)]

pub mod element;
pub mod model;
#[cfg(feature = "scenes")]
pub mod modelling;
#[cfg(feature = "scenes")]
pub mod scene;
pub mod tree;
pub mod units;
