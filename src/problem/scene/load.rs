//! The load, consistent with linear edges.

use std::collections::HashMap;

use nalgebra::DVector;

use super::description::Load;
use super::groups::{self, GroupRef};
use super::mesh::Mesh;
use crate::error::{InputError, Result};
use crate::numbers::scalar::Scalar;
use crate::problem::model::{Force, Model, NodeId, Sides};

/// Returns the forces that each stage adds on all 2R degrees of freedom, restrained ones included,
/// force. There is at least one stage.
///
/// # Errors
/// No load belongs to a stage before the last one; and the errors of [`forces`].
pub fn stages(mesh: &Mesh, model: &Model, loads: &[Load]) -> Result<Vec<DVector<f64>>> {
    if let Some(k) = loads.iter().position(|load| load.stage == Some(0)) {
        let what = "stages count from 1";
        return Err(InputError::new(format!("loads[{k}].stage"), what, "give 1 or more"));
    }
    let stage = |load: &Load| load.stage.unwrap_or(1);
    let last = loads.iter().map(stage).max().unwrap_or(1);
    let of_stage = |k: usize| {
        if !loads.is_empty() && loads.iter().all(|load| stage(load) != k) {
            let what = format!("no load has stage {k}, but one has stage {last}");
            let fix = "number the stages 1, 2, ... without a gap";
            return Err(InputError::new("loads", what, fix));
        }
        let own = loads.iter().enumerate().filter(|(_, load)| stage(load) == k);
        forces(mesh, model, own).map(|(_, f)| f)
    };
    (1..=last.min(loads.len() + 1)).map(of_stage).collect()
}

/// Returns the parts of `loads`, each with its place in the scene file, and what they come to in
/// `f64` on all 2R degrees of freedom,
/// restrained ones included, force.
///
/// # Errors
/// A load has another form, its edge bounds no triangle or two, or a number is not finite.
pub fn forces<'a>(
    mesh: &Mesh,
    model: &Model,
    loads: impl Iterator<Item = (usize, &'a Load)>,
) -> Result<(Vec<Force>, DVector<f64>)> {
    let (mut forces, mut f) = (Vec::new(), DVector::zeros(model.dofs()));
    for (k, load) in loads {
        let place = format!("loads[{k}]");
        let own = parts(mesh, &model.sides, load, &place)?;
        own.iter().for_each(|force| force.add_to(&mut f, model, &|x| x));
        if f.iter().any(|x| !x.is_finite()) {
            let what = "the load is too large to represent";
            return Err(InputError::new(place, what, "choose other units"));
        }
        forces.extend(own);
    }
    Ok((forces, f))
}

/// Returns the parts of one load: one for its node, or for each of its edges.
fn parts(mesh: &Mesh, sides: &Sides, load: &Load, place: &str) -> Result<Vec<Force>> {
    match load {
        Load {
            node: Some(n),
            force: Some(force),
            on: None,
            pressure: None,
            traction: None,
            ..
        } => {
            mesh.check_node(*n, &format!("{place}.node"))?;
            Ok(vec![Force::Node(NodeId::from_number(*n), *force)])
        }
        Load {
            on: Some(on), pressure: Some(p), traction: None, node: None, force: None, ..
        } => on_edges((mesh, sides), on, place, |edge| Force::Pressure(edge, *p)),
        Load {
            on: Some(on), traction: Some(t), pressure: None, node: None, force: None, ..
        } => on_edges((mesh, sides), on, place, |edge| Force::Traction(edge, *t)),
        _ => {
            let what = "a load is {on, pressure}, {on, traction} or {node, force}";
            Err(InputError::new(place, what, "give exactly one of the three pairs"))
        }
    }
}

/// Returns the `part` of each edge of a group; it receives the edge with the body on its left.
fn on_edges(
    (mesh, sides): (&Mesh, &Sides),
    on: &GroupRef,
    place: &str,
    part: impl Fn([NodeId; 2]) -> Force,
) -> Result<Vec<Force>> {
    let (mut loaded, mut parts) = (HashMap::new(), Vec::new());
    for edge in groups::members(mesh, 1, on, &format!("{place}.on"))? {
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
