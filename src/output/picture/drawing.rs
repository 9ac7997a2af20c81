//! What the pictures of a mesh draw on.

use std::collections::BTreeMap;

use problem::model::{Force, Model, NodeId};
use problem::scene::Scene;

/// A mesh of more triangles is drawn as pixels, not as a shape per triangle.
pub const MOST_SHAPES: usize = 20_000;

/// A mesh with its bodies and its contact surfaces. Points, triangles and regions count from 0; all
/// coordinates are finite.
pub struct Drawing {
    /// The title, which says what was calculated.
    pub title: String,
    /// The coordinates x and y of each node, y upwards.
    pub points: Vec<[f64; 2]>,
    /// The corners of each triangle, as indices of points.
    pub triangles: Vec<[usize; 3]>,
    /// The region of each triangle: 0 is the block (the target), then the stamp and other bodies.
    pub region: Vec<usize>,
    /// The name of each region, by its number.
    pub region_names: Vec<String>,
    /// The unit of lengths, empty where the scene names none.
    pub length_unit: String,
    /// The surfaces that may touch, in a scene with contact.
    pub contact: Option<Contact>,
    /// The points that restraints hold, each with the direction along which it is held.
    pub held: Vec<(usize, [f64; 2])>,
    /// The points with a force on them, of loads of edges and nodes, force.
    pub loaded: Vec<(usize, [f64; 2])>,
}

/// The two surfaces that may touch.
pub struct Contact {
    /// The nodes of the contact surface (the stamp's) in order, as indices of points.
    pub nodes: Vec<usize>,
    /// The edges of the target surface (the block's), as pairs of indices of points.
    pub edges: Vec<[usize; 2]>,
}

impl Drawing {
    /// Collects what the pictures of a scene need.
    pub fn new(scene: &Scene, title: &str) -> Self {
        let model = &*scene.model;
        let target = model.target().unwrap_or(&model.bodies[0]);
        let others = model.bodies.iter().filter(|body| body.name != target.name);
        let mut region = vec![0; model.triangles.len()];
        let mut region_names = Vec::new();
        for (k, body) in std::iter::once(target).chain(others).enumerate() {
            region_names.push(body.name.clone());
            body.triangles.iter().for_each(|id| region[id.index()] = k);
        }
        Drawing {
            title: title.into(),
            points: points(model),
            triangles: model.triangles.iter().map(|t| t.nodes.map(NodeId::index)).collect(),
            region,
            region_names,
            length_unit: scene.units.length.clone(),
            held: model.holds.iter().map(|hold| (hold.node.index(), hold.direction)).collect(),
            loaded: loaded(model),
            contact: model.target().map(|_| Contact {
                nodes: model.contact.nodes.iter().map(|node| node.index()).collect(),
                edges: model.target_edges().map(|e| e.nodes.map(NodeId::index)).collect(),
            }),
        }
    }

    /// Returns whether the triangles are drawn as pixels.
    pub fn is_fine(&self) -> bool {
        self.triangles.len() > MOST_SHAPES
    }
}

/// Returns the sums of the forces on points, but for weights.
fn loaded(model: &Model) -> Vec<(usize, [f64; 2])> {
    let mut sums: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for force in model.forces.iter().filter(|force| !matches!(force, Force::Body(..))) {
        let [x, y] = force.on_each_node(model, &|x| x);
        for node in force.nodes() {
            let sum = sums.entry(node.index()).or_default();
            *sum = [sum[0] + x, sum[1] + y];
        }
    }
    sums.into_iter().filter(|(_, force)| *force != [0.0; 2]).collect()
}

/// Returns the points that are drawn: a dropped node, of which nothing is, stands at another one.
pub fn points(model: &Model) -> Vec<[f64; 2]> {
    let mut points = model.nodes.clone();
    let other = model.triangles[0].nodes[0];
    model.dropped.iter().for_each(|n| points[n.index()] = model.coordinates(other));
    points
}

/// Returns the edges that belong to one triangle only, rims of holes too, as indices of points.
pub fn boundary_edges(triangles: &[[usize; 3]]) -> Vec<[usize; 2]> {
    let ring = |&[a, b, c]: &[usize; 3]| [[a, b], [b, c], [c, a]];
    let mut edges: Vec<_> =
        triangles.iter().flat_map(ring).map(|[from, to]| [from.min(to), from.max(to)]).collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| same[0]).collect()
}
