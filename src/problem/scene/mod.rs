//! The scene: the user's input, checked and turned into a [`Model`].
//!
//! ```text
//!  scene.json --file--> Description --+
//!  strand.msh --gmsh--> Mesh ---------+--> SceneBuilder --> Scene (checked): the Model, and the
//!  code --------------> both ---------+                     variant to be run
//! ```

mod builder;
mod check;
mod derived;
mod description;
mod embedded;
pub mod file;
mod first;
mod fold;
pub mod gmsh;
mod groups;
mod hashes;
mod load;
mod mesh;
mod refine;
mod scene_file;
mod slit;
mod support;
pub mod surface;
pub mod symmetry;
mod units;

use serde::Serialize;
use std::path::Path;
use std::sync::Arc;

use nalgebra::DVector;

pub use builder::SceneBuilder;
pub use derived::Derived;
pub use description::{Axis, Contact, Description, Load, LoadKind, Materials, Restraint, Units};
pub use embedded::{Embedded, FINDING_SCENES, SCENES};
pub use file::schema;
pub use first::{FirstScene, first};
pub use groups::GroupRef;
use groups::Groups;
pub use hashes::{sha256, sha256_of, source_hashes};
pub use mesh::{Element, Mesh, MeshBuilder, Node, NodeNumbers, PhysicalName, Tags};
pub use scene_file::SceneFile;
pub use surface::Surface;

use super::model::{self, Edge, EdgeId, Model, NodeId, Row, Sides, Triangle, TriangleId};
use super::modelling::{ContactModel, Coupling, Variant};
use base::error::{InputError, Result};
use base::limits::check_steps;
use base::plain::{shell_word, six_digits};

/// A scene that passed all checks.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scene {
    /// The name for folders and reports.
    pub name: String,
    /// The word by which a command opens it: the name of an embedded scene, else its path as a shell takes
    /// it.
    #[serde(skip)]
    pub word: String,
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
    source: Arc<Source>,
}

/// What a scene was built from.
#[derive(Debug, PartialEq, Serialize)]
struct Source {
    description: Description,
    mesh: Mesh,
    /// What the mesh file has in another form, and where the mesh has slits, in sentences.
    notes: Vec<String>,
    /// Where the mesh has slits, which are among the notes.
    slits: Option<String>,
    /// The SHA-256 of both.
    hashes: [String; 2],
}

impl Scene {
    /// Opens a scene by the name of an embedded scene, by the path of its file or folder, or for `-`
    /// from standard input.
    ///
    /// # Errors
    /// The scene file, the mesh file, or the two together are at fault.
    pub fn open(name_or_path: impl AsRef<Path>) -> Result<Self> {
        Self::of_file(&SceneFile::read(name_or_path.as_ref())?)
    }

    /// Builds the scene of a file.
    ///
    /// # Errors
    /// The scene file, the mesh file, or the two together are at fault.
    pub fn of_file(file: &SceneFile) -> Result<Self> {
        let built = Scene::build(&file.name, &file.text, |beside| file.beside(beside));
        match file.path() {
            Some(place) => built
                .map(|scene| Scene { word: shell_word(place), ..scene })
                .map_err(|error| error.within(place)),
            None => built,
        }
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
        SceneBuilder::read(name, text, beside)?.into_scene()
    }

    /// Checks that a scene says how its surfaces rub, where its own variant asks for that.
    ///
    /// # Errors
    /// It says nothing of friction.
    pub fn check_friction(&self) -> Result<()> {
        let own = &self.source.description;
        let says = own.contact.as_ref().is_none_or(|contact| contact.friction.is_some());
        if says || own.variant() != Variant::Unilateral {
            return Ok(());
        }
        let what = "nothing is said of friction between the surfaces";
        let fix = "add \"friction\": 0, a coefficient such as \"friction\": 0.3, or \"friction\": \"stick\" \
                   (nothing slides) to the scene's contact";
        Err(InputError::new("contact.friction", what, fix))
    }

    /// Returns the description and the mesh from which the scene was built.
    pub fn source(&self) -> (&Description, &Mesh) {
        (&self.source.description, &self.source.mesh)
    }

    /// Returns the coupling under a variant: of a scene that names neither it nor a variant of the paper mortar under
    /// `unilateral`, as contact is asked for as it is, and that of `c_cnt` under the paper's.
    pub fn coupling(&self, variant: Variant) -> Coupling {
        let own = &self.source.description;
        let says = own.contact.as_ref().is_none_or(|contact| contact.coupling.is_some());
        let is_own = own.variant.is_none_or(|own| own == Variant::Unilateral);
        match variant {
            Variant::Unilateral if is_own && !says => Coupling::Mortar,
            Variant::Unilateral | Variant::Printed | Variant::Tied | Variant::Stepped => {
                self.contact.coupling
            }
        }
    }

