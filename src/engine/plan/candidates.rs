//! Which contact nodes can come to which target edges: a test of boxes.
//!
//! ```text
//!        o node            the edge's box, grown on all sides by c_tll + MARGIN · (its length);
//!     +-------------+      a node inside it is a candidate for the edge
//!     |   a         |
//!     |     \__     |
//!     |         b   |
//!     +-------------+
//! ```

use serde::Serialize;

use problem::model::{Bounds, Model};
use problem::tree::Tree;

/// How far a node may move, in lengths of the edge: one that moves further passes over half of it
/// in one step, which the contact search is not made for either.
pub const MARGIN: f64 = 0.5;

/// Contact nodes and target edges, and the pairs of them that can come together from the initial
/// shape.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Candidates {
    pub nodes: usize,
    pub edges: usize,
    /// Pairs of a node and an edge that can come together.
    pub pairs: usize,
    /// Nodes that can come to an edge.
    pub near: usize,
}

impl Candidates {
    /// The candidates of a model; nothing without contact.
    pub fn find(model: &Model) -> Option<Self> {
        let tolerance = model.contact.tolerance;
        let points: Vec<[f64; 2]> =
            model.contact.nodes.iter().map(|node| model.coordinates(*node)).collect();
        if points.is_empty() {
            return None;
        }
        let tree = Tree::new(points.iter().map(|at| [*at, *at]).enumerate());
        let mut found = vec![0; points.len()];
        for edge in model.target_edges() {
            let grown = tolerance + MARGIN * model.length(edge.nodes);
            let ends = edge.nodes.map(|node| model.coordinates(node));
            let near = Bounds::around(&ends).padded(grown);
            tree.visit_in(near, &mut |k| {
                found[k] += usize::from(near.contains(points[k]));
            });
        }
        Some(Candidates {
            nodes: points.len(),
            edges: model.contact.target.len(),
            pairs: found.iter().sum(),
            near: found.iter().filter(|pairs| **pairs > 0).count(),
        })
    }

    /// Pairs that the search as printed visits at every call: all.
    pub fn all(&self) -> usize {
        self.nodes * self.edges
    }
}
