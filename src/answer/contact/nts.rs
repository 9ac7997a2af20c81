//! Node to segment: the point closest to each contact node on the nearest target edge.
//!
//! The normal turns along an edge from the mean of the normals that meet at its first node to that
//! at its second: else a node that comes to rest at a bend of a curved target would jump between
//! its two edges for ever.
//!
//! Past the surface's end a node rests on the last edge's line as far as [`HANGING`], though its
//! gap be closed: else one that rests there would be let go because it is closed, and taken back
//! because it then penetrates, for ever.

use std::collections::{HashMap, HashSet};

use super::pairing::{Pairing, Vector, dot};
use super::search::{Closest, closest};
use super::surface::{Placed, Surfaces};
use crate::problem::model::NodeId;

/// How far beyond the end of an edge a closest point still counts as on it, of the edge's length:
/// rounding.
const ROUNDING: f64 = 1e-9;

/// Cosine of the angle between two edges beyond which they meet in a corner, not in a bend of a
/// smooth surface: 30 degrees.
const BEND: f64 = 0.866;

/// How far past the end of the surface a node still rests on it, of the last edge's length:
/// mortar's tolerance for a node off the target. Edges that lie flush slide by their strain.
const HANGING: f64 = 0.05;

/// For each entry of the contact surface its closest point on the nearest target edge.
pub(super) fn pairings(surfaces: &Surfaces, shape: &[Vector]) -> Vec<Option<Pairing>> {
    let target: Vec<Placed> = surfaces.target.iter().map(|edge| edge.place(shape)).collect();
    let segments = surfaces.segments(shape);
    let normals = normals(surfaces, &target);
    let free = surfaces.free_ends();
    let tributary = surfaces.tributary(shape);
    let mut listed = HashSet::new();
    let entries = surfaces.nodes.iter().zip(tributary);
    entries
        .map(|(&node, length)| {
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
        })
        .collect()
}

/// Whether a node rests on an edge whose closest point is this; `free`: which of the edge's ends
/// end the surface. It does not where it has passed the edge's end: where it lies further past the
/// end than away from the edge's line, and further than the rule for that end allows.
fn rests(closest: &Closest<f64>, free: [bool; 2]) -> bool {
    let past = closest.past();
    past <= closest.side.abs() / closest.square
        || past <= if free[closest.end()] { HANGING } else { ROUNDING }
}

/// The normals at the two nodes of each target edge: the mean over the edges that meet there, where
/// they meet in a bend.
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

fn unit(v: Vector) -> Vector {
    let size = v[0].hypot(v[1]);
    [v[0] / size, v[1] / size]
}
