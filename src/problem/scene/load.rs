//! The load, consistent with linear edges.

use std::collections::{BTreeSet, HashMap, HashSet};

use nalgebra::DVector;

use super::description::{Load, LoadKind};
use super::groups::{GroupRef, Groups};
use super::mesh::Mesh;
use crate::model::{CANCELLED, Force, Model, NodeId, Sides, unordered};
use base::error::{InputError, Result};
use base::limits;

/// Puts `loads` on the model: their parts, their sum, and what each stage adds. Returns the place of the load
/// of each part in the scene file.
///
/// # Errors
/// An edge of a load bounds no triangle or two, a number is not finite, or no load belongs to a stage
/// before the last one.
pub fn apply(
    mesh: &Mesh,
    groups: &Groups,
    model: &mut Model,
    loads: &[Load],
) -> Result<Vec<usize>> {
    let count = loads.iter().map(|load| match &load.kind {
        LoadKind::Force { .. } => 1,
        LoadKind::Pressure { on, .. } | LoadKind::Traction { on, .. } => {
            groups.places(1, on, "").map_or(1, <[u32]>::len)
        }
        LoadKind::Weight { on, .. } => groups.places(2, on, "").map_or(1, <[u32]>::len),
    });
    limits::LOADED.check(count.sum(), "loads")?;
    let (mut forces, mut total) = (Vec::new(), DVector::zeros(model.dofs()));
    for (k, load) in loads.iter().enumerate() {
        let place = format!("loads[{k}]");
        let own = match &load.kind {
            LoadKind::Force { node, force } => {
                vec![Force::Node(mesh.node(*node, &format!("{place}.node"))?, *force)]
            }
            LoadKind::Pressure { on, pressure } => {
                on_edges(groups, &model.sides, on, &place, |edge| Force::Pressure(edge, *pressure))?
            }
            LoadKind::Traction { on, traction } => {
                on_edges(groups, &model.sides, on, &place, |edge| Force::Traction(edge, *traction))?
            }
            LoadKind::Weight { on, rho, g } => {
                let triangles = groups.members(2, on, &format!("{place}.on"))?;
                let force = g.map(|g| rho * g);
                triangles.map(|own| Force::Body(own.ids(), force)).collect()
            }
        };
        add(&own, &mut total, model, k)?;
        forces.push(own);
    }
    // Restraints displace nodes in the first stage.
    let displaced = model.holds.displace().then_some(1);
    let numbers: BTreeSet<usize> =
        loads.iter().map(|load| load.stage.unwrap_or(1)).chain(displaced).collect();
    let last = numbers.last().copied().unwrap_or(1);
    if let Some(k) = loads.iter().position(|load| load.stage == Some(0)) {
        let place = format!("loads[{k}].stage");
        return Err(InputError::new(place, "stages count from 1", "give 1 or more"));
    }
    if let Some(k) = (1..=loads.len().min(last)).find(|k| !numbers.contains(k)) {
        let what = format!("no load has stage {k}, but one has stage {last}");
        let fix = "number the stages 1, 2, ... without a gap";
        return Err(InputError::new("loads", what, fix));
    }
    limits::STAGES.check(last * model.dofs(), "loads")?;
    let mut stages = vec![DVector::zeros(model.dofs()); last];
    for (k, (load, own)) in loads.iter().zip(&forces).enumerate() {
        add(own, &mut stages[load.stage.unwrap_or(1) - 1], model, k)?;
    }
    let of = forces.iter().enumerate().flat_map(|(k, own)| vec![k; own.len()]).collect();
    model.forces = forces.into_iter().flatten().collect();
    (model.load, model.stages) = (total, stages);
    drop_cancelled(model);
    Ok(of)
}

/// Sets the load to 0 where its parts cancel each other to rounding.
fn drop_cancelled(model: &mut Model) {
    let mut sizes = DVector::zeros(model.dofs());
    for force in &model.forces {
        let size = force.on_each_node(model, &|x| x).map(f64::abs);
        for dofs in force.nodes().map(NodeId::dofs) {
            dofs.into_iter().zip(size).for_each(|(dof, size)| sizes[dof.index()] += size);
        }
    }
    let is_left = |load: f64, size: f64| load.abs() > CANCELLED * size;
    model
        .load
        .zip_apply(&sizes, |load, size| *load = if is_left(*load, size) { *load } else { 0.0 });
}

