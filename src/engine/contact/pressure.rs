//! The traction on the contact surface at the end of a run of any variant: the reaction K u − F of
//! the contact body's equations.

use nalgebra::DVector;

use super::pairing::{Pairing, Status};
use super::surface::Surfaces;
use crate::quantities::ContactNode;
use problem::element::Plane;
use problem::model::{Material, Model, NodeId};

/// How far the size of a normal's component may be from 1 where a restraint is across the normal.
const ACROSS: f64 = 1e-9;

/// The force over the largest of a surface, or of the load, below which it is rounding.
pub const ROUNDING_OF_A_FORCE: f64 = 1e-11;

/// Returns the nodes in contact that pull by more than rounding; the largest force of the load is `load`.
pub fn pulling(surface: &[ContactNode], load: f64) -> Vec<NodeId> {
    let least = ROUNDING_OF_A_FORCE * largest(surface.iter().map(|node| node.force)).max(load);
    let pulls = |node: &&ContactNode| node.force.is_some_and(|force| force < -least);
    surface.iter().filter(|node| node.in_contact).filter(pulls).map(|node| node.node).collect()
}

/// Returns for each node the force up to which what the stresses about it leave of its equation is rounding, as after
/// a motion that strains nothing: some digits' end of |K| |u|.
pub fn rounding(model: &Model, u: &DVector<f64>) -> Vec<f64> {
    /// How often the end of a digit is lost in the six products of a triangle's equation and its coordinates.
    const LOST: f64 = 32.0 * f64::EPSILON;
    let mut sizes = vec![0.0; model.nodes.len()];
    for triangle in &model.triangles {
        let moved = triangle.nodes.iter().flat_map(|node| node.components(u));
        let Material { e, nu } = triangle.material;
        let stiffness = match model.plane {
            Plane::Strain => e / (1.0 - 2.0 * nu),
            Plane::Stress => e / (1.0 - nu),
        };
        let size = LOST * model.thickness * stiffness * moved.fold(0.0, |m: f64, u| m.max(u.abs()));
        triangle.nodes.iter().for_each(|node| sizes[node.index()] += size);
    }
    sizes
}

/// Returns the largest |force| of those that are determined.
fn largest(forces: impl Iterator<Item = Option<f64>>) -> f64 {
    forces.flatten().fold(0.0, |largest, force| largest.max(force.abs()))
}

/// The contact surface at the end of a run, from which the tractions are computed.
pub struct Traction<'a> {
    /// The finite element model of the run.
    pub model: &'a Model,
    /// The displacements at its end, length.
    pub u: &'a DVector<f64>,
    /// The contact and target surfaces of the model.
    pub surfaces: &'a Surfaces,
    /// The shape in which contact is measured: the coordinates of each node, length.
    pub measured_in: &'a [[f64; 2]],
    /// The pairing of each entry of the contact surface in that shape.
    pub pairings: &'a [Option<Pairing>],
    /// The gap of each entry, length; None where it faces nothing.
    pub gaps: &'a [Option<f64>],
    /// Whether each entry of the contact surface is in contact.
    pub in_contact: &'a [bool],
    /// The status of each entry; None where the variant has no such statuses.
    pub statuses: Option<&'a [Status]>,
    /// The force of each entry along normal and tangent, force; None where it is not determined.
    pub forces: &'a [[Option<f64>; 2]],
}

