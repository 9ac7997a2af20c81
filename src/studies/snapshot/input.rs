//! The input of a run: a scene's description and mesh, whole, each with its SHA-256.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::{InputError, Result};
use crate::problem::scene::{
    Description, Element, Mesh, Node, PhysicalName, Scene, SceneBuilder, Units, file, sha256,
};

/// A scene as a snapshot has it: from it alone the scene is built again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// The name of the scene.
    pub name: String,
    /// The SHA-256 of `scene`, as JSON without blanks.
    pub scene_sha256: String,
    /// The SHA-256 of `mesh`, as JSON without blanks.
    pub mesh_sha256: String,
    /// The fields of the scene file, without those of its mesh.
    #[schemars(with = "Description")]
    pub scene: serde_json::Value,
    pub mesh: Rows,
}

/// A row of an element: number, type, physical tags, geometric tag, nodes.
pub type ElementRow = (usize, usize, Vec<usize>, usize, Vec<usize>);

/// A mesh as rows of numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rows {
    /// The named physical groups: dimension, tag, name.
    pub groups: Vec<(usize, usize, String)>,
    /// The nodes: number, x, y, z.
    pub nodes: Vec<(usize, f64, f64, f64)>,
    /// The points, edges and triangles.
    pub elements: Vec<ElementRow>,
}

impl From<&Mesh> for Rows {
    fn from(mesh: &Mesh) -> Self {
        let node = |node: &Node| (node.number, node.xyz[0], node.xyz[1], node.xyz[2]);
        let element =
            |e: &Element| (e.number, e.kind, e.physical.to_vec(), e.geometric, e.nodes.to_vec());
        Rows {
            groups: mesh.names.iter().map(|n| (n.dim, n.tag, n.name.clone())).collect(),
            nodes: mesh.nodes.iter().map(node).collect(),
            elements: mesh.elements.iter().map(element).collect(),
        }
    }
}

impl Rows {
    fn mesh(&self) -> Mesh {
        let names = self.groups.iter().cloned();
        let elements = self.elements.iter().cloned();
        Mesh {
            names: names.map(|(dim, tag, name)| PhysicalName { dim, tag, name }).collect(),
            nodes: self
                .nodes
                .iter()
                .map(|&(number, x, y, z)| Node { number, xyz: [x, y, z] })
                .collect(),
            elements: elements
                .map(|(number, kind, physical, geometric, nodes)| Element {
                    number,
                    kind,
                    physical: physical.into(),
                    geometric,
                    nodes: nodes.into(),
                })
                .collect(),
        }
    }
}

impl Input {
    /// Returns the input of a scene.
    ///
    /// # Errors
    /// The scene is half of one, which no file describes.
    pub fn of(scene: &Scene) -> Result<Self> {
        let (description, mesh) = scene.source().ok_or_else(|| {
            InputError::new("the scene", "half a scene has no file", "write it to a file first")
        })?;
        let description: &Description = description;
        let scene_value = serde_json::to_value(description).expect("a description is an object");
        let [scene_sha256, mesh_sha256] = scene.hashes().expect("it has a source").clone();
        let mesh = Rows::from(mesh);
        Ok(Input { name: scene.name.clone(), scene_sha256, mesh_sha256, scene: scene_value, mesh })
    }

    /// Returns the names of the scene's units.
    pub fn units(&self) -> Units {
        Units::deserialize(&self.scene["units"]).unwrap_or_default()
    }

    /// Builds the scene again.
    ///
    /// # Errors
    /// A hash is not that of what it stands for, or the scene is at fault.
    pub fn build(&self) -> Result<Scene> {
        for (field, said, is) in [
            ("scene", &self.scene_sha256, sha256(&self.scene)),
            ("mesh", &self.mesh_sha256, sha256(&self.mesh)),
        ] {
            if *said != is {
                let what = format!(
                    "{field} was changed after it was recorded: its SHA-256 is {is}, and \
                     {field}_sha256 says {said}"
                );
                let fix = "undo the change; a changed scene is compared with --scene, or recorded \
                           anew";
                return Err(InputError::new(format!("input.{field}"), what, fix));
            }
        }
        let description = file::parse(self.scene.to_string().as_bytes())?;
        SceneBuilder { name: self.name.clone(), mesh: self.mesh.mesh(), description }.build()
    }
}
