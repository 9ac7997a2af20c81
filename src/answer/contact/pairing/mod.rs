//! What each contact node faces on the target, in a given shape: target nodes and weights, the normal, the gap.
//!
//! ```text
//!        contact surface          c  o            normal n: out of the target
//!                                    | gap         gap = n·(x_c − Σ w x_t), < 0 where it penetrates
//!        target surface    a *-------+-------* b
//! ```
//!
//! Node to segment ([`nts`]) takes the foot of c on the nearest edge: two weights. Mortar ([`mortar`]) averages over the stretch of
//! the target that c's edges cover: more weights, and constant pressure passes exactly.

mod mortar;
mod nts;
mod surfaces;

pub use surfaces::Surfaces;

use crate::paper::mathcad::array::Table;
use crate::problem::modelling::Coupling;

/// What a contact node faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Pairing {
    /// The contact node.
    pub node: usize,
    /// `elem` number of the target edge that it faces; of several the one it covers most.
    pub edge: usize,
    /// Target nodes and weights; they sum to 1.
    pub weights: Vec<(usize, f64)>,
    /// Unit normal, out of the target.
    pub normal: [f64; 2],
    /// Distance from the target along the normal, length; < 0 where the node penetrates.
    pub gap: f64,
    /// Length of contact surface that the node stands for, length.
    pub length: f64,
}

impl Pairing {
    /// n·(v_c − Σ w v_t) of a vector field: of places the gap, of displacements what it opens by.
    pub fn opening(&self, of_node: impl Fn(usize) -> [f64; 2]) -> f64 {
        let at = of_node(self.node);
        // Differences from the node, so that no digits are lost far from the origin.
        let from = |mate: usize| dot(minus(at, of_node(mate)), self.normal);
        self.weights.iter().map(|&(mate, w)| w * from(mate)).sum()
    }
}

impl Surfaces {
    /// For each entry of `cnt` what it faces in the shape `node_n` (R x 4). Nothing for a node that faces no edge, and for a node's second
    /// entry.
    pub fn pairings(&self, coupling: Coupling, node_n: &Table<f64>) -> Vec<Option<Pairing>> {
        match coupling {
            Coupling::Nts => nts::pairings(self, node_n),
            Coupling::Mortar => mortar::pairings(self, node_n),
        }
    }
}

/// A point or vector of the plane.
type Vector = [f64; 2];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}