impl Traction<'_> {
    /// Returns the contact nodes that face the target, in order along the surface.
    pub fn nodes(&self) -> Vec<ContactNode> {
        let lengths =
            [&self.model.nodes[..], self.measured_in].map(|shape| self.surfaces.tributary(shape));
        let arcs = arcs(self.model);
        let least = ROUNDING_OF_A_FORCE * largest(self.forces.iter().map(|force| force[0]));
        let rounding = rounding(self.model, self.u);
        let node = |i: usize| {
            let pairing = self.pairings[i].as_ref()?;
            let stretch = lengths[1][i] / lengths[0][i];
            let length = over(pairing.length, stretch).unwrap_or(0.0);
            let least = least.max(rounding[pairing.node.index()]);
            let beyond =
                |force: f64| if force.abs() > rounding[pairing.node.index()] { force } else { 0.0 };
            let [normal, tangent] = self.forces[i].map(|force| force.map(beyond));
            Some(ContactNode::compute(&ContactPlace {
                pairing,
                arc: arcs[i],
                area: length * self.model.thickness,
                in_contact: self.in_contact[i],
                gap: self.gaps[i].unwrap_or(pairing.gap),
                status: self.statuses.map(|statuses| statuses[i]),
                normal,
                tangent,
                is_pressed: self.in_contact[i] && normal.is_some_and(|normal| normal > least),
            }))
        };
        (0..self.pairings.len()).filter_map(node).collect()
    }
}

/// A contact node that faces the target.
pub(crate) struct ContactPlace<'a> {
    pub pairing: &'a Pairing,
    /// Its distance along the undeformed surface, length.
    pub arc: f64,
    /// The undeformed surface that it represents, length · thickness.
    pub area: f64,
    pub in_contact: bool,
    pub gap: f64,
    pub status: Option<Status>,
    /// The force along the normal, force; None where it is not determined.
    pub normal: Option<f64>,
    /// The force along the tangent, force; None where it is not determined.
    pub tangent: Option<f64>,
    /// Whether it is in contact and pressed by more than rounding.
    pub is_pressed: bool,
}

impl ContactPlace<'_> {
    /// Returns a traction, stress.
    pub fn over_area(&self, force: Option<f64>) -> Option<f64> {
        over(force?, self.area)
    }

    pub fn friction_needed(&self) -> Option<f64> {
        let normal = self.normal.filter(|_| self.is_pressed)?;
        Some(self.tangent?.abs() / normal)
    }
}

/// Returns the forces along normal and tangent of every entry from the reaction K u − F of its node,
/// force. Contact does not bind a component in which a node is restrained where `eliminated`, so
/// that its reaction is the restraint's alone; otherwise it may be contact's too, and what depends
/// on it is None.
pub fn reactions(
    model: &Model,
    pairings: &[Option<Pairing>],
    reaction: &DVector<f64>,
    eliminated: bool,
) -> Vec<[Option<f64>; 2]> {
    let of_pairing = |pairing: &Pairing| {
        let ([nx, ny], restrained) = (pairing.normal, model.restraints_of(pairing.node));
        let force = pairing.node.components(reaction);
        let [rx, ry] = [0, 1].map(|d| if restrained[d] { 0.0 } else { force[d] });
        let is_determined = match restrained {
            [false, false] => true,
            [true, true] => false,
            [true, false] => eliminated || ny.abs() > 1.0 - ACROSS,
            [false, true] => eliminated || nx.abs() > 1.0 - ACROSS,
        };
        let force = [nx * rx + ny * ry, nx * ry - ny * rx];
        force.map(|component| is_determined.then_some(component))
    };
    pairings.iter().map(|p| p.as_ref().map_or([None, None], of_pairing)).collect()
}

/// Returns a / b; None for a node that represents no length, which has no pressure.
fn over(a: f64, b: f64) -> Option<f64> {
    (b > 0.0).then_some(a / b)
}

/// Returns the distance of each entry from the first along the undeformed contact surface, length.
pub(crate) fn arcs(model: &Model) -> Vec<f64> {
    let at = |i: usize| model.coordinates(model.contact.nodes[i]);
    let mut arcs = vec![0.0; model.contact.nodes.len()];
    for i in 1..arcs.len() {
        let ([ax, ay], [bx, by]) = (at(i - 1), at(i));
        arcs[i] = arcs[i - 1] + (bx - ax).hypot(by - ay);
    }
    arcs
}
