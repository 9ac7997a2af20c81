//! Nodes that belong to no triangle, which are refused or dropped.

use super::description::Description;
use super::mesh::Mesh;
use base::error::{InputError, Result};

/// Drops the nodes `dropped`, which belong to no triangle, with the points and edges on them. Every node
/// keeps its number.
///
/// # Errors
/// The description does not allow it, or names a dropped node.
pub fn drop(mesh: &mut Mesh, dropped: &[usize], description: &mut Description) -> Result<()> {
    if !description.drop_orphans {
        let named = mesh.named(dropped);
        let nodes = match dropped.len() {
            1 => format!("node {named} belongs"),
            _ => format!("nodes {named} belong"),
        };
        let what = format!("{nodes} to no triangle (finding K4: Km would be singular)");
        let fix =
            "remove what is in none (in Gmsh: Mesh.SaveAll = 0), or set \"drop_orphans\": true";
        return Err(InputError::new("the mesh's nodes", what, fix));
    }
    let is_dropped = |n: &usize| dropped.binary_search(n).is_ok();
    for (place, n) in description.named_nodes() {
        if is_dropped(n) {
            let what = format!("node {} belongs to no triangle and was dropped", mesh.named(&[*n]));
            return Err(InputError::new(place, what, "name a node of a triangle"));
        }
    }
    mesh.elements.retain(|element| !element.nodes.iter().any(is_dropped));
    Ok(())
}
