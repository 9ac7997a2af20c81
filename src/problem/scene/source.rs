//! The mesh that a scene file names, without the nodes that belong to no triangle.

use super::file::{SceneFile, Surface};
use super::gmsh;
use super::mesh::{self, Mesh};
use crate::error::InputError;

/// Reads the mesh file that the scene names, or its own tables.
///
/// # Errors
/// Neither of the two, or both; a file that cannot be read.
pub fn read_mesh(
    file: &SceneFile,
    beside: impl Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Mesh, InputError> {
    match (&file.mesh, &file.node, &file.elem) {
        (Some(name), None, None) => {
            let bytes = beside(name).map_err(|why| {
                let what = format!("the mesh file {name:?} cannot be read: {why}");
                InputError::new("field mesh", what, "the path is resolved beside the scene file")
            })?;
            gmsh::read(&bytes).map_err(|error| {
                InputError::new(
                    format!("mesh {name:?}"),
                    error.to_string(),
                    "save the mesh again from Gmsh",
                )
            })
        }
        (None, Some(node), Some(elem)) => Mesh::from_tables(node, elem),
        _ => Err(InputError::new(
            "fields mesh, node, elem",
            "the scene needs either mesh, or node and elem",
            "give \"mesh\": \"file.msh\", or the two tables",
        )),
    }
}

/// Drops the nodes that belong to no triangle where the scene says so, else refuses them; the scene's node numbers follow.
///
/// # Errors
/// Nodes that may not be dropped; a scene that names a dropped one.
pub fn drop_orphans(
    mesh: Mesh,
    dropped: &[usize],
    file: &mut SceneFile,
) -> Result<Mesh, InputError> {
    if dropped.is_empty() {
        return Ok(mesh);
    }
    if !file.drop_orphans {
        let what = format!(
            "nodes {} belong to no triangle (finding K4: Km would be singular)",
            short_list(dropped)
        );
        let mend = "remove them, or set \"drop_orphans\": true";
        return Err(InputError::new("the mesh's nodes", what, mend));
    }
    let renumber = |n: &mut usize, place: &str| {
        mesh.check_node(*n, place)?;
        if dropped.binary_search(n).is_ok() {
            let what = format!("node {n} belongs to no triangle and was dropped");
            return Err(InputError::new(place, what, "name a node of a triangle"));
        }
        *n = mesh::new_number(*n, dropped);
        Ok(())
    };
    for (k, restraint) in file.restraints.iter_mut().enumerate() {
        restraint
            .node
            .as_mut()
            .map_or(Ok(()), |n| renumber(n, &format!("restraints[{k}].node")))?;
    }
    for (k, load) in file.loads.iter_mut().enumerate() {
        load.node.as_mut().map_or(Ok(()), |n| renumber(n, &format!("loads[{k}].node")))?;
    }
    if let Some(Surface::Numbers(numbers)) = file.contact.as_mut().map(|c| &mut c.cnt) {
        numbers.iter_mut().try_for_each(|n| renumber(n, "contact.cnt"))?;
    }
    Ok(mesh.without(dropped))
}

/// At most ten numbers of a list, and how many more there are.
fn short_list(numbers: &[usize]) -> String {
    let shown: Vec<String> = numbers.iter().take(10).map(usize::to_string).collect();
    let more = numbers.len().saturating_sub(10);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    shown.join(", ") + &rest
}
