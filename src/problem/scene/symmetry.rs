//! Half of a scene that is its own mirror image about a vertical line.
//!
//! Mesh, materials, restraints, loads and contact surfaces must be symmetric, and no triangle may
//! lie across the line. Then the solution is symmetric too, the line moves only along itself, and
//! the half right of it, restrained in x on the line, has the same solution.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::Arc;

use nalgebra::DVector;

use super::Scene;
use super::derived::Derived;
use crate::model::{
    Body, ContactSurfaces, Dof, Edge, EdgeId, Element, Force, Model, NodeId, Row, Sides, Triangle,
    TriangleId, unordered,
};

/// The largest distance of a node from its image, over the scene's size: meshes are rounded.
const PLACE: f64 = 1e-9;

/// The largest difference of a load from its image, over the largest load.
const LOAD: f64 = 1e-9;

/// Returns the half of `scene` right of the line; None where it is not symmetric about a vertical line.
pub fn half(scene: &Scene) -> Option<Derived> {
    let whole = &*scene.model;
    images(whole)?;
    let line = Line::of(whole);
    let right =
        |id: &TriangleId| whole.triangle(*id).nodes.iter().all(|node| line.side(*node) >= 0);
    let triangles: Vec<TriangleId> = whole.triangle_ids().filter(right).collect();
    let nodes: BTreeSet<NodeId> =
        triangles.iter().flat_map(|id| whole.triangle(*id).nodes).collect();
    let nodes: Vec<NodeId> = nodes.into_iter().collect();
    let scene = Scene {
        name: scene.name.clone(),
        word: scene.word.clone(),
        title: scene.title.clone(),
        units: scene.units.clone(),
        model: Arc::new(restricted(&line, &nodes, &triangles)),
        iterations: scene.iterations,
        variant: scene.variant,
        contact: scene.contact,
        friction_is_missing: scene.friction_is_missing,
        coupling_is_missing: scene.coupling_is_missing,
        source: None,
    };
    Some(Derived { scene, nodes: nodes.into_iter().map(|node| [node; 2]).collect(), triangles })
}

/// The only line about which a model may be symmetric.
struct Line<'a> {
    model: &'a Model,
    /// The x coordinate of the line, length.
    at: f64,
    /// The distance below which two places are the same, length.
    place: f64,
}

/// Returns where the only vertical line stands about which a model may be symmetric: its x, length.
pub fn line_of(model: &Model) -> f64 {
    model.bounds().centre()[0]
}

impl<'a> Line<'a> {
    fn of(model: &'a Model) -> Self {
        Line { model, at: line_of(model), place: PLACE * model.bounds().larger_side() }
    }

    /// Returns -1 for a node left of the line, 0 on it, 1 right of it.
    fn side(&self, node: NodeId) -> i32 {
        let x = self.model.coordinates(node)[0] - self.at;
        if x.abs() <= self.place { 0 } else { x.signum() as i32 }
    }
}

/// Returns the mirror image of each node; None where the model is not symmetric about a vertical line.
pub fn images(model: &Model) -> Option<Vec<NodeId>> {
    let line = Line::of(model);
    let Line { at, place, .. } = line;
    for triangle in &model.triangles {
        let sides = triangle.nodes.map(|node| line.side(node));
        if sides.contains(&1) && sides.contains(&-1) {
            return None;
        }
    }
    // The image of a node is looked up in the cells of a grid around its place.
    let cell = |x: f64| (x / (4.0 * place)).round() as i64;
    let mut cells: HashMap<[i64; 2], Vec<NodeId>> = HashMap::new();
    for n in model.node_ids().filter(|n| !model.is_dropped(*n)) {
        cells.entry(model.coordinates(n).map(cell)).or_default().push(n);
    }
    let body = |n: NodeId| model.bodies.iter().position(|b| b.has(n));
    let mut images = Vec::with_capacity(model.nodes.len());
    for n in model.node_ids() {
        if model.is_dropped(n) {
            images.push(n);
            continue;
        }
        let [nx, ny] = model.coordinates(n);
        let [x, y] = [cell(2.0 * at - nx), cell(ny)];
        let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [x + i, y + j]));
        let near = around.filter_map(|at| cells.get(&at)).flatten().copied();
        let is_there = |m: &NodeId| {
            let [mx, my] = model.coordinates(*m);
            (2.0 * at - nx - mx).hypot(ny - my) <= place
        };
        let found: Vec<NodeId> = near.filter(is_there).collect();
        // Where bodies touch, two nodes are at one place: a body on the line is its own image.
        images.push(match found.as_slice() {
            [one] => *one,
            several => several.iter().copied().find(|&m| body(m) == body(n))?,
        });
    }
    let image = |n: NodeId| images[n.index()];
    // Triangles, with their materials.
    let key = |mut nodes: [NodeId; 3], triangle: &Triangle| {
        nodes.sort_unstable();
        (nodes, triangle.material.e.to_bits(), triangle.material.nu.to_bits())
    };
    let triangles: HashSet<_> = model.triangles.iter().map(|t| key(t.nodes, t)).collect();
    // Contact surfaces.
    let contact: HashSet<NodeId> = model.contact.nodes.iter().copied().collect();
    let target: HashSet<[NodeId; 2]> =
        model.target_edges().map(|edge| unordered(edge.nodes)).collect();
    // Restraints and loads.
    let same_restraints = |n: NodeId| {
        let [[x, y], [mx, my]] = [n, image(n)].map(|n| n.dofs().map(|dof| model.holds.given(dof)));
        model.holds.oblique(n).is_none() && x == mx.map(|u| -u) && y == my
    };
    let same_load = |load: &DVector<f64>| {
        let near = LOAD * load.amax();
        model.node_ids().all(|n| {
            let ([nx, ny], [mx, my]) = (n.components(load), image(n).components(load));
            (nx + mx).abs() <= near && (ny - my).abs() <= near
        })
    };
    let is_symmetric = model.node_ids().all(|n| image(image(n)) == n)
        && model.triangles.iter().all(|t| triangles.contains(&key(t.nodes.map(image), t)))
        && contact.iter().all(|n| contact.contains(&image(*n)))
        && target.iter().all(|edge| target.contains(&unordered(edge.map(image))))
        && model.node_ids().all(same_restraints)
        && model.stages.iter().all(same_load);
    is_symmetric.then_some(images)
}

