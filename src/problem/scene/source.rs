//! The source of a scene file's mesh: a Gmsh file beside it, or its own tables.

use super::gmsh;
use super::mesh::Mesh;
use crate::error::{InputError, Result};

pub enum MeshSource {
    /// A Gmsh file beside the scene file, by its name.
    File(String),
    /// The paper's own tables: rows of `node`, rows of `elem`.
    Tables(Vec<[f64; 4]>, Vec<Vec<usize>>),
}

impl MeshSource {
    /// Returns the source that the fields `mesh`, `node` and `elem` of a scene file name.
    /// Errors: the fields name no source, or two.
    pub fn new(
        mesh: Option<String>,
        node: Option<Vec<[f64; 4]>>,
        elem: Option<Vec<Vec<usize>>>,
    ) -> Result<Self> {
        match (mesh, node, elem) {
            (Some(name), None, None) => Ok(MeshSource::File(name)),
            (None, Some(node), Some(elem)) => Ok(MeshSource::Tables(node, elem)),
            _ => Err(InputError::new(
                "fields mesh, node, elem",
                "the scene needs either mesh, or node and elem",
                "give \"mesh\": \"file.msh\", or the two tables",
            )),
        }
    }

    /// Reads the mesh; `beside` reads a file in the scene file's folder.
    /// Errors: the file cannot be read, or a row of a table has another form.
    pub fn read(&self, beside: impl Fn(&str) -> Result<Vec<u8>, String>) -> Result<Mesh> {
        let name = match self {
            MeshSource::Tables(node, elem) => return Mesh::from_tables(node, elem),
            MeshSource::File(name) => name,
        };
        let bytes = beside(name).map_err(|why| {
            let what = format!("the mesh file {name:?} cannot be read: {why}");
            InputError::new("field mesh", what, "the path is resolved beside the scene file")
        })?;
        gmsh::read(&bytes).map_err(|error| {
            let fix = "save the mesh again from Gmsh";
            InputError::new(format!("mesh {name:?}"), error.to_string(), fix)
        })
    }
}
