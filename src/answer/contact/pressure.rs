//! The traction on the contact surface at the end of a run of any variant: the reaction K u − F of
//! the contact body's equations.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::pairing::Pairing;
use super::surface::Surfaces;
use crate::answer::not_finite::or_nan;
use crate::answer::support::normal_force;
use crate::problem::model::{Model, NodeId};

/// A contact node at the end of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactNode {
    /// The node of the contact surface.
    pub node: NodeId,
    /// The distance from the first contact node along the undeformed contact surface, length.
    pub arc: f64,
    /// Whether it is in contact by the variant's own rule.
    #[serde(rename = "dy", with = "as_number")]
    pub in_contact: bool,
    /// The distance from the target along its normal, length; < 0 where the node penetrates.
    pub gap: f64,
    /// The force on the node along the normal, force; < 0 where it pulls.
    #[serde(deserialize_with = "or_nan")]
    pub force: f64,
    /// The contact pressure: the force over the undeformed surface of the node, stress; NaN for a
    /// node that bounds no contact edge.
    #[serde(deserialize_with = "or_nan")]
    pub pressure: f64,
    /// The traction along the tangent, which is the normal turned left, stress.
    #[serde(deserialize_with = "or_nan")]
    pub shear: f64,
    /// |shear| / pressure, the friction that keeps the node from sliding; None without pressure.
    pub friction_needed: Option<f64>,
}

/// Writes and reads `dy` in files as 1 or 0.
mod as_number {
    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(value: &bool, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u8(u8::from(*value))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<bool, D::Error> {
        Ok(u8::deserialize(deserializer)? == 1)
    }
}

/// The contact surface at the end of a run, from which the tractions are computed.
pub struct Traction<'a> {
    /// The finite element model of the run.
    pub model: &'a Model,
    /// The contact and target surfaces of the model.
    pub surfaces: &'a Surfaces,
    /// The shape in which contact is measured: the coordinates of each node, length.
    pub measured_in: &'a [[f64; 2]],
    /// The pairing of each entry of the contact surface in that shape.
    pub pairings: &'a [Option<Pairing>],
    /// Whether each entry of the contact surface is in contact.
    pub in_contact: &'a [bool],
    /// The reaction K u − F by degree of freedom, force.
    pub reaction: &'a DVector<f64>,
}

impl Traction<'_> {
    /// Returns the contact nodes that face the target, in order along the surface.
    pub fn nodes(&self) -> Vec<ContactNode> {
        let lengths =
            [&self.model.nodes[..], self.measured_in].map(|shape| self.surfaces.tributary(shape));
        let arcs = arcs(self.model);
        let node = |i: usize| {
            let pairing = self.pairings[i].as_ref()?;
            let stretch = lengths[1][i] / lengths[0][i];
            Some(self.node(pairing, arcs[i], self.in_contact[i], over(pairing.length, stretch)))
        };
        (0..self.pairings.len()).filter_map(node).collect()
    }

    /// Returns the tractions on a node that represents `length` of the undeformed surface.
    fn node(&self, pairing: &Pairing, arc: f64, in_contact: bool, length: f64) -> ContactNode {
        let [rx, ry] = pairing.node.of(self.reaction);
        let [nx, ny] = pairing.normal;
        let normal = normal_force(self.model, pairing, self.reaction);
        // At a restrained node the tangential part may belong to the restraint.
        let restrained = self.model.restraints_of(pairing.node).contains(&true);
        let tangent = if restrained { 0.0 } else { nx * ry - ny * rx };
        let area = length * self.model.thickness;
        let presses = in_contact && normal > 0.0;
        ContactNode {
            node: pairing.node,
            arc,
            in_contact,
            gap: pairing.gap,
            force: normal,
            pressure: over(normal, area),
            shear: over(tangent, area),
            friction_needed: presses.then(|| tangent.abs() / normal),
        }
    }
}

/// Returns a / b, or NaN for a node that represents no length, which has no pressure.
fn over(a: f64, b: f64) -> f64 {
    if b > 0.0 { a / b } else { f64::NAN }
}

/// Returns the distance of each entry from the first along the undeformed contact surface, length.
pub(in crate::answer) fn arcs(model: &Model) -> Vec<f64> {
    let at = |i: usize| model.at(model.contact.nodes[i]);
    let mut arcs = vec![0.0; model.contact.nodes.len()];
    for i in 1..arcs.len() {
        let ([ax, ay], [bx, by]) = (at(i - 1), at(i));
        arcs[i] = arcs[i - 1] + (bx - ax).hypot(by - ay);
    }
    arcs
}
