//! The load vector, consistent for linear edges.

use std::collections::HashMap;

use nalgebra::DVector;

use super::description::Load;
use super::groups::{self, GroupRef};
use super::mesh::Mesh;
use crate::error::InputError;

/// Forces on all 2R equations, force; restrained equations included.
///
/// # Errors
/// A load that names no place or no value, or two; an edge of no triangle or of two; numbers that are not finite.
pub fn vector(mesh: &Mesh, loads: &[Load], thickness: f64) -> Result<DVector<f64>, InputError> {
    let mut f = DVector::zeros(2 * mesh.nodes.len());
    for (k, load) in loads.iter().enumerate() {
        let place = format!("loads[{k}]");
        match load {
            Load {
                node: Some(n),
                force: Some(force),
                on: None,
                pressure: None,
                traction: None,
            } => {
                mesh.check_node(*n, &place)?;
                add(&mut f, *n, *force);
            }
            Load { on: Some(on), pressure: Some(p), traction: None, node: None, force: None } => {
                on_edges(&mut f, mesh, on, thickness, &place, |inward| {
                    [p * inward[0], p * inward[1]]
                })?;
            }
            Load { on: Some(on), traction: Some(t), pressure: None, node: None, force: None } => {
                on_edges(&mut f, mesh, on, thickness, &place, |_| *t)?;
            }
            _ => {
                return Err(InputError::new(
                    place,
                    "a load is {on, pressure}, {on, traction} or {node, force}",
                    "give exactly one of the three pairs",
                ));
            }
        }
        if f.iter().any(|x| !x.is_finite()) {
            return Err(InputError::new(
                place,
                "the load is too large to represent",
                "choose other units",
            ));
        }
    }
    Ok(f)
}

/// For each edge of a triangle, its nodes ascending, the nodes across it.
type Across = HashMap<[usize; 2], Vec<usize>>;

fn across(mesh: &Mesh) -> Across {
    let mut across = Across::new();
    for triangle in mesh.of_dimension(2) {
        for k in 0..3 {
            let [a, b, third] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| triangle.nodes[k]);
            across.entry([a.min(b), a.max(b)]).or_default().push(third);
        }
    }
    across
}

/// Half of each edge's load on each of its nodes; `traction` is given the unit normal that points into the body.
fn on_edges(
    f: &mut DVector<f64>,
    mesh: &Mesh,
    on: &GroupRef,
    thickness: f64,
    place: &str,
    traction: impl Fn([f64; 2]) -> [f64; 2],
) -> Result<(), InputError> {
    let across = across(mesh);
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
        let third = third_node(&across, [a, b], edge.number, place)?;
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
    f[2 * node - 2] += force[0];
    f[2 * node - 1] += force[1];
}

/// The node across the edge in the one triangle that it bounds.
fn third_node(
    across: &Across,
    [a, b]: [usize; 2],
    number: usize,
    place: &str,
) -> Result<usize, InputError> {
    let thirds = across.get(&[a.min(b), a.max(b)]).map_or(&[][..], Vec::as_slice);
    match thirds {
        [third] => Ok(*third),
        _ => Err(InputError::new(
            place,
            format!(
                "edge {number} (nodes {a} and {b}) bounds {} triangles: a load needs an edge of exactly one",
                thirds.len()
            ),
            "load an outer edge of a body",
        )),
    }
}