/// Says which parts of loads restraints take alone, and which loads and restraints lie on edges of the
/// contact surfaces. `of` is the place of the load of each part.
pub fn in_vain(model: &Model, of: &[usize]) -> Vec<String> {
    let is_taken = |part: &Force| {
        let loaded = part.on_each_node(model, &|x| x).map(|force| force != 0.0);
        let takes = |node: NodeId| {
            let mut along = loaded.into_iter().zip(model.restraints_of(node));
            along.all(|(loaded, held)| held || !loaded)
        };
        // Supports carry some of a weight.
        let is_local = !matches!(part, Force::Body(..));
        is_local && loaded.contains(&true) && part.nodes().all(takes)
    };
    let surfaces: HashSet<[NodeId; 2]> = (model.target_edges().map(|edge| edge.nodes))
        .chain(model.contact.nodes.windows(2).map(|pair| [pair[0], pair[1]]))
        .map(unordered)
        .collect();
    let on_contact = |part: &Force| match *part {
        Force::Node(..) | Force::Body(..) => false,
        Force::Pressure(edge, _) | Force::Traction(edge, _) => surfaces.contains(&unordered(edge)),
    };
    let mut notes = Vec::new();
    let mut from = 0;
    for own in of.chunk_by(|a, b| a == b) {
        let (all, place) = (own.len(), format!("loads[{}]", own[0]));
        let parts = &model.forces[from..from + all];
        from += all;
        match parts.iter().filter(|part| is_taken(part)).count() {
            0 => {}
            taken => notes.push(format!(
                "{place}: restraints hold {taken} of its {all} edges or nodes along it, and take that part of it alone: it \
                 does nothing to the bodies"
            )),
        }
        match parts.iter().filter(|part| on_contact(part)).count() {
            0 => {}
            count => notes.push(format!(
                "{place}: {count} of its {all} edges belong to a contact surface: it acts there beside contact, also where \
                 the bodies touch"
            )),
        }
    }
    // A body that is held at all its nodes is rigid, as it is meant to be.
    let is_rigid = |node: NodeId| {
        model
            .body_of(node)
            .is_some_and(|body| body.nodes.iter().all(|n| model.holds.of(*n).len() == 2))
    };
    for (name, nodes) in model.restraints.iter().zip(model.held_nodes()) {
        let is_held = |edge: &&[NodeId; 2]| edge.iter().all(|end| nodes.contains(end));
        let count = surfaces.iter().filter(is_held).filter(|edge| !is_rigid(edge[0])).count();
        if count > 0 {
            notes.push(format!(
                "The restraint of {} holds {count} of the {} edges of the contact surfaces, and may take what contact \
                 presses there",
                name,
                surfaces.len()
            ));
        }
    }
    notes
}

/// Adds the parts `own` of load `k` to the forces `f`.
fn add(own: &[Force], f: &mut DVector<f64>, model: &Model, k: usize) -> Result<()> {
    own.iter().for_each(|force| force.add_to(f, model, &|x| x));
    let mut dofs = own.iter().flat_map(Force::nodes).flat_map(|node| node.dofs());
    if dofs.all(|dof| f[dof.index()].is_finite()) {
        return Ok(());
    }
    let what = "the load is too large to represent";
    Err(InputError::new(format!("loads[{k}]"), what, "choose other units"))
}

/// Returns the `part` of each edge of a group; it receives the edge with the body on its left.
fn on_edges(
    groups: &Groups,
    sides: &Sides,
    on: &GroupRef,
    place: &str,
    part: impl Fn([NodeId; 2]) -> Force,
) -> Result<Vec<Force>> {
    let edges = groups.members(1, on, &format!("{place}.on"))?;
    let (mut loaded, mut parts) = (HashMap::new(), Vec::new());
    for edge in edges {
        let [a, b] = edge.ids();
        if let Some(first) = loaded.insert(unordered([a, b]), edge.number) {
            let what = format!(
                "edges {first} and {} of group {on} are the same (nodes {a} and {b})",
                edge.number
            );
            return Err(InputError::new(place, what, "keep one: the load would count twice"));
        }
        let beside = sides.beside([a, b]);
        let [triangle] = beside else {
            let what = format!(
                "edge {} (nodes {a} and {b}) bounds {} triangles: a load needs an edge of exactly one",
                edge.number,
                beside.len()
            );
            return Err(InputError::new(place, what, "load an outer edge of a body"));
        };
        parts.push(part(triangle.nodes));
    }
    Ok(parts)
}