    /// Says what the mesh file has in another form than the mesh here, where the mesh has slits, and what
    /// looks like a mistake of units, in sentences.
    pub fn adapted(&self) -> &[String] {
        &self.source.notes
    }

    /// Says where the mesh has slits, across which nothing is passed on; None where it has none.
    pub fn slits(&self) -> Option<&str> {
        self.source.slits.as_deref()
    }

    /// Returns the SHA-256 of the description and that of the mesh, each as a snapshot has it, as JSON
    /// without blanks.
    pub fn hashes(&self) -> &[String; 2] {
        &self.source.hashes
    }

    /// Returns the scene on a mesh that was made of its own, described anew.
    fn on(&self, description: Description, mesh: Mesh, dropped: Vec<NodeId>) -> Result<Self> {
        let scene = Scene::assemble(&self.name, description, mesh, dropped)?;
        let (word, contact) = (self.word.clone(), self.contact);
        Ok(Scene { word, contact, variant: self.variant, iterations: self.iterations, ..scene })
    }

    fn assemble(
        name: &str,
        description: Description,
        mesh: Mesh,
        dropped: Vec<NodeId>,
    ) -> Result<Self> {
        check::numbers(&description)?;
        let physical = Groups::new(&mesh);
        let materials = check::materials(&mesh, &physical, &description)?;
        let kinds = &description.materials.0;
        let groups: Vec<String> = kinds.iter().map(|(group, _)| group.text()).collect();
        let mut triangles = Vec::with_capacity(materials.len());
        triangles.extend(mesh.of_dimension(2).zip(&materials).map(|(element, kind)| Triangle {
            nodes: element.ids(),
            material: kinds[*kind as usize].1,
        }));
        let group = |id: TriangleId| &*groups[materials[id.index()] as usize];
        let edge = |edge: &Element| Edge { number: edge.number, nodes: edge.ids() };
        let sides = Sides::new(triangles.iter().map(|triangle| triangle.nodes));
        let (restraints, holds) =
            support::holds(&mesh, &physical, &sides, &dropped, &description.restraints)?;
        let mut model = Model {
            plane: description.plane,
            thickness: description.thickness,
            nodes: mesh.nodes.iter().map(|node| [node.xyz[0], node.xyz[1]]).collect(),
            z: mesh.nodes[0].xyz[2],
            edges: mesh.of_dimension(1).map(edge).collect(),
            contact: check::contact(&mesh, &physical, &sides, &description)?,
            forces: Vec::new(),
            load: DVector::zeros(0),
            stages: Vec::new(),
            bodies: model::bodies(mesh.nodes.len(), &triangles, group),
            rows: rows(&mesh),
            triangles,
            sides,
            holds,
            restraints,
            dropped,
        };
        check::holds(&mesh, &model)?;
        let slits = slit::slits(&mesh, &model);
        check::restrained_bodies(&model).map_err(|why| why.hinting(slits.as_deref()))?;
        fold::check(&mesh, &model)?;
        let load_of_part = load::apply(&mesh, &physical, &mut model, &description.loads)?;
        let in_vain = load::in_vain(&model, &load_of_part);
        let notes = slits.iter().cloned().chain(slit::loose_edges(&mesh, &model));
        let notes = notes.chain(wide_tolerance(&model)).chain(first::fine_contact(&model));
        let notes = notes.chain(units::misfit(&description.units));
        let notes = notes.chain(support::narrow(&mesh, &model)).chain(in_vain);
        let notes = notes.chain(first::not_facing(&mesh, &physical, &description));
        let notes = notes.chain(physical.without_triangles());
        let notes = mesh.adapted.iter().cloned().chain(notes).collect();
        let contact = description.contact.as_ref();
        let variant = description.variant();
        if variant != Variant::Unilateral {
            check_steps(description.iterations, mesh.nodes.len(), "iterations")?;
        }
        Ok(Scene {
            name: name.into(),
            word: name.into(),
            title: description.title.clone(),
            units: description.units.clone(),
            model: Arc::new(model),
            iterations: description.iterations,
            variant,
            contact: contact.map_or(ContactModel::default(), Contact::model),
            source: Arc::new(Source {
                hashes: source_hashes(&description, &mesh),
                notes,
                slits,
                description,
                mesh,
            }),
        })
    }
}

/// Says that the tolerance of the contact search is longer than the edges in which it searches, as where it
/// is in another unit.
fn wide_tolerance(model: &Model) -> Option<String> {
    let shortest = model.target_edges().map(|edge| model.length(edge.nodes)).reduce(f64::min)?;
    let tolerance = model.contact.tolerance;
    (tolerance > shortest).then(|| {
        format!(
            "c_tll = {} is longer than the shortest target edge, {}: the paper's variants tie nodes that are so far \
             apart; is it in the mesh's unit?",
            six_digits(tolerance),
            six_digits(shortest)
        )
    })
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
