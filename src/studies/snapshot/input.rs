//! The input of a run: a scene's description and mesh, whole, each with its SHA-256.

use serde::{Deserialize, Serialize};

use base::error::{InputError, Result};
use problem::scene::{Description, Mesh, Scene, SceneBuilder, source_hashes};

/// A scene as a snapshot has it: from it alone the scene is built again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// The name of the scene.
    pub name: String,
    /// The SHA-256 of `scene`, as JSON without blanks in the order of this program's keys.
    pub scene_sha256: String,
    /// The SHA-256 of `mesh`, as JSON without blanks.
    pub mesh_sha256: String,
    /// The fields of the scene file, without those of its mesh.
    pub scene: Description,
    /// The mesh.
    pub mesh: Mesh,
}

impl Input {
    /// Returns the input of a scene.
    pub fn from_scene(scene: &Scene) -> Self {
        let (description, mesh) = scene.source();
        let [scene_sha256, mesh_sha256] = scene.hashes().clone();
        Input {
            name: scene.name.clone(),
            scene_sha256,
            mesh_sha256,
            scene: description.clone(),
            mesh: mesh.clone(),
        }
    }

    /// Builds the scene again.
    ///
    /// # Errors
    /// A hash is not that of what it stands for, or the scene is at fault.
    pub fn build(&self) -> Result<Scene> {
        let [scene, mesh] = source_hashes(&self.scene, &self.mesh);
        for (field, said, is) in
            [("scene", &self.scene_sha256, scene), ("mesh", &self.mesh_sha256, mesh)]
        {
            if *said != is {
                let what = format!(
                    "{field} was changed after it was recorded: its SHA-256 is {is}, and \
                     {field}_sha256 says {said}"
                );
                let fix = "undo the change; a changed scene is compared as a scene of its \
                           own, or recorded anew";
                return Err(InputError::new(format!("input.{field}"), what, fix));
            }
        }
        let (name, mesh, description) = (self.name.clone(), self.mesh.clone(), self.scene.clone());
        SceneBuilder { name, mesh, description }.build()
    }
}
