//! The variants that can be run, and how contact is modelled beyond what the paper prints.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::choices;

choices! {
    /// A variant: how the contact pairs enter the equations, and what load an iteration carries.
    Variant {
        /// Eq. (1) on increments: equal steps of the load, the shape updated after each.
        Stepped = "stepped",
        /// Eq. (1) imposed on total displacements.
        Tied = "tied",
        /// `Km` exactly as printed.
        Printed = "printed",
        /// Gaps are closed along the normal and released where they would pull.
        Unilateral = "unilateral",
    }
}

choices! {
    /// The motion of a contact node along the target's tangent under `unilateral`.
    #[serde(try_from = "Value")]
    Friction {
        /// It follows the target, as eq. (1) asks.
        Stick = "stick",
        /// It slides without friction.
        None = "0",
    }
}

impl TryFrom<Value> for Friction {
    type Error = String;

    /// Reads `0`, as a number or as text, or `"stick"`.
    fn try_from(value: Value) -> Result<Self, String> {
        let text = match value {
            Value::String(text) => text,
            other => other.to_string(),
        };
        text.parse().map_err(|_| format!("friction {text} is neither 0 nor \"stick\""))
    }
}

choices! {
    /// The shape in which `unilateral` measures normals, weights and gaps of nodes that slide.
    Geometry {
        /// The current shape of each iteration.
        Current = "current",
        /// The initial shape: the theory of small displacements, as Hertz's.
        Initial = "initial",
    }
}

choices! {
    /// The method that binds a contact node to the target surface.
    Coupling {
        /// Node to segment: to the two nodes of one edge, as `c_cnt` does.
        Nts = "nts",
        /// Mortar with dual multipliers: to the nodes of all edges that its own edges cover.
        Mortar = "mortar",
    }
}

choices! {
    /// The rule that decides the status of a contact node.
    StatusRule {
        /// The rule of lines 16 to 18 of `c_cnt` as printed.
        Signs = "signs",
        /// The rule of line 16, or a side of the node's triangles crosses the target surface.
        Intersection = "intersection",
        /// The signed distance to the nearest target edge is c_tll or less, and the node at most
        /// c_tll past the surface's end.
        Projection = "projection",
    }
}

/// The model of contact, beyond what the paper prints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ContactModel {
    /// The method that binds a contact node to the target surface.
    pub coupling: Coupling,
    pub friction: Friction,
    pub geometry: Geometry,
    /// The rule by which `tied` and `stepped` decide which nodes are in contact.
    pub status: StatusRule,
}

impl ContactModel {
    /// Returns whether `unilateral` measures contact in the current shape. Otherwise it measures in
    /// the initial shape, and a node that sticks stays at the place that it faced there.
    pub fn measures_current_shape(&self) -> bool {
        (self.friction, self.geometry) == (Friction::None, Geometry::Current)
    }
}

impl Variant {
    /// The paper's own variants, which search with `c_cnt`.
    pub const OF_THE_PAPER: &'static [Variant] =
        &[Variant::Stepped, Variant::Tied, Variant::Printed];
}
