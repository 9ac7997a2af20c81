//! What holds nodes in their places: directions along which their displacements are given.
//!
//! A node has at most two directions. A third one is left out where the two determine it.

use serde::Serialize;

use super::ids::{Dof, NodeId};

/// A restraint of the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Support {
    /// What it holds, as the scene says: the name of a group, or a node.
    pub name: String,
    /// What it holds and no restraint before it does, in the order of the nodes.
    pub holds: Vec<Hold>,
}

/// A displacement of a node that is given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Hold {
    /// The node.
    pub node: NodeId,
    /// The direction, of length 1.
    pub direction: [f64; 2],
    /// The displacement along it at the end of the first stage, length.
    pub displacement: f64,
}

impl Hold {
    /// Returns the degree of freedom that is 0; None along another direction than an axis, and for another
    /// displacement than 0.
    pub fn dof(&self) -> Option<Dof> {
        let [x, y] = self.node.dofs();
        match self.direction {
            _ if self.displacement != 0.0 => None,
            [_, 0.0] => Some(x),
            [0.0, _] => Some(y),
            [_, _] => None,
        }
    }
}

/// Returns the vector v with a·v = p and b·v = q for two directions; None where they are parallel.
pub fn crossing([a, b]: [[f64; 2]; 2], [p, q]: [f64; 2]) -> Option<[f64; 2]> {
    let cross = a[0] * b[1] - a[1] * b[0];
    (cross != 0.0).then(|| [(p * b[1] - q * a[1]) / cross, (q * a[0] - p * b[0]) / cross])
}
