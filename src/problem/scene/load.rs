//! The load, consistent with linear edges.

use std::collections::{BTreeMap, HashMap};

use nalgebra::DVector;

use super::description::Load;
use super::groups::{GroupRef, Groups};
use super::mesh::Mesh;
use crate::model::{Force, Model, NodeId, Sides};
use base::error::{InputError, Result};
use base::memory;
use numbers::scalar::Scalar;

/// Returns the forces that each stage adds on all 2R degrees of freedom, restrained ones included,
/// force. There is at least one stage.
///
/// # Errors
/// No load belongs to a stage before the last one; and the errors of [`forces`].
pub fn stages(
    mesh: &Mesh,
    groups: &Groups,
    model: &Model,
    loads: &[Load],
) -> Result<Vec<DVector<f64>>> {
    let mut stages: BTreeMap<usize, Vec<(usize, &Load)>> = BTreeMap::new();
    for (k, load) in loads.iter().enumerate() {
        stages.entry(load.stage.unwrap_or(1)).or_default().push((k, load));
    }
    let last = stages.keys().next_back().copied().unwrap_or(1);
    if let Some(of_stage_0) = stages.get(&0) {
        let place = format!("loads[{}].stage", of_stage_0[0].0);
        return Err(InputError::new(place, "stages count from 1", "give 1 or more"));
    }
    if let Some(k) = (1..=loads.len().min(last)).find(|k| !stages.contains_key(k)) {
        let what = format!("no load has stage {k}, but one has stage {last}");
        let fix = "number the stages 1, 2, ... without a gap";
        return Err(InputError::new("loads", what, fix));
    }
    let whose = format!("{} stages of the load", stages.len());
    let bytes = (stages.len() * model.dofs() * size_of::<f64>()) as f64;
    memory::check_bytes(bytes, "loads", &whose, "give fewer stages")?;
    if stages.is_empty() {
        return Ok(vec![DVector::zeros(model.dofs())]);
    }
    let forces = stages.into_values().map(|own| forces(mesh, groups, model, own.into_iter()));
    forces.map(|forces| Ok(forces?.1)).collect()
}

/// Returns the parts of `loads`, each with its place in the scene file, and what they come to in
/// `f64` on all 2R degrees of freedom, restrained ones included, force.
///
/// # Errors
/// A load has another form, its edge bounds no triangle or two, or a number is not finite.
pub fn forces<'a>(
    mesh: &Mesh,
    groups: &Groups,
    model: &Model,
    loads: impl Iterator<Item = (usize, &'a Load)> + Clone,
) -> Result<(Vec<Force>, DVector<f64>)> {
    let (mut forces, mut f) = (Vec::new(), DVector::zeros(model.dofs()));
    let count: usize = loads.clone().map(|(_, load)| count(groups, load)).sum();
    let whose = format!("the {count} edges and nodes that are loaded");
    let fix = "give fewer loads, or groups of fewer edges";
    memory::check_bytes((2 * count * size_of::<Force>()) as f64, "loads", &whose, fix)?;
    for (k, load) in loads {
        let place = format!("loads[{k}]");
        let own = parts((mesh, groups, &model.sides), load, &place)?;
        own.iter().for_each(|force| force.add_to(&mut f, model, &|x| x));
        let dofs = own.iter().flat_map(Force::nodes).flat_map(|node| node.dofs());
        if dofs.into_iter().any(|dof| !f[dof.index()].is_finite()) {
            let what = "the load is too large to represent";
            return Err(InputError::new(place, what, "choose other units"));
        }
        forces.extend(own);
    }
    Ok((forces, f))
}

/// Returns the number of parts that a load has.
fn count(groups: &Groups, load: &Load) -> usize {
    let edges = load.on.as_ref().and_then(|on| groups.places(1, on, "").ok());
    edges.map_or(1, <[u32]>::len)
}

/// Returns the parts of one load: one for its node, or for each of its edges.
fn parts(at: (&Mesh, &Groups, &Sides), load: &Load, place: &str) -> Result<Vec<Force>> {
    match load {
        Load {
            node: Some(n),
            force: Some(force),
            on: None,
            pressure: None,
            traction: None,
            ..
        } => {
            at.0.check_node(*n, &format!("{place}.node"))?;
            Ok(vec![Force::Node(NodeId::from_number(*n), *force)])
        }
        Load {
            on: Some(on), pressure: Some(p), traction: None, node: None, force: None, ..
        } => on_edges(at, on, place, |edge| Force::Pressure(edge, *p)),
        Load {
            on: Some(on), traction: Some(t), pressure: None, node: None, force: None, ..
        } => on_edges(at, on, place, |edge| Force::Traction(edge, *t)),
        _ => {
            let what = "a load is {on, pressure}, {on, traction} or {node, force}";
            Err(InputError::new(place, what, "give exactly one of the three pairs"))
        }
    }
}

/// Returns the `part` of each edge of a group; it receives the edge with the body on its left.
fn on_edges(
    (mesh, groups, sides): (&Mesh, &Groups, &Sides),
    on: &GroupRef,
    place: &str,
    part: impl Fn([NodeId; 2]) -> Force,
) -> Result<Vec<Force>> {
    let edges = groups.members(1, on, &format!("{place}.on"))?;
    let (mut loaded, mut parts) = (HashMap::new(), Vec::new());
    for edge in edges {
        let [a, b] = [edge.nodes[0], edge.nodes[1]];
        if let Some(first) = loaded.insert([a.min(b), a.max(b)], edge.number) {
            let what = format!(
                "edges {first} and {} of group {on} are the same (nodes {a} and {b})",
                edge.number
            );
            return Err(InputError::new(place, what, "keep one: the load would count twice"));
        }
        let third = third_node(sides, [a, b], edge.number, place)?;
        let inside = f64::orientation(mesh.xy(a), mesh.xy(b), mesh.xy(third)) > 0.0;
        let edge = if inside { [a, b] } else { [b, a] };
        parts.push(part(edge.map(NodeId::from_number)));
    }
    Ok(parts)
}

/// Returns the node opposite the edge in the one triangle that it bounds.
fn third_node(sides: &Sides, [a, b]: [usize; 2], number: usize, place: &str) -> Result<usize> {
    match sides.beside([a, b].map(NodeId::from_number)) {
        [one] => Ok(one.third.number()),
        beside => {
            let what = format!(
                "edge {number} (nodes {a} and {b}) bounds {} triangles: a load needs an edge of \
                 exactly one",
                beside.len()
            );
            Err(InputError::new(place, what, "load an outer edge of a body"))
        }
    }
}
