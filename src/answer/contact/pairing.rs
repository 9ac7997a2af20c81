//! What each contact node faces on the target, in a given shape: target nodes and weights, the
//! normal, the gap.
//!
//! ```text
//!        contact surface          c  o            normal n: out of the target
//!                                    | gap         gap = n·(x_c − Σ w x_t), < 0 where it penetrates
//!        target surface    a *-------+-------* b
//! ```
//!
//! Node to segment (`nts.rs`) takes the point of the nearest edge that is closest to c: two
//! weights. Mortar (`mortar.rs`) averages over the stretch of the target that c's edges cover: more
//! weights, and constant pressure passes exactly.

use crate::problem::model::{EdgeId, NodeId};

/// What a contact node faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairing {
    /// The contact node.
    pub node: NodeId,
    /// The target edge that it faces; of several the one it covers most.
    pub edge: EdgeId,
    /// The target nodes that it would follow, the master nodes, and their weights; they sum to 1.
    pub masters: Vec<(NodeId, f64)>,
    /// Unit normal, out of the target.
    pub normal: [f64; 2],
    /// Distance from the target along the normal, length; < 0 where the node penetrates.
    pub gap: f64,
    /// Length of contact surface that the node stands for, length.
    pub length: f64,
}

impl Pairing {
    /// n·(v_c − Σ w v_t) of a vector field: of places the gap, of displacements what it opens by.
    pub fn opening(&self, of_node: impl Fn(NodeId) -> [f64; 2]) -> f64 {
        let at = of_node(self.node);
        // Differences from the node, so that no digits are lost far from the origin.
        let from = |master: NodeId| dot(minus(at, of_node(master)), self.normal);
        self.masters.iter().map(|&(master, w)| w * from(master)).sum()
    }
}

/// A point or vector of the plane.
pub(super) type Vector = [f64; 2];

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}
