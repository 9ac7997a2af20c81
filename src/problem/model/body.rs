//! Bodies, which are the parts of a mesh that share no node.

use serde::Serialize;
use std::collections::{BTreeMap, HashMap, HashSet};

use super::Triangle;
use super::ids::{NodeId, TriangleId};
use numbers::joined::joined;

/// The most materials that the name of a body lists.
const MOST_NAMES: usize = 10;

/// A part of the mesh that shares no node with another part.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Body {
    /// The names of its materials, at most ten, joined by `+`; numbered where two bodies would share the
    /// name.
    pub name: String,
    /// The triangles of the body, ascending.
    pub triangles: Vec<TriangleId>,
    /// The nodes of the body, ascending.
    pub nodes: Vec<NodeId>,
}

impl Body {
    /// Returns whether `node` is one of its nodes.
    pub fn has(&self, node: NodeId) -> bool {
        self.nodes.binary_search(&node).is_ok()
    }
}

/// Returns the body of each of so many nodes, by its lowest one.
pub fn lowest(nodes: usize, triangles: impl Iterator<Item = [NodeId; 3]>) -> Vec<usize> {
    let sides = triangles.flat_map(|corners| {
        let [a, b, c] = corners.map(NodeId::index);
        [(a, b), (b, c)]
    });
    joined(nodes, sides)
}

/// Returns the bodies that `triangles` on `nodes` nodes form, by their lowest node. `material`
/// names the material of each triangle.
pub fn bodies<'a>(
    nodes: usize,
    triangles: &[Triangle],
    material: impl Fn(TriangleId) -> &'a str,
) -> Vec<Body> {
    let lowest = lowest(nodes, triangles.iter().map(|triangle| triangle.nodes));
    let mut bodies: BTreeMap<usize, Body> = BTreeMap::new();
    for (id, triangle) in TriangleId::all(triangles.len()).zip(triangles) {
        let body = bodies.entry(lowest[triangle.nodes[0].index()]).or_default();
        body.triangles.push(id);
    }
    for node in NodeId::all(nodes) {
        if let Some(body) = bodies.get_mut(&lowest[node.index()]) {
            body.nodes.push(node);
        }
    }
    let mut bodies: Vec<Body> = bodies.into_values().collect();
    for body in &mut bodies {
        let mut distinct = HashSet::new();
        let names = body.triangles.iter().map(|id| material(*id));
        let names: Vec<&str> = names.filter(|name| distinct.insert(*name)).collect();
        body.name = match names.len().saturating_sub(MOST_NAMES) {
            0 => names.join("+"),
            more => format!("{}+{more} more", names[..MOST_NAMES].join("+")),
        };
    }
    number_equal_names(&mut bodies);
    bodies
}

fn number_equal_names(bodies: &mut [Body]) {
    let mut counts: HashMap<String, [usize; 2]> = HashMap::new();
    bodies.iter().for_each(|body| counts.entry(body.name.clone()).or_default()[0] += 1);
    for body in bodies {
        let [count, before] = counts.get_mut(&body.name).expect("it was counted");
        if *count > 1 {
            *before += 1;
            body.name = format!("{} {before}", body.name);
        }
    }
}
