//! The support of the target: the forces on its restraints, some of them through constraints.

use nalgebra::DVector;

use super::elimination::{Constraint, Motion, sum};
use crate::numbers::scalar::Scalar;
use crate::problem::model::{Dof, Model};

/// Returns the sum of the target body's reactions, force. `force` is K·u − F by degree of freedom;
/// `restrained` marks the degrees of freedom that the run restrains.
pub fn support<T: Scalar>(
    model: &Model,
    restrained: &[bool],
    constraints: &[Constraint<T>],
    force: &DVector<T>,
) -> [T; 2] {
    let mut total = restraints_of_target(model, restrained, force);
    if model.target().is_none() {
        return total;
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
        Motion::Along(normal, _) => {
            let along = normal[0] * force[0] + normal[1] * force[1];
            normal.map(|n| n * along)
        }
    }
}

/// Returns the sum of `force` over the restraints of the target body, force.
pub(super) fn restraints_of_target<T: Scalar>(
    model: &Model,
    restrained: &[bool],
    force: &DVector<T>,
) -> [T; 2] {
    let mut total = [T::zero(), T::zero()];
    for dof in dofs_of_target(model).filter(|dof| restrained[dof.index()]) {
        total[dof.direction()] += force[dof.index()];
    }
    total
}

/// Returns whether each degree of freedom is one of the target body that the run restrains.
pub(super) fn supports_of_target(model: &Model, restrained: &[bool]) -> Vec<bool> {
    let mut supports = vec![false; model.dofs()];
    dofs_of_target(model).for_each(|dof| supports[dof.index()] = restrained[dof.index()]);
    supports
}

fn dofs_of_target(model: &Model) -> impl Iterator<Item = Dof> {
    let nodes = model.target().into_iter().flat_map(|target| &target.nodes);
    nodes.flat_map(|node| node.dofs())
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
