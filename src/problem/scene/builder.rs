//! Scenes in code: a mesh and its description.

use std::path::Path;

use super::description::{Axis, Contact, Description, Load, LoadKind, Restraint, Units};
use super::groups::GroupRef;
use super::mesh::Mesh;
use super::{Scene, file, gmsh};
use crate::element::Plane;
use crate::model::{Material, NodeId};
use crate::modelling::Variant;
use base::error::{InputError, Result};
use base::files;

/// A scene before it is checked, from code or from a scene file.
///
/// ```
/// use plane_contact_problem::element::Plane;
/// use plane_contact_problem::scene::{Axis, MeshBuilder, SceneBuilder};
///
/// let mut mesh = MeshBuilder::default();
/// let bottom = mesh.row([[0.0, 0.0], [1.0, 0.0]]);
/// let top = mesh.row([[0.0, 1.0], [1.0, 1.0]]);
/// mesh.join("block", &bottom, &top);
/// mesh.edges("bottom", &bottom);
/// mesh.edges("top", &top);
/// let scene = SceneBuilder::new("block", mesh.finish(), Plane::Strain)
///     .material("block", 30000.0, 0.2)
///     .restrain("bottom", &[Axis::X, Axis::Y])
///     .pressure("top", 6.3)
///     .build()?;
/// assert_eq!(scene.name, "block");
/// # Ok::<(), base::error::InputError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SceneBuilder {
    /// The name for folders and reports.
    pub name: String,
    /// The mesh of the scene.
    pub mesh: Mesh,
    /// The plane problem, materials, restraints, loads and contact on that mesh.
    pub description: Description,
}

impl SceneBuilder {
    /// Starts a plane problem on a mesh, with no material, restraint or load yet.
    pub fn new(name: impl Into<String>, mesh: Mesh, plane: Plane) -> Self {
        SceneBuilder { name: name.into(), mesh, description: Description::new(plane) }
    }

    /// Reads a scene file and its mesh; `beside` reads a file in the scene file's folder.
    ///
    /// # Errors
    /// The text of the scene file or of the mesh file is malformed.
    pub fn read(
        name: &str,
        text: &[u8],
        beside: impl Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Self> {
        let mut description = file::parse(text)?;
        let mesh = file::mesh(&mut description, beside)?;
        Ok(SceneBuilder { name: name.into(), mesh, description })
    }

    /// Sets the title for people.
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.description.title = title.into();
        self
    }

    /// Sets the thickness across the plane, length; it is 1 where it is not set.
    pub fn thickness(mut self, thickness: f64) -> Self {
        self.description.thickness = thickness;
        self
    }

    /// Sets the names of the units of length, stress and force.
    pub fn units(mut self, length: &str, stress: &str, force: &str) -> Self {
        let [length, stress, force] = [length, stress, force].map(String::from);
        self.description.units = Units { length, stress, force };
        self
    }

    /// Sets the material of a group of triangles: elastic modulus, stress, and Poisson's ratio.
    pub fn material(mut self, group: impl Into<GroupRef>, e: f64, nu: f64) -> Self {
        self.description.materials.0.push((group.into(), Material { e, nu }));
        self
    }

    /// Restrains all nodes of a group in the directions `fix`.
    pub fn restrain(self, group: impl Into<GroupRef>, fix: &[Axis]) -> Self {
        let on = Some(group.into());
        self.restraint(Restraint { on, fix: fix.to_vec(), ..Restraint::default() })
    }

    /// Restrains the node with number `node` in the directions `fix`.
    pub fn restrain_node(self, node: usize, fix: &[Axis]) -> Self {
        self.restraint(Restraint { node: Some(node), fix: fix.to_vec(), ..Restraint::default() })
    }

    /// Gives all nodes of a group a displacement along a direction, length.
    pub fn displace(self, group: impl Into<GroupRef>, along: Axis, by: f64) -> Self {
        let (on, fix, displacement) = (Some(group.into()), vec![along], vec![by]);
        self.restraint(Restraint { on, fix, displacement, ..Restraint::default() })
    }

    /// Adds a restraint of any kind.
    pub fn restraint(mut self, restraint: Restraint) -> Self {
        self.description.restraints.push(restraint);
        self
    }

