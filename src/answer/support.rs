//! The support of the target: the forces on its restraints, some of them through constraints.

use nalgebra::DVector;

use super::contact::Pairing;
use super::elimination::{Constraint, Motion, sum};
use crate::numbers::scalar::Scalar;
use crate::problem::model::{Model, NodeId};

/// Returns the sum of the target body's reactions, force. `force` is K·u − F by degree of freedom;
/// `restrained` marks the degrees of freedom that the run restrains.
pub fn support<T: Scalar>(
    model: &Model,
    restrained: &[bool],
    constraints: &[Constraint<T>],
    force: &DVector<T>,
) -> [T; 2] {
    let mut total = [T::zero(), T::zero()];
    let Some(target) = model.target() else { return total };
    for dof in target.nodes.iter().flat_map(|n| n.dofs()).filter(|d| restrained[d.index()]) {
        total[dof.direction()] += force[dof.index()];
    }
    for constraint in constraints {
        let passed = passed(constraint, restrained, force);
        for direction in [0, 1] {
            let to_restrained = constraint
                .masters
                .iter()
                .filter(|(master, _)| restrained[master.dofs()[direction].index()]);
            total[direction] += sum(to_restrained.map(|(_, w)| *w)) * passed[direction];
        }
    }
    total
}

/// Returns the contact force on a constrained node, force.
fn passed<T: Scalar>(
    constraint: &Constraint<T>,
    restrained: &[bool],
    force: &DVector<T>,
) -> [T; 2] {
    let free = constraint.node.dofs().map(|dof| !restrained[dof.index()]);
    let force = constraint.node.of(force);
    match constraint.motion {
        Motion::Both(_) => [0, 1].map(|d| if free[d] { force[d] } else { T::zero() }),
        Motion::Along(normal, _) => normal.map(|n| n * along(normal, free, force)),
    }
}

/// Returns the component along `normal` of a force that acts along it, from the components in which
/// no restraint has a share, force.
fn along<T: Scalar>(normal: [T; 2], free: [bool; 2], force: [T; 2]) -> T {
    match free {
        [true, true] => normal[0] * force[0] + normal[1] * force[1],
        [false, true] => force[1] / normal[1],
        [true, false] => force[0] / normal[0],
        [false, false] => T::zero(),
    }
}

/// Returns a contact force's component along the normal, force; where one direction of the node is
/// restrained, it follows from the other one.
pub(super) fn normal_force(model: &Model, pairing: &Pairing, reaction: &DVector<f64>) -> f64 {
    let free = free(model, pairing.node);
    along(pairing.normal, free, pairing.node.of(reaction))
}

fn free(model: &Model, node: NodeId) -> [bool; 2] {
    model.restraints_of(node).map(|restrained| !restrained)
}

/// Returns the reactions against the direction of the load, force.
pub fn against_load(model: &Model, [rx, ry]: [f64; 2]) -> f64 {
    let [fx, fy] = model.total_load();
    let size = fx.hypot(fy);
    if size == 0.0 {
        return rx.hypot(ry);
    }
    // 0 − x rather than −x: without any reaction the result is 0, not −0.
    0.0 - (rx * (fx / size) + ry * (fy / size))
}