/// Returns the part of a model with these nodes and triangles; nodes on the line are restrained in x, and have half of
/// their load.
fn restricted(line: &Line, nodes: &[NodeId], triangles: &[TriangleId]) -> Model {
    let whole = line.model;
    let numbers: HashMap<NodeId, NodeId> =
        nodes.iter().copied().zip(NodeId::all(nodes.len())).collect();
    let number = |node: &NodeId| numbers.get(node).copied();
    let is_inside = |id: &EdgeId| whole.edge(*id).nodes.iter().all(|n| numbers.contains_key(n));
    let edges: Vec<EdgeId> = EdgeId::all(whole.edges.len()).filter(is_inside).collect();
    let edge_number = |id: &EdgeId| edges.binary_search(id).ok().map(EdgeId::new);
    let own_triangles: Vec<Triangle> = triangles
        .iter()
        .map(|id| {
            let triangle = whole.triangle(*id);
            Triangle { nodes: triangle.nodes.map(|node| numbers[&node]), ..*triangle }
        })
        .collect();
    let dofs = || nodes.iter().flat_map(|n| n.dofs());
    let on_line = |dof: Dof| line.side(dof.node()) == 0;
    let mut holds = whole.holds.renumbered(nodes.len(), |node| number(&node));
    let along = nodes.iter().filter(|node| line.side(**node) == 0);
    holds.fix(along.map(|node| numbers[node].x()));
    let own_part = |load: &DVector<f64>| {
        let half = |dof: Dof| match (on_line(dof), dof.direction()) {
            (true, 0) => 0.0,
            (true, _) => 0.5 * load[dof.index()],
            (false, _) => load[dof.index()],
        };
        DVector::from_iterator(2 * nodes.len(), dofs().map(half))
    };
    let triangle_number = |id: &TriangleId| triangles.binary_search(id).ok().map(TriangleId::new);
    let body = |body: &Body| Body {
        name: body.name.clone(),
        triangles: body.triangles.iter().filter_map(triangle_number).collect(),
        nodes: body.nodes.iter().filter_map(number).collect(),
    };
    let row = |row: &Row| {
        let element = match row.element {
            Element::Point(node) => Element::Point(number(&node)?),
            Element::Edge(id) => Element::Edge(edge_number(&id)?),
            Element::Triangle(id) => Element::Triangle(triangle_number(&id)?),
        };
        Some(Row { element, ..*row })
    };
    let load = own_part(&whole.load);
    let contact = &whole.contact;
    Model {
        nodes: nodes.iter().map(|n| whole.coordinates(*n)).collect(),
        sides: Sides::new(own_triangles.iter().map(|triangle| triangle.nodes)),
        triangles: own_triangles,
        edges: edges
            .iter()
            .map(|id| whole.edge(*id))
            .map(|edge| Edge { nodes: edge.nodes.map(|node| numbers[&node]), ..*edge })
            .collect(),
        holds,
        restraints: whole.restraints.clone(),
        forces: NodeId::all(nodes.len())
            .map(|node| Force::Node(node, node.components(&load)))
            .collect(),
        load,
        stages: whole.stages.iter().map(own_part).collect(),
        bodies: whole.bodies.iter().map(body).filter(|body| !body.triangles.is_empty()).collect(),
        contact: ContactSurfaces {
            nodes: contact.nodes.iter().filter_map(number).collect(),
            target: contact.target.iter().filter_map(edge_number).collect(),
            tolerance: contact.tolerance,
        },
        rows: whole.rows.iter().filter_map(row).collect(),
        dropped: Vec::new(),
        plane: whole.plane,
        thickness: whole.thickness,
        z: whole.z,
    }
}
