//! Node to segment: the point closest to each contact node on the nearest target edge.
//!
//! The normal turns along an edge from the mean normal at its first node to that at its second.
//! Otherwise a node that comes to rest at a bend of a curved target would alternate between the two
//! edges without end.
//!
//! Past the surface's end a node rests on the last edge's line as far as [`HANGING`], even with a
//! closed gap. Otherwise a node there would be released because it is closed, and closed again
//! because it then penetrates, without end.

use std::collections::{HashMap, HashSet};

use super::pairing::{Pairing, Vector, unit};
use super::search::{Closest, closest, dot};
use super::surface::{Placed, Surfaces};
use crate::problem::model::NodeId;

/// How far past an edge's end a closest point still counts as on it, over its length: rounding.
const ROUNDING: f64 = 1e-9;

/// The cosine of the angle between two edges beyond which they meet in a corner, not in a bend of a
/// smooth surface: 30 degrees.
const BEND: f64 = 0.866;

/// How far past the end of the surface a node still rests on it, over the last edge's length: the
/// same tolerance as mortar's. Edges that lie flush slide by their strain.
const HANGING: f64 = 0.05;

/// Returns, for each entry of the contact surface, its closest point on the nearest target edge.
pub(super) fn pairings(surfaces: &Surfaces, shape: &[Vector]) -> Vec<Option<Pairing>> {
    let target: Vec<Placed> = surfaces.target.iter().map(|edge| edge.place(shape)).collect();
    let segments = surfaces.segments(shape);
    let normals = normals(surfaces, &target);
    let free = surfaces.free_ends();
    let mut listed = HashSet::new();
    let pairing = |(&node, length): (&NodeId, f64)| {
        let p = shape[node.index()];
        let facing = segments.iter().enumerate().filter(|(k, _)| surfaces.face(node, *k));
        let rests = |k: usize, closest: &Closest<f64>| rests(closest, free[k]);
        let (k, _) = closest(facing, p, rests).filter(|_| listed.insert(node))?;
        let (edge, placed) = (&surfaces.target[k], &target[k]);
        let xi = placed.along(p).clamp(0.0, 1.0);
        let [a, b] = normals[k];
        let normal = unit([0, 1].map(|d| (1.0 - xi) * a[d] + xi * b[d]));
        let masters = vec![(edge.nodes[0], 1.0 - xi), (edge.nodes[1], xi)];
        let gap = placed.outside(p) * dot(normal, placed.normal);
        let edge = edge.id.expect("a target edge is one of the model's");
        Some(Pairing { node, edge, masters, normal, gap, length })
    };
    surfaces.nodes.iter().zip(surfaces.tributary(shape)).map(pairing).collect()
}

/// Returns whether a node rests on the edge of this closest point; `free` marks the ends of the
/// edge that end the surface. It does not rest where it has passed the edge's end: where it lies
/// further past the end than away from the edge's line, and further than that end allows.
fn rests(closest: &Closest<f64>, free: [bool; 2]) -> bool {
    let past = closest.past();
    past <= closest.side.abs() / closest.square
        || past <= if free[closest.end()] { HANGING } else { ROUNDING }
}

/// Returns the normals at the nodes of each target edge: the mean over edges that meet in a bend.
fn normals(surfaces: &Surfaces, target: &[Placed]) -> Vec<[Vector; 2]> {
    let mut at_node: HashMap<NodeId, Vec<usize>> = HashMap::new();
    for (k, edge) in surfaces.target.iter().enumerate() {
        edge.nodes.iter().for_each(|n| at_node.entry(*n).or_default().push(k));
    }
    let mean = |k: usize, node: NodeId| {
        let own = target[k].normal;
        let normals = at_node[&node].iter().map(|&other| target[other].normal);
        let bend = normals.filter(|normal| dot(*normal, own) > BEND);
        unit(bend.fold([0.0; 2], |sum, normal| [sum[0] + normal[0], sum[1] + normal[1]]))
    };
    let edges = surfaces.target.iter().enumerate();
    edges.map(|(k, edge)| edge.nodes.map(|node| mean(k, node))).collect()
}
