//! Whether a contact node is open, sticks or slides.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The status of a contact node under `unilateral`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
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
            Status::Slip(Sense::Forward) => "slip +",
            Status::Slip(Sense::Backward) => "slip -",
            Status::Slip(Sense::Free) => "slip",
        })
    }
}
