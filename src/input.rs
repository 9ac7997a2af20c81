//! The parts of a scene and a request: meshes, contact surfaces, and the closed sets of choices.

pub use crate::numbers::solve::{Arithmetic, Inputs, ScalarName, Solver};
pub use crate::paper::mirror::Reading;
pub use crate::problem::element::Plane;
pub use crate::problem::modelling::{
    ContactModel, Coupling, Friction, Geometry, StatusRule, Variant,
};
pub use crate::problem::scene::{Axis, Contact, Mesh, MeshBuilder};
