//! The target that each contact node faces in a given shape: target nodes and weights, normal, gap; and
//! whether the node is open, sticks or slides.
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

use std::fmt;

use nalgebra::DVector;
use serde::Serialize;

use super::search::{dot, minus};
use numbers::scalar::Scalar;
use problem::model::{EdgeId, Model, NodeId};

/// The component of a normal beyond which the one free motion of a node makes its gap, and the
/// equation of that motion determines its force.
pub const STEEP: f64 = 0.5;

/// The part of the target that a contact node faces.
#[derive(Clone, Debug, PartialEq)]
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
    /// At a concave corner, on both of whose edges the node rests, the tangent of the angle from the normal
    /// to either edge's; 0 elsewhere.
    pub corner: f64,
}

impl Pairing {
    /// Returns the gap of a model after displacements `u`, along the normal, length.
    pub fn gap_after(&self, model: &Model, u: &DVector<f64>) -> f64 {
        self.opening(|node| model.coordinates(node)) + self.opening(|node| node.components(u))
    }

    /// Returns the tangent: the normal turned left.
    pub(crate) fn tangent(&self) -> [f64; 2] {
        [-self.normal[1], self.normal[0]]
    }

    /// Returns the pairing of a node in a concave corner with one of its two edges alone: that whose normal
    /// is turned from the mean normal to the left (1) or to the right (-1).
    pub(crate) fn on_edge(&self, side: f64) -> Self {
        let ([nx, ny], turn) = (self.normal, side * self.corner);
        let normal = unit([nx - turn * ny, ny + turn * nx]);
        Pairing { normal, corner: 0.0, ..self.clone() }
    }
}

impl<T: Scalar> Pairing<T> {
    /// Returns the contact node and its master nodes.
    pub fn nodes(&self) -> impl Iterator<Item = NodeId> {
        std::iter::once(self.node).chain(self.masters.iter().map(|(master, _)| *master))
    }

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

/// The status of a contact node under `unilateral`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// It is not in contact.
    Open,
    /// It is in contact and does not slide in this step of the load.
    Stick,
    /// It is in contact and slides, against the friction.
    #[serde(untagged)]
    Slip(Sense),
}

/// The sense in which a node slides along the tangent, which is the normal turned left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub enum Sense {
    /// Along the tangent.
    #[serde(rename = "slip+")]
    Forward,
    /// Against the tangent.
    #[serde(rename = "slip-")]
    Backward,
    /// Either way: there is no friction.
    #[serde(rename = "slip")]
    Free,
}

impl Status {
    /// Returns whether the node is in contact.
    pub fn is_closed(self) -> bool {
        self != Status::Open
    }
}

impl Sense {
    /// Returns the sign of the motion along the tangent; 0 without friction.
    pub fn sign(self) -> f64 {
        match self {
            Sense::Forward => 1.0,
            Sense::Backward => -1.0,
            Sense::Free => 0.0,
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Status::Open => "open",
            Status::Stick => "stick",
            Status::Slip(Sense::Forward | Sense::Backward | Sense::Free) => "slip",
        })
    }
}
