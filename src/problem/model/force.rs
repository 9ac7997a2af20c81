//! The load as the scene states it, and the forces on nodes that it comes to in any scalar.

use nalgebra::DVector;
use serde::Serialize;

use super::Model;
use super::ids::NodeId;
use crate::element::area;
use numbers::scalar::Scalar;

/// A part of the load. On an edge it is uniform, per area of edge length times thickness; the body
/// lies on the left of the way from the edge's first node to its second.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Force {
    /// A force on a node along x and y, force.
    Node(NodeId, [f64; 2]),
    /// A pressure on an edge that pushes into the body, stress.
    Pressure([NodeId; 2], f64),
    /// A force per area on an edge along x and y, stress.
    Traction([NodeId; 2], [f64; 2]),
    /// A force per volume of a triangle along x and y.
    Body([NodeId; 3], [f64; 2]),
}

impl Force {
    /// Returns the nodes on which it acts.
    pub fn nodes(&self) -> impl Iterator<Item = NodeId> + use<> {
        let nodes = match *self {
            Force::Node(node, _) => [Some(node), None, None],
            Force::Pressure([a, b], _) | Force::Traction([a, b], _) => [Some(a), Some(b), None],
            Force::Body(nodes, _) => nodes.map(Some),
        };
        nodes.into_iter().flatten()
    }

    /// Adds it to the forces `f` on all degrees of freedom of `model`; each number of the scene
    /// passes through `number`.
    pub fn add_to<T: Scalar>(&self, f: &mut DVector<T>, model: &Model, number: &impl Fn(f64) -> T) {
        let force = self.on_each_node(model, number);
        for dofs in self.nodes().map(NodeId::dofs) {
            dofs.into_iter().zip(force).for_each(|(dof, force)| f[dof.index()] += force);
        }
    }

    /// Returns the force on each of its nodes along x and y: linear edges have half of their load on each
    /// end, linear triangles a third at each corner.
    pub fn on_each_node<T: Scalar>(&self, model: &Model, number: &impl Fn(f64) -> T) -> [T; 2] {
        let (edge, pressure, traction) = match *self {
            Force::Node(_, force) => return force.map(number),
            Force::Pressure(edge, pressure) => (edge, Some(number(pressure)), [T::zero(); 2]),
            Force::Traction(edge, traction) => (edge, None, traction.map(number)),
            Force::Body(nodes, force) => {
                let corners = nodes.map(|node| model.coordinates(node).map(number));
                let part = area(&corners).abs() * number(model.thickness) / T::from_f64(3.0);
                return force.map(|x| number(x) * part);
            }
        };
        let [[ax, ay], [bx, by]] = edge.map(|node| model.coordinates(node).map(number));
        let length = T::length(bx - ax, by - ay);
        let inward = [-(by - ay) / length, (bx - ax) / length];
        let per_area = pressure.map_or(traction, |p| inward.map(|n| p * n));
        let (thickness, two) = (number(model.thickness), T::from_f64(2.0));
        per_area.map(|t| t * length * thickness / two)
    }
}
