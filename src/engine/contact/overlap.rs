//! Nodes of a body's outline that lie inside another body in the shape reached, whether contact watches them
//! or not.
//!
//! ```text
//!      . . another body . .
//!      .  x   node, inside.      depth: to the nearest edge of the other body's whole outline
//!   ___.__:_______________.__    height: of the arcs over the edges there, by which curved surfaces that lie flush
//!      body's outline              enter each other
//! ```

use std::collections::HashMap;

use super::outline::Outline;
use super::pairing::Vector;
use super::search::{distance_square, is_in_triangle};
use super::surface::{Surface, Surfaces};
use problem::model::{Body, Bounds, Model, NodeId};
use problem::tree::Tree;

/// A node of an outline that lies inside a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InsideNode {
    /// The node.
    pub node: NodeId,
    /// Its distance from the outline of that body, length.
    pub depth: f64,
    /// The height of the arcs over the edges of both outlines there, in the undeformed shape, length; 0 where
    /// they are straight.
    pub height: f64,
    /// What contact knows of it.
    pub watched: Watched,
}

/// What contact knows of a node that lies inside a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watched {
    /// It is a contact node over a target edge, or rests on its end: its gap is an unknown of the problem.
    Contact,
    /// It is a target node over a contact edge: mortar watches it, node to segment does not.
    Target,
    /// Nothing: it is in no group, or no edge of the other group faces it.
    Not,
}

/// The triangles of a body in a shape near the nodes that may lie in it.
pub(super) struct PlacedTriangles {
    triangles: Vec<([NodeId; 3], [Vector; 3])>,
    tree: Tree,
}

impl Surfaces {
    /// Returns the nodes of all outlines that lie inside another body in a shape, given as the coordinates of
    /// each node, length, the deepest first; where both surfaces are one body's, inside that body too.
    /// `facing` are the contact nodes that face the target, with whether they are in contact; without contact
    /// there are none.
    pub fn inside(
        &self,
        model: &Model,
        shape: &[Vector],
        facing: &HashMap<NodeId, bool>,
    ) -> Vec<InsideNode> {
        let target = model.target();
        let whole = Surface::new(model, model.sides.outline().map(|side| side.nodes).collect());
        let [contact_outline, target_outline] =
            [&self.contact, &self.target].map(|surface| Outline::new(surface, shape));
        let is_self = target.is_some_and(|target| self.nodes.iter().all(|node| target.has(*node)));
        let mut found = Vec::new();
        for body in &model.bodies {
            let is_target = target.is_some_and(|target| std::ptr::eq(body, target));
            let around = Bounds::around(body.nodes.iter().map(|node| &shape[node.index()]));
            let may_enter = |node: &&NodeId| {
                (is_self && is_target || !body.has(**node)) && around.contains(shape[node.index()])
            };
            let nodes: Vec<NodeId> = whole.at.keys().filter(may_enter).copied().collect();
            let placed = PlacedTriangles::new(model, body, &nodes, shape);
            for node in nodes.into_iter().filter(|node| placed.contain(*node, shape)) {
                let Some((depth, [a, b])) = whole.nearest(body, node, shape) else { continue };
                let height = [node, a, b].map(|at| whole.height_near(at));
                let height = height.into_iter().fold(0.0, f64::max);
                // Whether the node lies over an edge of the other group, not past its end.
                let over = |own: &Surface, other: &Outline| {
                    let faced = other.faced((node, own), [shape, &model.nodes]);
                    Some(faced.filter(|faced| body.has(faced.masters[0].0))?.over)
                };
                let watched = if let Some(is_closed) = facing.get(&node)
                    && over(&self.contact, &target_outline)
                        .is_some_and(|is_over| is_over || *is_closed)
                {
                    Watched::Contact
                } else if self.target.at.contains_key(&node)
                    && over(&self.target, &contact_outline) == Some(true)
                {
                    Watched::Target
                } else {
                    Watched::Not
                };
                found.push(InsideNode { node, depth, height, watched });
            }
        }
        found.sort_by(|a, b| b.depth.total_cmp(&a.depth).then(a.node.cmp(&b.node)));
        found
    }
}

impl Surface {
    /// Returns the largest height of the arcs over the edges that meet at a node, from either of their ends,
    /// length.
    fn height_near(&self, node: NodeId) -> f64 {
        let ends = self.at[&node].iter().flat_map(|k| self.edges[*k]);
        ends.map(|end| self.height_at(end)).fold(0.0, f64::max)
    }

    /// Returns the distance of a node from the nearest edge of a body's outline that does not end at it,
    /// length, and the edge.
    fn nearest(&self, body: &Body, node: NodeId, shape: &[Vector]) -> Option<(f64, [NodeId; 2])> {
        let edges = self.edges.iter().filter(|edge| body.has(edge[0]) && !edge.contains(&node));
        let square = |edge: &[NodeId; 2]| {
            distance_square(edge.map(|end| shape[end.index()]), shape[node.index()])
        };
        let nearest = edges.map(|edge| (square(edge), *edge)).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(square, edge)| (square.sqrt(), edge))
    }
}

impl PlacedTriangles {
    /// Places the triangles of a body that may contain one of `nodes`.
    pub(super) fn new(model: &Model, body: &Body, nodes: &[NodeId], shape: &[Vector]) -> Self {
        let near = Bounds::around(nodes.iter().map(|node| &shape[node.index()]));
        let own = body.triangles.iter().map(|id| model.triangle(*id).nodes);
        let placed = own.map(|nodes| (nodes, nodes.map(|node| shape[node.index()])));
        let triangles: Vec<_> =
            placed.filter(|(_, corners)| Bounds::around(corners).meets(near)).collect();
        let boxes = triangles.iter().map(|(_, corners)| Bounds::around(corners));
        let tree = Tree::new(boxes.map(|own| [own.low, own.high]).enumerate());
        PlacedTriangles { triangles, tree }
    }

    /// Returns whether a node lies in a triangle of which it is no corner, or on a side of it.
    pub(super) fn contain(&self, node: NodeId, shape: &[Vector]) -> bool {
        let p = shape[node.index()];
        let mut is_inside = false;
        self.tree.visit(&|b: Bounds| b.contains(p).then_some(0.0), &mut |k| {
            let (nodes, corners) = self.triangles[k];
            is_inside |= !nodes.contains(&node) && is_in_triangle(corners, p);
        });
        is_inside
    }
}
