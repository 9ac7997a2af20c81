//! The scene: what the user gives, checked, and turned into the paper's arrays.
//!
//! ```text
//!  scene.json --file--> Description --+
//!  strand.msh --gmsh--> Mesh ---------+--> SceneBuilder --> Scene (checked) --> Worksheet
//!  code --------------> both ---------+                                   (the paper's arrays)
//! ```

mod arrays;
mod body;
mod builder;
mod check;
mod description;
mod embedded;
mod file;
pub mod gmsh;
mod groups;
mod load;
mod mesh;
mod orphans;
mod refine;
mod source;
mod surface;
pub mod symmetry;

use std::path::Path;
use std::sync::Arc;

use nalgebra::DVector;

pub use body::Body;
pub use builder::SceneBuilder;
pub use description::{Axis, Contact, Description, Load, Material, Materials, Restraint, Units};
pub use embedded::{Embedded, FINDING_SCENES, SCENES};
pub use groups::GroupRef;
pub use mesh::{Element, Mesh, MeshBuilder, Node, PhysicalName};
pub use refine::Refined;
pub use surface::Surface;

use crate::error::InputError;
use crate::paper::mirror::{Reading, ToleranceUnit, Worksheet};
use crate::problem::modelling::{ContactModel, Variant};

/// A scene that is known to be sound.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name for folders and reports.
    pub name: String,
    /// A line for people.
    pub title: String,
    /// Unit names.
    pub units: Units,
    /// Number of iterations.
    pub iterations: usize,
    /// What is run unless the command line says otherwise.
    pub variant: Variant,
    /// How contact is modelled beyond what the paper prints.
    pub contact: ContactModel,
    /// Thickness across the plane, length.
    pub thickness: f64,
    /// Load on all 2R equations, restrained ones included, force.
    pub load: DVector<f64>,
    /// The bodies.
    pub bodies: Vec<Body>,
    /// Numbers, in the mesh file, of the nodes that were dropped because they belong to no triangle.
    pub dropped: Vec<usize>,
    /// The paper's arrays under the scene's own plane problem and length unit.
    sheet: Worksheet<f64>,
    /// What it was built from; nothing of half a scene.
    source: Option<Arc<(Description, Mesh)>>,
}

impl Scene {
    /// Opens a scene by embedded name, or by the path of its file or folder.
    ///
    /// # Errors
    /// Anything wrong with the scene file, the mesh file, or what they say together.
    pub fn open(name_or_path: &str) -> Result<Self, InputError> {
        let mut embedded = SCENES.iter().chain(FINDING_SCENES);
        if let Some(embedded) = embedded.find(|s| s.name == name_or_path) {
            let beside = |file: &str| {
                let found = embedded.files.iter().find(|(name, _)| *name == file);
                found.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| "not embedded".to_string())
            };
            return Scene::build(embedded.name, embedded.scene, beside);
        }
        let path = Path::new(name_or_path);
        let path = if path.is_dir() { path.join("scene.json") } else { path.to_path_buf() };
        let text = std::fs::read(&path).map_err(|why| {
            let names: Vec<&str> = SCENES.iter().map(|s| s.name).collect();
            InputError::new(
                path.display().to_string(),
                format!("the scene file cannot be read: {why}"),
                format!("give a path, or one of the scenes {}", names.join(", ")),
            )
        })?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let beside = |file: &str| read_beside(&folder.join(file));
        Scene::build(&name_of(&path), &text, beside)
            .map_err(|error| error.within(&path.display().to_string()))
    }

    /// Builds a scene from the text of its file; `beside` reads a file that lies beside it.
    ///
    /// # Errors
    /// Anything wrong with the scene file, the mesh file, or what they say together.
    pub fn build(
        name: &str,
        text: &[u8],
        beside: impl Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Self, InputError> {
        SceneBuilder::read(name, text, beside)?.build()
    }

    fn assemble(
        name: &str,
        file: Description,
        mesh: &Mesh,
        dropped: Vec<usize>,
    ) -> Result<Self, InputError> {
        let numbers = check::Numbers::check(&file)?;
        let (materials, material_names) = check::materials(mesh, &file)?;
        let restraints = check::restraints(mesh, &file)?;
        let bodies = body::find(mesh, &material_names);
        let (cnt, trg, c_tll) = check::contact(mesh, &file)?;
        let sheet = arrays::worksheet(mesh, numbers, &materials, restraints, (cnt, trg, c_tll));
        check::held(mesh, &bodies, &sheet)?;
        Ok(Scene {
            name: name.into(),
            load: load::vector(mesh, &file.loads, file.thickness)?,
            title: file.title.clone(),
            units: file.units.clone(),
            iterations: file.iterations,
            variant: file.variant,
            contact: file.contact.as_ref().map_or(ContactModel::default(), |contact| {
                ContactModel {
                    coupling: contact.coupling,
                    friction: contact.friction,
                    geometry: contact.geometry,
                    status: contact.status,
                }
            }),
            thickness: file.thickness,
            bodies,
            dropped,
            sheet,
            source: Some(Arc::new((file, mesh.clone()))),
        })
    }

    /// The paper's arrays under `reading`: R6 sets the plane problem, R8 the unit of c_tol.
    ///
    /// # Errors
    /// A Poisson's ratio that the plane problem of R6 does not allow.
    pub fn worksheet(&self, reading: &Reading) -> Result<Worksheet<f64>, InputError> {
        let mut sheet = self.sheet.clone();
        if let Some(plane) = reading.r6 {
            sheet.plane = plane;
            for nu in sheet.nu.iter() {
                check::poisson(*nu, plane, "--reading R6")?;
            }
        }
        if reading.r8 == ToleranceUnit::Metre {
            sheet.c_tll *= 1000.0;
        }
        Ok(sheet)
    }

    /// The paper's arrays under the scene's own plane problem and unit.
    pub(crate) fn sheet(&self) -> &Worksheet<f64> {
        &self.sheet
    }

    /// Puts another tolerance in place of the scene's own, length.
    pub fn set_c_tll(&mut self, c_tll: f64) {
        self.sheet.c_tll = c_tll;
    }

    /// The load on all 2R equations, 0 at restrained ones, force.
    pub fn free_load(&self) -> DVector<f64> {
        DVector::from_fn(self.load.len(), |e, _| match self.sheet.S[e + 1] {
            1 => 0.0,
            _ => self.load[e],
        })
    }

    /// Sum of the loads, force.
    pub fn total_load(&self) -> [f64; 2] {
        [0, 1].map(|direction| self.load.iter().skip(direction).step_by(2).sum())
    }

    /// The body that carries the target surface; none without contact.
    pub fn target(&self) -> Option<&Body> {
        let trg = self.sheet.trg.iter().next()?;
        self.body_of(self.sheet.elem[(*trg, 6)])
    }

    /// The body that has node `node`.
    pub fn body_of(&self, node: usize) -> Option<&Body> {
        self.bodies.iter().find(|body| body.nodes.binary_search(&node).is_ok())
    }
}

/// Reads an ordinary file: a device would never end.
fn read_beside(path: &Path) -> Result<Vec<u8>, String> {
    let metadata = std::fs::metadata(path).map_err(|why| why.to_string())?;
    if !metadata.is_file() {
        return Err("it is no ordinary file".into());
    }
    std::fs::read(path).map_err(|why| why.to_string())
}

/// `golden/strand/scene.json` is the scene `strand`, `my/plate.json` the scene `plate`.
fn name_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let folder = path.parent().and_then(Path::file_name).map(|f| f.to_string_lossy().into_owned());
    if stem == "scene" { folder.unwrap_or(stem) } else { stem }
}
