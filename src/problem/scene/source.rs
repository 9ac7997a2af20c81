//! The source of a scene file's mesh: a Gmsh file beside it, or its own tables.

use super::description::Description;
use super::gmsh::{self, Fault};
use super::mesh::Mesh;
use base::error::{InputError, Result};
use base::files::kind_of;
use base::limits;

/// Takes the mesh out of the fields `mesh`, `node` and `elem` of a scene file; `beside` reads a file
/// in the scene file's folder.
///
/// # Errors
/// The fields name no source, or two; the file cannot be read; a row of a table has another
/// form.
pub fn mesh(
    scene: &mut Description,
    beside: impl Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Mesh> {
    let name = match (scene.mesh.take(), scene.node.take(), scene.elements.take()) {
        (Some(name), None, None) => name,
        (None, Some(node), Some(elem)) => return Mesh::from_tables(&node, &elem),
        _ => {
            let what = "the scene needs either mesh, or node and elem";
            let fix = "give \"mesh\": \"file.msh\", or the two tables";
            return Err(InputError::new("fields mesh, node, elem", what, fix));
        }
    };
    let file = beside(&name).map_err(|why| {
        let what = format!("the mesh file {name:?} cannot be read: {why}");
        InputError::new(
            "field mesh",
            what,
            "the path is resolved beside the scene file, in its folder or below",
        )
    })?;
    let place = format!("mesh {name:?}");
    let numbers = file.iter().filter(|byte| byte.is_ascii_whitespace()).count();
    limits::MESH.check(numbers, &place)?;
    let mut mesh = gmsh::read(&file).map_err(|error| {
        let mut fix = "save the mesh again from Gmsh";
        let what = if let Fault::Unexpected { expected, .. } = &error.fault
            && expected.starts_with("$MeshFormat")
        {
            // A file that is no mesh may hold secrets of who runs the scene.
            fix = "save a mesh from Gmsh: gmsh part.geo -2 makes part.msh of the geometry part.geo";
            let but = kind_of(&file).map_or(String::new(), |found| format!(" but {found}"));
            format!("it is no mesh of Gmsh{but}: expected {expected}")
        } else {
            error.to_string()
        };
        InputError::new(&place, what, fix)
    })?;
    mesh.adapt(scene).map_err(|error| error.within(&place))?;
    Ok(mesh)
}
