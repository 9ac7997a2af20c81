//! The parts of a scene and a request: meshes, contact surfaces, and the closed sets of choices.

pub use engine::linear::{Arithmetic, Inputs, ScalarName, Solver};
pub use paper::mirror::Reading;
pub use problem::element::Plane;
pub use problem::modelling::{ContactModel, Coupling, Friction, Geometry, StatusRule, Variant};
pub use problem::scene::{Axis, Contact, Mesh, MeshBuilder};
