//! The scene: the user's input, checked and turned into a [`Model`].
//!
//! ```text
//!  scene.json --file--> Description --+
//!  strand.msh --gmsh--> Mesh ---------+--> SceneBuilder --> Scene (checked): the Model, and the
//!  code --------------> both ---------+                     variant to be run
//! ```

mod builder;
mod check;
mod description;
mod embedded;
pub mod file;
pub mod gmsh;
mod groups;
mod load;
mod mesh;
mod orphans;
mod refine;
mod source;
pub mod surface;
pub mod symmetry;

use std::path::Path;
use std::sync::Arc;

use nalgebra::DVector;

pub use builder::SceneBuilder;
pub use description::{Axis, Contact, Description, Load, Material, Materials, Restraint, Units};
pub use embedded::{Embedded, FINDING_SCENES, SCENES};
pub use groups::GroupRef;
pub use mesh::{Element, Mesh, MeshBuilder, Node, PhysicalName};
pub use refine::Refined;
pub use surface::Surface;

use super::model::{self, Edge, EdgeId, Model, NodeId, Row, Sides, Triangle, TriangleId};
use super::modelling::{ContactModel, Variant};
use crate::error::{InputError, Result};

/// A scene that passed all checks.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name for folders and reports.
    pub name: String,
    /// The title of the scene for people.
    pub title: String,
    /// The unit names that are shown beside numbers.
    pub units: Units,
    /// The finite element model of the scene.
    pub model: Arc<Model>,
    /// The number of iterations of the variants that the paper describes.
    pub iterations: usize,
    /// The variant that is run unless the command line names another.
    pub variant: Variant,
    /// The model of contact beyond what the paper prints.
    pub contact: ContactModel,
    /// The numbers, in the mesh file, of the dropped nodes, which belong to no triangle.
    pub dropped: Vec<usize>,
    /// The description and mesh from which it was built; None for half a scene.
    source: Option<Arc<(Description, Mesh)>>,
}

impl Scene {
    /// Opens a scene by the name of an embedded scene, or by the path of its file or folder.
    ///
    /// # Errors
    /// The scene file, the mesh file, or the two together are at fault.
    pub fn open(name_or_path: &str) -> Result<Self> {
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
            let what = format!("the scene file cannot be read: {why}");
            let fix = format!("give a path, or one of the scenes {}", names.join(", "));
            InputError::new(path.display().to_string(), what, fix)
        })?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let beside = |file: &str| read_beside(&folder.join(file));
        Scene::build(&name_of(&path), &text, beside)
            .map_err(|error| error.within(&path.display().to_string()))
    }

    /// Builds a scene from the text of its file; `beside` reads a file in the scene file's folder.
    ///
    /// # Errors
    /// The scene file, the mesh file, or the two together are at fault.
    pub fn build(
        name: &str,
        text: &[u8],
        beside: impl Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Self> {
        SceneBuilder::read(name, text, beside)?.build()
    }

    /// Returns the description and the mesh from which the scene was built; None for half a scene.
    pub fn source(&self) -> Option<(&Description, &Mesh)> {
        self.source.as_deref().map(|(description, mesh)| (description, mesh))
    }

    fn assemble(name: &str, file: Description, mesh: &Mesh, dropped: Vec<usize>) -> Result<Self> {
        check::numbers(&file)?;
        let (materials, names) = check::materials(mesh, &file)?;
        let restrained = check::restraints(mesh, &file)?;
        let triangles: Vec<Triangle> = mesh
            .of_dimension(2)
            .zip(materials)
            .map(|(element, material)| Triangle { nodes: nodes(element), material })
            .collect();
        let edge = |edge: &Element| Edge { number: edge.number, nodes: nodes(edge) };
        let sides = Sides::new(triangles.iter().map(|triangle| triangle.nodes));
        let mut model = Model {
            plane: file.plane,
            thickness: file.thickness,
            nodes: mesh.nodes.iter().map(|node| [node.xyz[0], node.xyz[1]]).collect(),
            z: mesh.nodes[0].xyz[2],
            edges: mesh.of_dimension(1).map(edge).collect(),
            contact: check::contact(mesh, &file)?,
            forces: Vec::new(),
            load: DVector::zeros(2 * mesh.nodes.len()),
            stages: Vec::new(),
            bodies: model::bodies(mesh.nodes.len(), &triangles, &names),
            rows: rows(mesh),
            triangles,
            sides,
            restrained,
        };
        check::restrained_bodies(&model)?;
        (model.forces, model.load) = load::forces(mesh, &model, file.loads.iter().enumerate())?;
        model.stages = load::stages(mesh, &model, &file.loads)?;
        Ok(Scene {
            name: name.into(),
            title: file.title.clone(),
            units: file.units.clone(),
            model: Arc::new(model),
            iterations: file.iterations,
            variant: file.variant,
            contact: file.contact.as_ref().map_or(ContactModel::default(), |contact| {
                ContactModel {
                    coupling: contact.coupling,
                    friction: contact.friction,
                    geometry: contact.geometry,
                    load_steps: contact.load_steps,
                    status: contact.status,
                }
            }),
            dropped,
            source: Some(Arc::new((file, mesh.clone()))),
        })
    }
}

/// Returns the nodes of an element of the mesh, which has `N`.
fn nodes<const N: usize>(element: &Element) -> [NodeId; N] {
    std::array::from_fn(|k| NodeId::from_number(element.nodes[k]))
}

/// Returns the elements of the mesh file as rows of its table.
fn rows(mesh: &Mesh) -> Vec<Row> {
    let (mut edges, mut triangles) = (0.., 0..);
    let mut next = |element: &Element| match element.kind {
        1 => model::Element::Edge(EdgeId::new(edges.next().expect("there are numbers"))),
        2 => model::Element::Triangle(TriangleId::new(triangles.next().expect("as above"))),
        _ => model::Element::Point(NodeId::from_number(element.nodes[0])),
    };
    let row = |element: &Element| Row {
        number: element.number,
        physical: element.physical.first().copied().unwrap_or(0),
        geometric: element.geometric,
        element: next(element),
    };
    mesh.elements.iter().map(row).collect()
}

/// Reads an ordinary file; a device would never end.
fn read_beside(path: &Path) -> Result<Vec<u8>, String> {
    let metadata = std::fs::metadata(path).map_err(|why| why.to_string())?;
    if !metadata.is_file() {
        return Err("it is no ordinary file".into());
    }
    std::fs::read(path).map_err(|why| why.to_string())
}

/// Returns a scene's name: `strand` for `golden/strand/scene.json`, `plate` for `my/plate.json`.
fn name_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let folder = path.parent().and_then(Path::file_name).map(|f| f.to_string_lossy().into_owned());
    if stem == "scene" { folder.unwrap_or(stem) } else { stem }
}
