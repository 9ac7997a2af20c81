//! Checks of a scene file against its mesh: materials, restraints, contact surfaces, bodies.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use super::description::Description;
use super::groups::Groups;
use super::mesh::{Element, Mesh};
use super::surface;
use crate::model::{self, Body, ContactSurfaces, EdgeId, Model, NodeId, Sides, TriangleId};
use crate::modelling::{check_iterations, check_tolerance};
use base::error::{InputError, Result};
use base::plain::six_digits;
use numbers::joined::joined;

/// Checks the thickness and the number of iterations.
///
/// # Errors
/// The thickness is not positive, or the number of iterations is 0 or too large.
pub fn numbers(file: &Description) -> Result<()> {
    if !(file.thickness > 0.0 && file.thickness.is_finite()) {
        let what = format!("the thickness {} is not positive", six_digits(file.thickness));
        return Err(InputError::new("field thickness", what, "give one above 0; the paper's is 1"));
    }
    check_iterations(file.iterations)
}

/// Returns the place of each triangle's material in the scene file, in the order of `EL`.
///
/// # Errors
/// A material is out of its range, a triangle has no material or two, or a group has no
/// triangle.
pub fn materials(mesh: &Mesh, groups: &Groups, file: &Description) -> Result<Vec<u32>> {
    let mut of_element: Vec<Option<u32>> = vec![None; mesh.elements.len()];
    for (k, (group, material)) in (0_u32..).zip(&file.materials.0) {
        let place = format!("materials.{}", group.text());
        if !(material.e > 0.0 && material.e.is_finite()) {
            let what = format!("E = {} is not positive", six_digits(material.e));
            let place = format!("{place}.E");
            return Err(InputError::new(place, what, "give an elastic modulus above 0"));
        }
        file.plane.check_poisson(material.nu, &format!("{place}.nu"))?;
        for member in groups.places(2, group, &place)? {
            if let Some(other) = of_element[*member as usize].replace(k) {
                let [other, name] = [other, k].map(|k| file.materials.0[k as usize].0.text());
                let number = mesh.elements[*member as usize].number;
                let what = format!("triangle {number} has two materials, {other} and {name}");
                let fix = "give a material to one of the two groups";
                return Err(InputError::new(place, what, fix));
            }
        }
    }
    let of_triangle = of_element.into_iter().zip(&mesh.elements).filter(|(_, e)| e.dim() == 2);
    let found = of_triangle.map(|(own, triangle)| {
        own.ok_or_else(|| {
            let (number, surface) = (triangle.number, mesh.whereabouts(triangle));
            let what = format!("triangle {number} has no material ({surface})");
            let how = groups.addition(2, &"body".into());
            let fix = format!("give each physical group of triangles a material{how}");
            InputError::new("materials", what, fix)
        })
    });
    found.collect()
}

/// Returns the two contact surfaces and their tolerance; empty where the scene has no contact.
///
/// # Errors
/// The tolerance is negative, the number of steps is 0 or too large, or the surfaces do not
/// exist or share a node.
pub fn contact(
    mesh: &Mesh,
    groups: &Groups,
    sides: &Sides,
    file: &Description,
) -> Result<ContactSurfaces> {
    let Some(contact) = &file.contact else { return Ok(ContactSurfaces::default()) };
    check_tolerance(contact.tolerance)?;
    contact.model().check()?;
    let nodes = surface::contact_nodes(mesh, groups, &contact.contact)?;
    let target = surface::target_edges(mesh, groups, &contact.target)?;
    let on_contact: HashSet<NodeId> = nodes.iter().copied().collect();
    let mut in_order = target.clone();
    in_order.sort_unstable_by_key(|edge| edge.number);
    for edge in in_order {
        let shared = edge.ids::<2>().into_iter().filter(|n| on_contact.contains(n));
        if let Some(n) = shared.clone().next() {
            let what = format!("contact node {n} is also on the target edge {}", edge.number);
            let fix = match shared.count() == 2 && sides.boundary(edge.ids()).is_some() {
                true => {
                    "that edge is in cnt and in trg: give the surface of each body a group of its own"
                }
                false => {
                    "let the two bodies share no node: mesh them apart, in Gmsh without Coherence and BooleanFragments"
                }
            };
            return Err(InputError::new("contact", what, fix));
        }
    }
    let edges: Vec<usize> = mesh.of_dimension(1).map(|edge| edge.number).collect();
    let id = |edge: &Element| EdgeId::new(edges.partition_point(|number| *number < edge.number));
    let target = target.into_iter().map(id).collect();
    Ok(ContactSurfaces { nodes, target, tolerance: contact.tolerance })
}

