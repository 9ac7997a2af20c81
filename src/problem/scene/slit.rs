//! Slits: places where the outline of the mesh lies on itself, so that nothing is passed on across them.
//! Some are meant, as a crack; where two bodies are in contact there is none. And edges that are a side of no
//! triangle, as where one was divided and its edge was not.
//!
//! ```text
//!   two nodes at one place      a node on a side that does not have it
//!   +----a----+                 +---------+
//!   |    |b   |                 |    a    |      a lies on the side p q of the lower triangle
//!   +----+----+                 p----+----q
//! ```

use std::collections::{BTreeSet, HashSet};

use super::fold::{DEPTH, Faces};
use super::mesh::Mesh;
use crate::model::{Bounds, Model, NodeId};
use crate::tree::Tree;

/// The most places that are named.
const MOST: usize = 5;

/// Says which edges are a side of no triangle.
pub fn loose_edges(mesh: &Mesh, model: &Model) -> Option<String> {
    let mut loose = mesh.of_dimension(1).filter(|edge| model.sides.beside(edge.ids()).is_empty());
    let first = loose.next()?;
    let more = match loose.count() {
        0 => String::new(),
        more => format!(", as {more} more"),
    };
    Some(format!(
        "Edge {} of the mesh (nodes {}) is a side of no triangle{more}: what its group restrains are its two \
         nodes, and no node between them",
        first.number,
        mesh.named(&first.nodes)
    ))
}

/// Says where the mesh has slits.
pub fn slits(mesh: &Mesh, model: &Model) -> Option<String> {
    let faces = Faces::new(model);
    let on_contact: HashSet<NodeId> = model.contact.nodes.iter().copied().collect();
    let on_target: HashSet<NodeId> = model.target_edges().flat_map(|edge| edge.nodes).collect();
    let is_contact = |a: NodeId, b: NodeId| {
        faces.may_meet(a, b)
            || on_contact.contains(&a) && on_target.contains(&b)
            || on_contact.contains(&b) && on_target.contains(&a)
    };
    let outline: Vec<[NodeId; 2]> = model.sides.outline().map(|side| side.nodes).collect();
    let nodes = outline.iter().map(|[node, _]| model.coordinates(*node));
    let tree = Tree::new(nodes.map(|at| [at, at]).enumerate());
    let (mut twins, mut hanging) = (BTreeSet::new(), BTreeSet::new());
    for &[p, q] in &outline {
        let ends @ [[x, y], end] = [p, q].map(|n| model.coordinates(n));
        let (dx, dy) = (end[0] - x, end[1] - y);
        let length = dx.hypot(dy);
        let depth = DEPTH * length;
        let near = Bounds::around(&ends).padded(2.0 * depth);
        tree.visit_in(near, &mut |k| {
            let n = outline[k][0];
            let [nx, ny] = model.coordinates(n);
            let (ax, ay) = (nx - x, ny - y);
            let (on, off) = ((ax * dx + ay * dy) / length, (ax * dy - ay * dx) / length);
            let is_off = off.abs() > depth || on < -depth || on > length + depth;
            if is_off || [p, q].contains(&n) {
                return;
            }
            let twin = if on <= depth { Some(p) } else { (on >= length - depth).then_some(q) };
            match twin {
                Some(twin) if !is_contact(n, twin) => {
                    twins.insert([n.min(twin), n.max(twin)]);
                }
                None if !is_contact(n, p) && !is_contact(n, q) => {
                    hanging.insert((n, [p, q]));
                }
                Some(_) | None => {}
            }
        });
    }
    let count = twins.len() + hanging.len();
    let named = |nodes: &[NodeId]| {
        let numbers: Vec<usize> = nodes.iter().map(|n| n.number()).collect();
        mesh.named(&numbers).replace(", ", " and ")
    };
    let twins = twins.iter().map(|pair| format!("nodes {} are at one place", named(pair)));
    let on_side = |(n, side): &(NodeId, [NodeId; 2])| {
        format!("node {} is on the side between {}", named(&[*n]), named(side))
    };
    let places: Vec<String> = twins.chain(hanging.iter().map(on_side)).take(MOST).collect();
    let more = match count.saturating_sub(MOST) {
        0 => String::new(),
        more => format!("; and {more} more places"),
    };
    (count > 0).then(|| {
        format!(
            "The mesh has a slit, across which nothing is passed on: {}{more}. If no crack is meant, merge the \
             nodes or divide the sides (in Gmsh: Coherence, then mesh again)",
            places.join("; ")
        )
    })
}
