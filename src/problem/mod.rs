//! The problem: triangles, materials, restraints, loads and contact surfaces, and the files that
//! describe them.

pub mod element;
pub mod model;
pub mod modelling;
pub mod scene;
