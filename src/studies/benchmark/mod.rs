//! Scenes of published benchmarks on structured meshes: contact patch tests, Hertz, a flat punch, Lamé, Kirsch, Cook, NAFEMS LE1.
//!
//! | kind | what is known |
//! |---|---|
//! | [`Blocks`], [`PunchPatch`] | one stress everywhere |
//! | [`Hertz`] | half width and peak pressure (NAFEMS CGS-1) |
//! | [`Punch`] | the pressure under a flat rigid punch |
//! | [`Annulus`], [`Hole`] | Lamé's and Kirsch's closed forms |
//! | [`Cook`], [`Ellipse`] | a displacement; a stress (NAFEMS LE1) |
//!
//! Every mesh is made of rows of nodes, joined two by two by triangles (`builder.rs`): the same parameters give the same bytes.

mod annulus;
mod blocks;
mod builder;
mod check;
mod confocal;
mod cook;
mod ellipse;
mod hertz;
mod hole;
mod line;
mod punch;
mod punch_patch;
mod text;

use std::path::Path;

pub use annulus::Annulus;
pub use blocks::Blocks;
pub use cook::Cook;
pub use ellipse::Ellipse;
pub use hertz::Hertz;
pub use hole::Hole;
pub use punch::Punch;
pub use punch_patch::PunchPatch;

use crate::error::InputError;
use crate::files;
use crate::problem::scene::{Mesh, Scene};

/// A benchmark with its parameters.
#[derive(Clone, Debug, clap::Subcommand)]
pub enum Kind {
    Blocks(Blocks),
    PunchPatch(PunchPatch),
    Hertz(Hertz),
    Punch(Punch),
    Annulus(Annulus),
    Hole(Hole),
    Cook(Cook),
    Ellipse(Ellipse),
}

impl Kind {
    /// Generates the benchmark.
    ///
    /// # Errors
    /// A parameter out of its range.
    pub fn generate(&self) -> Result<Benchmark, InputError> {
        match self {
            Kind::Blocks(kind) => kind.generate(),
            Kind::PunchPatch(kind) => kind.generate(),
            Kind::Hertz(kind) => kind.generate(),
            Kind::Punch(kind) => kind.generate(),
            Kind::Annulus(kind) => kind.generate(),
            Kind::Hole(kind) => kind.generate(),
            Kind::Cook(kind) => kind.generate(),
            Kind::Ellipse(kind) => kind.generate(),
        }
    }
}

/// A generated benchmark: a scene file and the mesh file that it names.
#[derive(Clone, Debug, PartialEq)]
pub struct Benchmark {
    /// Name of the kind; the mesh file is `<name>.msh`.
    pub name: &'static str,
    /// The mesh.
    pub mesh: Mesh,
    /// `scene.json`.
    pub scene: String,
    /// `<name>.msh`: Gmsh MSH 2.2, text.
    pub msh: String,
}

impl Benchmark {
    fn new(name: &'static str, mesh: Mesh, scene: serde_json::Value) -> Self {
        let msh = text::msh(&mesh);
        Benchmark { name, mesh, scene: text::scene(name, scene), msh }
    }

    /// The scene, without a file.
    ///
    /// # Errors
    /// Parameters that no scene allows, such as a Poisson's ratio of 0.5.
    pub fn scene(&self) -> Result<Scene, InputError> {
        let beside = |_: &str| Ok(self.msh.clone().into_bytes());
        Scene::build(self.name, self.scene.as_bytes(), beside)
    }

    /// Writes `scene.json` and the mesh file to `folder`, once the scene is known to be sound.
    ///
    /// # Errors
    /// As [`Benchmark::scene`]; a file that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), InputError> {
        self.scene()?;
        files::write(&folder.join(format!("{}.msh", self.name)), &self.msh)?;
        files::write(&folder.join("scene.json"), &self.scene)
    }
}