    /// Loads a group of edges by a pressure that pushes into the body, stress.
    pub fn pressure(self, group: impl Into<GroupRef>, pressure: f64) -> Self {
        self.load(LoadKind::Pressure { on: group.into(), pressure })
    }

    /// Loads a group of edges by a force per area along x and y, stress.
    pub fn traction(self, group: impl Into<GroupRef>, traction: [f64; 2]) -> Self {
        self.load(LoadKind::Traction { on: group.into(), traction })
    }

    /// Loads the node with number `node` by a force along x and y, force.
    pub fn force(self, node: usize, force: [f64; 2]) -> Self {
        self.load(LoadKind::Force { node, force })
    }

    /// Adds the weight of a group of triangles: a density under an acceleration along x and y.
    pub fn weight(self, group: impl Into<GroupRef>, rho: f64, g: [f64; 2]) -> Self {
        self.load(LoadKind::Weight { on: group.into(), rho, g })
    }

    /// Puts the load that was added last into a stage of the path of the load, from 1.
    pub fn in_stage(mut self, stage: usize) -> Self {
        if let Some(load) = self.description.loads.last_mut() {
            load.stage = Some(stage);
        }
        self
    }

    /// Adds a load of any kind, in the first stage.
    pub fn load(mut self, kind: LoadKind) -> Self {
        self.description.loads.push(Load { kind, stage: None });
        self
    }

    /// Sets the contact surfaces, and how contact is modelled.
    pub fn contact(mut self, contact: Contact) -> Self {
        self.description.contact = Some(contact);
        self
    }

    /// Sets the number of iterations; it is the paper's 20 where it is not set.
    pub fn iterations(mut self, iterations: usize) -> Self {
        self.description.iterations = iterations;
        self
    }

    /// Sets the variant that is run unless the command line names another; it is `unilateral`
    /// where it is not set.
    pub fn variant(mut self, variant: Variant) -> Self {
        self.description.variant = Some(variant);
        self
    }

    /// Allows nodes that belong to no triangle to be dropped.
    pub fn drop_orphans(mut self) -> Self {
        self.description.drop_orphans = true;
        self
    }

    /// Checks the scene and builds it. Nodes that belong to no triangle are refused, or dropped with the
    /// points and edges on them; every node keeps its number.
    ///
    /// # Errors
    /// The mesh, the description, or the two together are at fault.
    pub fn build(&self) -> Result<Scene> {
        self.clone().into_scene()
    }

    /// Does the same, and lets go of the mesh.
    pub(super) fn into_scene(self) -> Result<Scene> {
        let SceneBuilder { name, mut mesh, mut description } = self;
        mesh.check()?;
        let dropped = mesh.orphans();
        let is_dropped = |n: &usize| dropped.binary_search(n).is_ok();
        if !dropped.is_empty() && !description.drop_orphans {
            let named = mesh.named(&dropped);
            let nodes = match dropped.len() {
                1 => format!("node {named} belongs"),
                _ => format!("nodes {named} belong"),
            };
            let what = format!("{nodes} to no triangle (finding K4: Km would be singular)");
            let fix =
                "remove what is in none (in Gmsh: Mesh.SaveAll = 0), or set \"drop_orphans\": true";
            return Err(InputError::new("the mesh's nodes", what, fix));
        }
        if let Some((place, n)) = description.named_nodes().into_iter().find(|(_, n)| is_dropped(n))
        {
            let what = format!("node {} belongs to no triangle and was dropped", mesh.named(&[*n]));
            return Err(InputError::new(place, what, "name a node of a triangle"));
        }
        mesh.elements.retain(|element| !element.nodes.iter().any(is_dropped));
        let dropped = dropped.into_iter().map(NodeId::from_number).collect();
        Scene::assemble(&name, description, mesh, dropped)
    }

    /// Checks the scene and writes it to `folder` as `scene.json` and a mesh file of its name.
    ///
    /// # Errors
    /// The errors of [`SceneBuilder::build`], or a file that cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        self.build()?;
        let mesh_file = format!("{}.msh", self.name);
        let mesh = gmsh::write(&self.mesh);
        let scene = file::write(&self.description, &mesh_file);
        files::write_all(folder, &[(&*mesh_file, mesh), ("scene.json", scene)])
    }
}
