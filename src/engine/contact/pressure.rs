//! The traction on the contact surface at the end of a run of any variant: the reaction K u − F of
//! the contact body's equations.

use nalgebra::DVector;

use super::pairing::{Pairing, Status, Vector};
use super::surface::{SAME, Surfaces};
use crate::quantities::ContactNode;
use crate::reactions::unheld;
use problem::element::Plane;
use problem::model::{Material, Model, NodeId};

/// The force over the largest of a surface, or of the load, below which it is rounding.
pub const ROUNDING_OF_A_FORCE: f64 = 1e-11;

/// Returns the nodes in contact that pull by more than rounding; the largest force of the load is `load`.
pub fn pulling(surface: &[ContactNode], load: f64) -> Vec<NodeId> {
    let least = ROUNDING_OF_A_FORCE * largest(surface.iter().map(|node| node.force)).max(load);
    let pulls = |node: &&ContactNode| node.force.is_some_and(|force| force < -least);
    surface.iter().filter(|node| node.in_contact).filter(pulls).map(|node| node.node).collect()
}

/// Returns for each node the force up to which what the stresses about it leave of its equation is rounding,
/// as after a motion that strains nothing: some digits' end of |K| |u|.
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

/// What a run ends with at a contact node that faces the target.
pub struct NodeEnd {
    /// The distance from the target along its normal, length.
    pub gap: f64,
    /// Whether it is in contact.
    pub in_contact: bool,
    /// Its status; None where the variant has no such statuses.
    pub status: Option<Status>,
    /// The force along normal and tangent, force; None where it is not determined.
    pub force: Option<[f64; 2]>,
}

impl Surfaces {
    /// Returns the contact nodes that face the target after displacements `u` of a model, length, in order
    /// along the surface. `pairings` are those in the shape in which contact is measured, which has the
    /// coordinates of each node, length; `end` receives each of them with its entry.
    pub fn nodes_at_end<'a>(
        &self,
        (model, u): (&Model, &DVector<f64>),
        (measured_in, pairings): (&[Vector], &'a [Option<Pairing>]),
        end: impl Fn(usize, &Pairing) -> NodeEnd,
    ) -> Vec<ContactNode> {
        let entries = pairings.iter().enumerate();
        let facing: Vec<(usize, &'a Pairing, NodeEnd)> = entries
            .filter_map(|(i, p)| p.as_ref().map(|pairing| (i, pairing, end(i, pairing))))
            .collect();
        let lengths = [&model.nodes, measured_in].map(|shape| self.tributary(shape));
        let (arcs, rounding) = (arcs(model), rounding(model, u));
        let pressing = facing.iter().map(|(_, _, end)| end.force.map(|[normal, _]| normal));
        let least = ROUNDING_OF_A_FORCE * largest(pressing);
        let node = |(i, pairing, mut end): (usize, &'a Pairing, NodeEnd)| {
            let stretch = lengths[1][i] / lengths[0][i];
            let area = over(pairing.length, stretch).unwrap_or(0.0) * model.thickness;
            let rounding = rounding[pairing.node.index()];
            for part in end.force.iter_mut().flatten().filter(|part| part.abs() <= rounding) {
                *part = 0.0;
            }
            ContactNode::compute(&ContactPlace {
                pairing,
                arc: arcs[i],
                area,
                least: least.max(rounding),
                end,
            })
        };
        facing.into_iter().map(node).collect()
    }
}

/// A contact node that faces the target.
pub(crate) struct ContactPlace<'a> {
    pub pairing: &'a Pairing,
    /// Its distance along the undeformed surface, length.
    pub arc: f64,
    /// The undeformed surface that it represents, length · thickness.
    area: f64,
    /// The force up to which it presses by rounding alone, force.
    least: f64,
    pub end: NodeEnd,
}

impl ContactPlace<'_> {
    /// Returns the force along the normal, 0, or the tangent, 1, force.
    pub fn force(&self, along: usize) -> Option<f64> {
        self.end.force.map(|force| force[along])
    }

    /// Returns the same over the area, stress.
    pub fn traction(&self, along: usize) -> Option<f64> {
        over(self.force(along)?, self.area)
    }

    pub fn friction_needed(&self) -> Option<f64> {
        let [normal, tangent] = self.end.force?;
        (self.end.in_contact && normal > self.least).then(|| tangent.abs() / normal)
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
) -> Vec<Option<[f64; 2]>> {
    let of_pairing = |pairing: &Pairing| {
        let ([nx, ny], restrained) = (pairing.normal, model.restraints_of(pairing.node));
        let [rx, ry] = unheld(model, pairing.node, reaction);
        let is_determined = match restrained {
            [false, false] => true,
            [true, true] => false,
            [true, false] => eliminated || ny.abs() > 1.0 - SAME,
            [false, true] => eliminated || nx.abs() > 1.0 - SAME,
        };
        is_determined.then_some([nx * rx + ny * ry, nx * ry - ny * rx])
    };
    pairings.iter().map(|p| p.as_ref().and_then(of_pairing)).collect()
}

/// Returns a / b; None for a node that represents no length, which has no pressure.
fn over(a: f64, b: f64) -> Option<f64> {
    (b > 0.0).then_some(a / b)
}

/// Returns the distance of each entry from the first along the undeformed contact surface, length.
pub(crate) fn arcs(model: &Model) -> Vec<f64> {
    let nodes = &model.contact.nodes;
    let mut arcs = vec![0.0; nodes.len()];
    for i in 1..arcs.len() {
        arcs[i] = arcs[i - 1] + model.length([nodes[i - 1], nodes[i]]);
    }
    arcs
}
