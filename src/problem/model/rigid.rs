//! The motions of a body as a rigid one, and which of them its restraints leave free.

use std::collections::HashSet;

use nalgebra::{Matrix3, Matrix3xX, Vector3};

use super::Model;
use super::ids::NodeId;
use base::plain::six_digits;

/// The stiffness, over the largest, up to which a motion is free of force.
pub const FREE: f64 = 1e-12;

/// The turn of a rigid motion, over its size, below which it is a translation to rounding.
const SLIDES: f64 = 1e-6;

/// The motions of some nodes as a rigid body: along x, along y, and a turn about their middle.
pub struct RigidBody {
    /// The middle of the nodes, length.
    pub middle: [f64; 2],
    /// The arm of a turn of size 1, length: the farthest node's.
    pub size: f64,
    /// The Gram matrix of the motions that are held.
    held: Matrix3<f64>,
}

impl RigidBody {
    /// Takes the nodes at some places, length, for a body that nothing holds.
    pub fn new(places: impl Iterator<Item = [f64; 2]> + Clone) -> Self {
        let add = |[x, y]: [f64; 2], p: [f64; 2]| [x + p[0], y + p[1]];
        let count = places.clone().count() as f64;
        let middle = places.clone().fold([0.0; 2], add).map(|sum| sum / count);
        let mut body = RigidBody { middle, size: 0.0, held: Matrix3::zeros() };
        body.size = places.map(|p| body.far(p)).fold(0.0, f64::max);
        body
    }

    /// Returns the distance of a place from the middle, length.
    pub fn far(&self, [x, y]: [f64; 2]) -> f64 {
        (x - self.middle[0]).hypot(y - self.middle[1])
    }

    /// Returns how far each motion moves a place along a direction.
    pub fn motion(&self, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) -> Vector3<f64> {
        let [mx, my] = self.middle;
        Vector3::new(dx, dy, (dy * (x - mx) - dx * (y - my)) / self.size)
    }

    /// Holds a place along a direction.
    pub fn hold(&mut self, place: [f64; 2], direction: [f64; 2]) {
        let motion = self.motion(place, direction);
        self.held += motion * motion.transpose();
    }

    /// Returns an orthonormal basis of the motions that what is held leaves free.
    pub fn free(&self) -> Matrix3xX<f64> {
        let eigen = self.held.symmetric_eigen();
        let least = FREE * eigen.eigenvalues.amax();
        let free: Vec<usize> = (0..3).filter(|i| eigen.eigenvalues[*i] <= least).collect();
        eigen.eigenvectors.select_columns(&free)
    }
}

/// Returns how the part with these nodes can still move as a rigid body under its restraints, and with some
/// of its nodes `pinned`, in words; None where it cannot move.
pub fn freedom(model: &Model, nodes: &[NodeId], pinned: &[NodeId]) -> Option<String> {
    let mut body = RigidBody::new(nodes.iter().map(|&n| model.coordinates(n)));
    let inside: HashSet<NodeId> = nodes.iter().copied().collect();
    let own = model.holds.iter().filter(|hold| inside.contains(&hold.node));
    let own = own.map(|hold| (hold.node, hold.direction));
    let pins = pinned.iter().flat_map(|node| node.dofs()).map(|dof| (dof.node(), dof.unit()));
    own.chain(pins).for_each(|(node, direction)| body.hold(model.coordinates(node), direction));
    if body.held[(0, 0)] == 0.0 {
        return Some("move in x".into());
    } else if body.held[(1, 1)] == 0.0 {
        return Some("move in y".into());
    }
    let free = body.free();
    let motion = free.column_iter().next()?;
    let [dx, dy, turn] = [motion[0], motion[1], motion[2]];
    Some(if turn.abs() < SLIDES {
        format!("slide along [{}, {}]", six_digits(dx), six_digits(dy))
    } else {
        let ([cx, cy], size) = (body.middle, body.size);
        let [x, y] = [cx - size * dy / turn, cy + size * dx / turn];
        // Six digits of the body's size: what is left of 0 is rounding.
        let at = |x: f64| six_digits(if x.abs() < 1e-9 * size { 0.0 } else { x });
        format!("rotate about {}, {}", at(x), at(y))
    })
}
