//! The problem: triangles, materials, restraints, loads and contact surfaces, and their files.

pub mod element;
pub mod model;
pub mod modelling;
pub mod scene;
pub mod tree;
