//! The problem: triangles, materials, restraints, loads and contact surfaces, and their files.
#![forbid(unsafe_code)]

pub mod element;
pub mod model;
pub mod modelling;
pub mod scene;
pub mod tree;