/// Checks that what an axis alone does not hold is no node of a contact surface.
///
/// # Errors
/// Names the restraint and the node.
pub fn holds(mesh: &Mesh, model: &Model) -> Result<()> {
    let surfaces = model.surface_nodes();
    let mut others = model.holds.iter().filter(|hold| hold.dof().is_none());
    others.find(|hold| surfaces.contains(&hold.node)).map_or(Ok(()), |hold| {
        let (node, name) = (mesh.named(&[hold.node.number()]), model.restraint_of(hold));
        let what = format!(
            "node {node} is on a contact surface, and {name} holds it along no axis, or at another displacement than 0"
        );
        let fix = "end the restraint beside the surface, or hold that node along x or y";
        Err(InputError::new("restraints", what, fix))
    })
}

/// Checks that restraints fix each body that no contact surface touches, and, taken as one, the
/// bodies that contact joins.
///
/// # Errors
/// A body can still move; the error says how.
pub fn restrained_bodies(model: &Model) -> Result<()> {
    let surfaces = model.surface_nodes();
    let (joined, alone): (Vec<&Body>, Vec<&Body>) =
        model.bodies.iter().partition(|body| body.nodes.iter().any(|n| surfaces.contains(n)));
    for body in alone {
        if let Some(freedom) = model::freedom(model, &body.nodes, &[]) {
            let what =
                format!("body {:?} is restrained by no contact and can still {freedom}", body.name);
            let fix = "restrain it, or give it a contact surface";
            return Err(InputError::new("restraints", what, fix));
        }
    }
    let nodes: Vec<NodeId> = joined.iter().flat_map(|body| body.nodes.iter().copied()).collect();
    if let Some(freedom) = model::freedom(model, &nodes, &[]).filter(|_| !joined.is_empty()) {
        let what = format!("the bodies that contact joins can still {freedom}, all together");
        return Err(InputError::new("restraints", what, "restrain one of them"));
    }
    hinged_parts(model, &surfaces)
}

/// Checks that no part of a body that no contact surface touches turns about the only node that joins it.
///
/// # Errors
/// Names the part, and that node.
fn hinged_parts(model: &Model, surfaces: &HashSet<NodeId>) -> Result<()> {
    let triangles = TriangleId::all(model.triangles.len());
    let beside = triangles.clone().flat_map(|id| {
        let first = |side| model.sides.beside(side)[0].triangle;
        model.triangle(id).sides().map(|side| (first(side).index(), id.index()))
    });
    let lowest = joined(model.triangles.len(), beside);
    let mut parts: BTreeMap<usize, BTreeSet<NodeId>> = BTreeMap::new();
    for (id, part) in triangles.zip(lowest) {
        parts.entry(part).or_default().extend(model.triangle(id).nodes);
    }
    let mut times = vec![0; model.nodes.len()];
    parts.values().flatten().for_each(|node| times[node.index()] += 1);
    for nodes in parts.values().filter(|nodes| nodes.iter().all(|n| !surfaces.contains(n))) {
        let nodes: Vec<NodeId> = nodes.iter().copied().collect();
        let joints: Vec<NodeId> = nodes.iter().copied().filter(|n| times[n.index()] > 1).collect();
        if let [joint] = joints[..]
            && model::freedom(model, &nodes, &joints).is_some()
        {
            let other = nodes.iter().find(|node| **node != joint).expect("a triangle has three");
            let body = model.body_of(joint).map_or("", |body| &body.name);
            let what = format!(
                "the part of body {body:?} at node {other} hangs on node {joint} alone, and turns about it"
            );
            let fix = "join it along an edge, restrain it at a second node, or leave it out";
            return Err(InputError::new("mesh, restraints", what, fix));
        }
    }
    Ok(())
}
