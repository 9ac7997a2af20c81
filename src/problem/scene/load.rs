//! The load vector, consistent with linear edges.

use std::collections::HashMap;

use nalgebra::DVector;

use super::description::Load;
use super::groups::{self, GroupRef};
use super::mesh::Mesh;
use crate::error::{InputError, Result};
use crate::problem::model::{NodeId, Sides};

/// Returns the forces that each stage adds on all 2R degrees of freedom, restrained ones included,
/// force. There is at least one stage.
/// Errors: no load belongs to a stage before the last one; and the errors of [`vector`].
pub fn stages(
    mesh: &Mesh,
    sides: &Sides,
    loads: &[Load],
    thickness: f64,
) -> Result<Vec<DVector<f64>>> {
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
        vector(mesh, sides, own, thickness)
    };
    (1..=last.min(loads.len() + 1)).map(of_stage).collect()
}

/// Returns the forces of `loads`, each with its place in the scene file, on all 2R degrees of
/// freedom, restrained ones included, force.
/// Errors: a load has another form, its edge bounds no triangle or two, or a number is not finite.
pub fn vector<'a>(
    mesh: &Mesh,
    sides: &Sides,
    loads: impl Iterator<Item = (usize, &'a Load)>,
    thickness: f64,
) -> Result<DVector<f64>> {
    let mut f = DVector::zeros(2 * mesh.nodes.len());
    for (k, load) in loads {
        let place = format!("loads[{k}]");
        match (&load.on, load.node, load.pressure, load.traction, load.force) {
            (None, Some(n), None, None, Some(force)) => {
                mesh.check_node(n, &place)?;
                add(&mut f, n, force);
            }
            (Some(on), None, Some(p), None, None) => {
                let along = |inward: [f64; 2]| inward.map(|component| p * component);
                on_edges(&mut f, (mesh, sides), on, thickness, &place, along)?;
            }
            (Some(on), None, None, Some(t), None) => {
                on_edges(&mut f, (mesh, sides), on, thickness, &place, |_| t)?;
            }
            _ => {
                let what = "a load is {on, pressure}, {on, traction} or {node, force}";
                return Err(InputError::new(place, what, "give exactly one of the three pairs"));
            }
        }
        if f.iter().any(|x| !x.is_finite()) {
            let what = "the load is too large to represent";
            return Err(InputError::new(place, what, "choose other units"));
        }
    }
    Ok(f)
}

/// Adds half of each edge's load to its nodes; `traction` receives the inward unit normal.
fn on_edges(
    f: &mut DVector<f64>,
    (mesh, sides): (&Mesh, &Sides),
    on: &GroupRef,
    thickness: f64,
    place: &str,
    traction: impl Fn([f64; 2]) -> [f64; 2],
) -> Result<()> {
    let mut loaded = HashMap::new();
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
        let ([ax, ay], [bx, by], [cx, cy]) = (mesh.xy(a), mesh.xy(b), mesh.xy(third));
        let length = (bx - ax).hypot(by - ay);
        let left = [-(by - ay) / length, (bx - ax) / length];
        let inside = left[0] * (cx - ax) + left[1] * (cy - ay) > 0.0;
        let inward = if inside { left } else { [-left[0], -left[1]] };
        let half = traction(inward).map(|t| t * length * thickness / 2.0);
        add(f, a, half);
        add(f, b, half);
    }
    Ok(())
}

fn add(f: &mut DVector<f64>, node: usize, force: [f64; 2]) {
    for (dof, force) in NodeId::from_number(node).dofs().into_iter().zip(force) {
        f[dof.index()] += force;
    }
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
