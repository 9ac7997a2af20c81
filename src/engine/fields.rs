//! A solution by node, point and restraint, in plain numbers.

use super::quantities::SupportForce;
use super::solution::Solution;
use problem::model::NodeId;

impl Solution {
    /// Returns the displacement of a node along x and y, length; None where there is no such node.
    ///
    /// `node`: its number, from 1.
    pub fn displacement(&self, node: usize) -> Option<[f64; 2]> {
        let node = self.model.node_ids().nth(node.checked_sub(1)?)?;
        Some(node.components(&self.u))
    }

    /// Returns sigma_x, sigma_y and tau_xy at a point of the undeformed shape, stress; None outside of all triangles.
    ///
    /// Stress is constant in a triangle and jumps from one to the next: a point on a common edge has that of the
    /// triangle which the mesh lists first.
    pub fn stress_at(&self, x: f64, y: f64) -> Option<[f64; 3]> {
        let at = [x, y];
        let is_left_of = |[from, to]: [[f64; 2]; 2]| {
            let [[dx, dy], [px, py]] = [to, at].map(|[x, y]| [x - from[0], y - from[1]]);
            dx * py - dy * px >= 0.0
        };
        let has_point = |nodes: [[f64; 2]; 3]| {
            let [a, b, c] = nodes;
            [[a, b], [b, c], [c, a]].into_iter().all(is_left_of)
        };
        let model = &self.model;
        let corners = |nodes: &[_; 3]| nodes.map(|node| model.nodes[NodeId::index(node)]);
        let place = model.triangles.iter().position(|triangle| has_point(corners(&triangle.nodes)));
        Some(self.elements[place?].sigma.into())
    }

    /// Returns the force of the restraints of a group along x and y, force; None where the scene holds no such group.
    ///
    /// `group`: what a restraint of the scene names: a group, or `node 7`.
    pub fn reaction(&self, group: &str) -> Option<[f64; 2]> {
        let forces = SupportForce::all(self);
        let of_group = forces.iter().filter(|force| force.restraint == group);
        of_group.map(|force| force.reaction).reduce(|[x, y], of| [x + of[0], y + of[1]])
    }
}
