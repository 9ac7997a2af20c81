//! The load vector, consistent for linear edges.

use nalgebra::DVector;

use super::file::{GroupRef, Load};
use super::groups;
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

/// Half of each edge's load on each of its nodes; `traction` is given the unit normal that points into the body.
fn on_edges(
    f: &mut DVector<f64>,
    mesh: &Mesh,
    on: &GroupRef,
    thickness: f64,
    place: &str,
    traction: impl Fn([f64; 2]) -> [f64; 2],
) -> Result<(), InputError> {
    for edge in groups::members(mesh, 1, on, &format!("{place}.on"))? {
        let [a, b] = [edge.nodes[0], edge.nodes[1]];
        let third = third_node(mesh, [a, b], edge.number, place)?;
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
    mesh: &Mesh,
    edge: [usize; 2],
    number: usize,
    place: &str,
) -> Result<usize, InputError> {
    let thirds: Vec<usize> = mesh
        .of_dimension(2)
        .filter(|t| edge.iter().all(|n| t.nodes.contains(n)))
        .filter_map(|t| t.nodes.iter().copied().find(|n| !edge.contains(n)))
        .collect();
    match thirds[..] {
        [third] => Ok(third),
        _ => Err(InputError::new(
            place,
            format!(
                "edge {number} (nodes {} and {}) bounds {} triangles: a load needs an edge of exactly one",
                edge[0],
                edge[1],
                thirds.len()
            ),
            "load an outer edge of a body",
        )),
    }
}
