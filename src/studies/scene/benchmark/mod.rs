//! Scenes of published benchmarks on structured meshes: the contact patch test, Hertz, a flat punch;
//! and the paper's example on a mesh of any size. Benchmarks without contact are made in `tests/benchmarks`.
//!
//! Meshes are made of rows of nodes, joined two by two by triangles; that of the strand by Delaunay
//! refinement. The same parameters lead to the same bytes.

mod blocks;
mod check;
mod confocal;
pub mod delaunay;
mod hertz;
mod line;
mod mirrored;
mod parameters;
mod punch;
mod rows;
mod strand;

pub use blocks::Blocks;
pub use hertz::Hertz;
pub use punch::Punch;
pub use strand::Strand;

use base::error::Result;
use problem::element::Plane;
use problem::modelling::{Coupling, Friction, Variant};
use problem::scene::{Contact, MeshBuilder, SceneBuilder};

/// A benchmark with its parameters.
#[derive(Clone, Debug, clap::Subcommand)]
#[expect(missing_docs, reason = "the parameters of each say what it is, and are its page of help")]
pub enum Kind {
    Blocks(Blocks),
    Hertz(Hertz),
    Punch(Punch),
    Strand(Strand),
}

impl Kind {
    /// Generates the scene; it has the kind's name.
    ///
    /// # Errors
    /// A parameter is out of its range.
    pub fn generate(&self) -> Result<SceneBuilder> {
        match self {
            Kind::Blocks(kind) => kind.generate(),
            Kind::Hertz(kind) => kind.generate(),
            Kind::Punch(kind) => kind.generate(),
            Kind::Strand(kind) => kind.generate(),
        }
    }
}

/// A scene that runs `unilateral`.
fn scene(name: &str, mesh: MeshBuilder, plane: Plane) -> SceneBuilder {
    SceneBuilder::new(name, mesh.finish(), plane).variant(Variant::Unilateral)
}

/// Frictionless contact of the group `contact` with the group `target`, bound by mortar weights.
fn frictionless() -> Contact {
    Contact {
        coupling: Some(Coupling::Mortar),
        friction: Some(Friction::NONE),
        ..Contact::new("contact", "target", 0.001)
    }
}
