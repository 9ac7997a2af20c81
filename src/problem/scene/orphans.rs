//! Nodes that belong to no triangle, which are refused or dropped.

use super::description::Description;
use super::mesh::{Mesh, new_number};
use super::surface::Surface;
use crate::error::{InputError, Result};

/// Drops the nodes `dropped`, which belong to no triangle, where the description allows it, and
/// renumbers the nodes that the description names.
/// Errors: nodes may not be dropped, or the description names a dropped one.
pub fn drop(mesh: &Mesh, dropped: &[usize], description: &mut Description) -> Result<Mesh> {
    if !description.drop_orphans {
        let what = format!(
            "nodes {} belong to no triangle (finding K4: Km would be singular)",
            short_list(dropped)
        );
        let fix = "remove them, or set \"drop_orphans\": true";
        return Err(InputError::new("the mesh's nodes", what, fix));
    }
    let renumber = |n: &mut usize, place: &str| {
        mesh.check_node(*n, place)?;
        if dropped.binary_search(n).is_ok() {
            let what = format!("node {n} belongs to no triangle and was dropped");
            return Err(InputError::new(place, what, "name a node of a triangle"));
        }
        *n = new_number(*n, dropped);
        Ok(())
    };
    for (k, restraint) in description.restraints.iter_mut().enumerate() {
        if let Some(n) = &mut restraint.node {
            renumber(n, &format!("restraints[{k}].node"))?;
        }
    }
    for (k, load) in description.loads.iter_mut().enumerate() {
        if let Some(n) = &mut load.node {
            renumber(n, &format!("loads[{k}].node"))?;
        }
    }
    if let Some(Surface::Numbers(numbers)) = description.contact.as_mut().map(|c| &mut c.contact) {
        numbers.iter_mut().try_for_each(|n| renumber(n, "contact.cnt"))?;
    }
    Ok(mesh.without(dropped))
}

/// Returns at most ten numbers of a list, and how many more there are.
fn short_list(numbers: &[usize]) -> String {
    let shown: Vec<String> = numbers.iter().take(10).map(usize::to_string).collect();
    let more = numbers.len().saturating_sub(10);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    shown.join(", ") + &rest
}
