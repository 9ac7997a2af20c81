//! Half of a scene that is its own mirror image about a vertical line.
//!
//! Mesh, materials, restraints, loads and contact surfaces must be symmetric, and no triangle may
//! lie across the line. Then the solution is symmetric too, the line moves only along itself, and
//! the half right of it, restrained in x on the line, has the same solution.

use std::collections::{BTreeSet, HashSet};

use nalgebra::DVector;

use super::derived::Derived;
use super::description::{Axis, Description, LoadKind, Restraint};
use super::groups::Groups;
use super::mesh::{Element, KINDS, Mesh};
use super::{Scene, Surface};
use crate::model::{Bounds, Edge, Model, NodeId, Triangle, TriangleId, unordered};
use crate::tree::Tree;

/// The largest distance of a node from its image, over the scene's size: meshes are rounded.
const PLACE: f64 = 1e-9;

/// The largest difference of a load from its image, over the largest load.
const LOAD: f64 = 1e-9;

/// The tag of the edges along the line in the mesh of a half: no other has one so large.
const LINE: usize = usize::MAX;

/// Returns the half of `scene` right of the line; None where it is not symmetric about a vertical line.
pub fn half(scene: &Scene) -> Option<Derived> {
    let model = &*scene.model;
    images(model)?;
    let line = Line::of(model);
    let is_right =
        |id: &TriangleId| model.triangle(*id).nodes.iter().all(|node| line.side(*node) >= 0);
    let triangles: Vec<TriangleId> = model.triangle_ids().filter(is_right).collect();
    let nodes: BTreeSet<NodeId> =
        triangles.iter().flat_map(|id| model.triangle(*id).nodes).collect();
    let mut mesh = mesh(scene, &line, &triangles, &nodes);
    let mut description = description(scene, &line, &mesh, &nodes);
    mesh.adapt(&mut description).ok()?;
    let scene = scene.on(description, mesh, Vec::new()).ok()?;
    Some(Derived { scene, nodes: nodes.into_iter().map(|node| [node; 2]).collect(), triangles })
}

/// Returns the mesh of a half with its `nodes`, under the scene's numbers: a part of the scene's, and edges
/// along the line.
fn mesh(scene: &Scene, line: &Line, triangles: &[TriangleId], nodes: &BTreeSet<NodeId>) -> Mesh {
    let (_, whole) = scene.source();
    let is_inside = |n: &usize| nodes.contains(&NodeId::from_number(*n));
    let own = whole.elements.iter().filter(|element| element.nodes.iter().all(is_inside));
    let sides = triangles.iter().flat_map(|id| scene.model.triangle(*id).sides());
    let on_line = sides.filter(|side| side.iter().all(|node| line.side(*node) == 0));
    let last = whole.elements.last().map_or(0, |element| element.number);
    let along = (last + 1..).zip(on_line).map(|(number, side)| Element {
        number,
        kind: KINDS[1].number,
        physical: [LINE].into(),
        geometric: LINE,
        nodes: side.map(NodeId::number)[..].into(),
    });
    Mesh {
        names: whole.names.clone(),
        nodes: nodes.iter().map(|node| whole.nodes[node.index()].clone()).collect(),
        elements: own.cloned().chain(along).collect(),
        ..Mesh::default()
    }
}

/// Describes a half on its mesh: the line is restrained in x, and has half of the forces on its nodes.
fn description(scene: &Scene, line: &Line, mesh: &Mesh, nodes: &BTreeSet<NodeId>) -> Description {
    let (model, groups) = (&*scene.model, Groups::new(mesh));
    let mut own = scene.source().0.clone();
    own.materials.0.retain(|(group, _)| groups.places(2, group, "materials").is_ok());
    let held = own.restraints.into_iter().zip(model.held_nodes());
    let held = held.filter(|(restraint, held)| match &restraint.on {
        Some(on) => groups.nodes(on, "restraints").is_ok(),
        None => held.iter().any(|node| nodes.contains(node)),
    });
    let of_line = |on, node| Restraint { on, node, fix: vec![Axis::X], ..Restraint::default() };
    let on_line = nodes.iter().filter(|node| line.side(**node) == 0);
    // A finer mesh has more nodes along the edges; no edge may be there.
    let edges = groups.places(1, &LINE.into(), "restraints").ok();
    let along = edges.map(|_| of_line(Some(LINE.into()), None)).into_iter();
    let along = along.chain(on_line.map(|node| of_line(None, Some(node.number()))));
    own.restraints = held.map(|(restraint, _)| restraint).chain(along).collect();
    own.loads.retain_mut(|load| match &mut load.kind {
        LoadKind::Pressure { on, .. } | LoadKind::Traction { on, .. } => {
            groups.places(1, on, "loads").is_ok()
        }
        LoadKind::Weight { on, .. } => groups.places(2, on, "loads").is_ok(),
        LoadKind::Force { node, force: [x, y] } => {
            let node = NodeId::from_number(*node);
            if line.side(node) == 0 {
                (*x, *y) = (0.0, 0.5 * *y);
            }
            nodes.contains(&node)
        }
    });
    if let Some(contact) = &mut own.contact {
        let on_contact = model.contact.nodes.iter().filter(|node| nodes.contains(node));
        let is_inside = |edge: &&Edge| edge.nodes.iter().all(|node| nodes.contains(node));
        let on_target = model.target_edges().filter(is_inside);
        contact.contact = Surface::Numbers(on_contact.map(|node| node.number()).collect());
        contact.target = Surface::Numbers(on_target.map(|edge| edge.number).collect());
    }
    own
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
    let kept = model.node_ids().filter(|n| !model.is_dropped(*n));
    let tree = Tree::new(kept.map(|n| (n.index(), [model.coordinates(n); 2])));
    let body = |n: NodeId| model.bodies.iter().position(|b| b.has(n));
    let mut images = Vec::with_capacity(model.nodes.len());
    for n in model.node_ids() {
        if model.is_dropped(n) {
            images.push(n);
            continue;
        }
        let [nx, ny] = model.coordinates(n);
        let near = Bounds::around(&[[2.0 * at - nx, ny]]).padded(2.0 * place);
        let mut found = Vec::new();
        tree.visit_in(near, &mut |k| {
            let [mx, my] = model.nodes[k];
            if (2.0 * at - nx - mx).hypot(ny - my) <= place {
                found.push(NodeId::new(k));
            }
        });
        found.sort_unstable();
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
