//! The target that each contact node faces in a given shape: target nodes and weights, normal, gap.
//!
//! ```text
//!        contact surface          c  o            normal n: out of the target
//!                                    | gap        gap = n·(x_c − Σ w x_t), < 0 where it penetrates
//!        target surface    a *-------+-------* b
//! ```
//!
//! Node to segment (`nts.rs`) takes the closest point on the nearest edge: two weights. Mortar
//! (`mortar.rs`) averages over the stretch of the target that the edges of c cover: more weights,
//! and constant pressure is transferred exactly.

use super::search::{dot, minus};
use numbers::scalar::Scalar;
use problem::model::{EdgeId, NodeId};
use serde::Serialize;

/// The component of a normal beyond which the one free motion of a node makes its gap, and the
/// equation of that motion determines its force.
pub const STEEP: f64 = 0.5;

/// The part of the target that a contact node faces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pairing<T = f64> {
    /// The contact node that faces it.
    pub node: NodeId,
    /// The target edge that it faces; of several, the one that it covers most.
    pub edge: EdgeId,
    /// The master nodes, which are nodes of the target, and their weights, which sum to 1.
    pub masters: Vec<(NodeId, T)>,
    /// The unit normal that points out of the target.
    pub normal: [T; 2],
    /// The distance from the target along the normal, length; < 0 where the node penetrates.
    pub gap: T,
    /// The length of the contact surface that the node represents, length.
    pub length: T,
}

impl<T: Scalar> Pairing<T> {
    /// Returns n·(v_c − Σ w v_t) of a field: of coordinates the gap, of displacements its change.
    pub fn opening(&self, of_node: impl Fn(NodeId) -> [T; 2]) -> T {
        dot(self.motion(of_node), self.normal)
    }

    /// Returns v_c − Σ w v_t of a field.
    pub fn motion(&self, of_node: impl Fn(NodeId) -> [T; 2]) -> [T; 2] {
        let at = of_node(self.node);
        // Differences from the node lose no digits far from the origin.
        self.masters.iter().fold([T::zero(); 2], |[x, y], &(master, w)| {
            let [dx, dy] = minus(at, of_node(master));
            [x + w * dx, y + w * dy]
        })
    }
}

/// A point or vector of the plane.
pub(super) type Vector = [f64; 2];

/// Returns the unit vector along `v`.
pub(super) fn unit<T: Scalar>(v: [T; 2]) -> [T; 2] {
    let size = T::length(v[0], v[1]);
    [v[0] / size, v[1] / size]
}
