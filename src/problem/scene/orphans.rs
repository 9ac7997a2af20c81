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
        let what = format!(
            "nodes {} belong to no triangle (finding K4: Km would be singular)",
            short_list(dropped)
        );
        let fix = "remove them (in Gmsh: Mesh.SaveAll = 0), or set \"drop_orphans\": true";
        return Err(InputError::new("the mesh's nodes", what, fix));
    }
    let is_dropped = |n: &usize| dropped.binary_search(n).is_ok();
    for (place, n) in description.named_nodes() {
        if is_dropped(n) {
            let what = format!("node {n} belongs to no triangle and was dropped");
            return Err(InputError::new(place, what, "name a node of a triangle"));
        }
    }
    mesh.elements.retain(|element| !element.nodes.iter().any(is_dropped));
    Ok(())
}

/// Returns at most ten numbers of a list, and how many more there are.
fn short_list(numbers: &[usize]) -> String {
    let shown: Vec<String> = numbers.iter().take(10).map(usize::to_string).collect();
    let more = numbers.len().saturating_sub(10);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    shown.join(", ") + &rest
}
