//! A solution by node, point and restraint, in plain numbers.

use super::contact::search::is_in_triangle;
use super::quantities::SupportForce;
use super::solution::Solution;
use problem::model::{NodeId, TriangleId};

impl Solution {
    /// Returns the displacement of a node along x and y, length; None where there is no such node.
    ///
    /// `node`: its number, from 1.
    pub fn displacement(&self, node: usize) -> Option<[f64; 2]> {
        let is_there = (1..=self.model.nodes.len()).contains(&node);
        is_there.then(|| NodeId::from_number(node).components(&self.u))
    }

    /// Returns sigma_x, sigma_y and tau_xy at a point of the undeformed shape, stress; None outside of all
    /// triangles.
    ///
    /// Stress is constant in a triangle and jumps from one to the next: a point on a common edge has that of
    /// the triangle which the mesh lists first.
    pub fn stress_at(&self, x: f64, y: f64) -> Option<[f64; 3]> {
        let has_point =
            |triangle: &TriangleId| is_in_triangle(self.model.corners(*triangle), [x, y]);
        let triangle = self.model.triangle_ids().find(has_point)?;
        Some(self.elements[triangle.index()].sigma.into())
    }

    /// Returns the force of the restraints of a group along x and y, force; None where the scene holds no
    /// such group.
    ///
    /// `group`: what a restraint of the scene names: a group, or `node 7`.
    pub fn reaction(&self, group: &str) -> Option<[f64; 2]> {
        let forces = SupportForce::all(self);
        let of_group = forces.iter().filter(|force| force.restraint == group);
        of_group.map(|force| force.reaction).reduce(|[x, y], of| [x + of[0], y + of[1]])
    }
}
