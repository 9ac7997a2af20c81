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

use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::contact::search::Segment;
use crate::problem::model::{Bounds, Edge, Model};

/// How far a node may move, in lengths of the edge: one that moves further passes over half of it
/// in one step, which the contact search is not made for either.
pub const MARGIN: f64 = 0.5;

/// Contact nodes and target edges, and the pairs of them that can come together from the initial
/// shape.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Candidates {
    pub nodes: usize,
    pub edges: usize,
    /// Pairs of a node and an edge that can come together.
    pub pairs: usize,
    /// Nodes that can come to an edge.
    pub near: usize,
    /// Of those, nodes within c_tll of an edge.
    pub touching: usize,
}

impl Candidates {
    /// The candidates of a model; nothing without contact.
    pub fn find(model: &Model) -> Option<Self> {
        let tolerance = model.contact.tolerance;
        let ends = |edge: &Edge| edge.nodes.map(|node| model.at(node));
        let edges: Vec<[[f64; 2]; 2]> = model.target_edges().map(ends).collect();
        let points = || model.contact.nodes.iter().map(|node| model.at(*node));
        let grown = |ends: &[[f64; 2]; 2]| {
            let [[ax, ay], [bx, by]] = *ends;
            Bounds::of(ends).padded(tolerance + MARGIN * (bx - ax).hypot(by - ay))
        };
        let boxes: Vec<Bounds> = edges.iter().map(grown).collect();
        let near = |p| boxes.iter().filter(|edge| edge.contains(p)).count();
        let of_node: Vec<usize> = points().map(near).collect();
        let segments: Vec<Segment<f64>> = edges.iter().copied().map(Segment::new).collect();
        let touches = |p: &[f64; 2]| {
            segments.iter().any(|edge| edge.closest(*p).distance().abs() <= tolerance)
        };
        (!of_node.is_empty()).then(|| Candidates {
            nodes: of_node.len(),
            edges: edges.len(),
            pairs: of_node.iter().sum(),
            near: of_node.iter().filter(|count| **count > 0).count(),
            touching: points().filter(touches).count(),
        })
    }

    /// Pairs that the search as printed visits at every call: all.
    pub fn all(&self) -> usize {
        self.nodes * self.edges
    }
}
