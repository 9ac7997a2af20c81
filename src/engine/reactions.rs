//! The force that contact passes from one body to the other, from what holds the body that receives
//! it: the forces on its restraints, some of them through constraints, and its own load.

use nalgebra::DVector;

use super::contact::ROUNDING_OF_A_FORCE;
use super::elimination::{Constraint, sum};
use numbers::scalar::Scalar;
use problem::model::{Dof, Hold, Model, NodeId};

/// Returns the bodies on either side of contact, by their indices: those of the contact surface and those of
/// the target. A body that has both, as one in a stack, is on neither side where others are left. None
/// without contact.
pub(super) fn sides(model: &Model) -> Option<[Vec<usize>; 2]> {
    let with = |nodes: &[NodeId]| -> Vec<usize> {
        let has = |b: &usize| nodes.iter().any(|node| model.bodies[*b].has(*node));
        (0..model.bodies.len()).filter(has).collect()
    };
    let contact = with(&model.contact.nodes);
    let target = with(&model.target_edges().map(|edge| edge.nodes[0]).collect::<Vec<_>>());
    let without = |side: &[usize], other: &[usize]| -> Vec<usize> {
        let alone: Vec<usize> = side.iter().filter(|b| !other.contains(b)).copied().collect();
        if alone.is_empty() { side.to_vec() } else { alone }
    };
    let sides = [without(&contact, &target), without(&target, &contact)];
    (!contact.is_empty()).then_some(sides)
}

/// Returns the bodies to which contact passes its force: those of the target, or those of the contact surface
/// where the load acts on the target alone; none without contact.
fn receivers(model: &Model) -> Vec<usize> {
    let Some([contact, target]) = sides(model) else { return Vec::new() };
    let swapped = is_loaded(model, &target) && !is_loaded(model, &contact);
    if swapped { contact } else { target }
}

/// Returns whether a load acts on some bodies, beyond rounding.
fn is_loaded(model: &Model, bodies: &[usize]) -> bool {
    let least = ROUNDING_OF_A_FORCE * model.load.amax();
    dofs(model, bodies).any(|dof| model.load[dof.index()].abs() > least)
}

/// Returns the sum of the receivers' reactions and of their own load, force: what contact passes to them,
/// with the opposite sign; and what contact adds to the forces on the restraints of both bodies, by degree of
/// freedom, force: a restrained target node passes its part of a contact node's force on. `force` is K·u − F
/// and `load` is F, by degree of freedom.
pub fn support<T: Scalar>(
    model: &Model,
    constraints: &[Constraint<T>],
    force: &DVector<T>,
    load: &DVector<T>,
) -> ([T; 2], DVector<T>) {
    let mut total = support_force(model, force, load);
    let mut passed = DVector::from_element(model.dofs(), T::zero());
    let receivers = receivers(model);
    for constraint in constraints {
        let own = unheld(model, constraint.node, force);
        for direction in [0, 1] {
            let masters = constraint.masters.iter().map(|(node, w)| (node.dofs()[direction], *w));
            let restrained = masters.filter(|(dof, _)| model.is_restrained(*dof));
            for (dof, weight) in restrained.clone() {
                passed[dof.index()] += weight * own[direction];
            }
            let is_received = |dof: Dof| receivers.iter().any(|b| model.bodies[*b].has(dof.node()));
            let received = restrained.filter(|(dof, _)| is_received(*dof));
            total[direction] += sum(received.map(|(_, weight)| weight)) * own[direction];
        }
    }
    (total, passed)
}

/// Returns the forces of the restraints alone by degree of freedom, force, from the forces on them.
pub fn reactions(model: &Model, mut force: DVector<f64>) -> DVector<f64> {
    let takes = |dof: Dof| model.holds.takes(dof) && !model.is_dropped(dof.node());
    model.all_dofs().filter(|dof| !takes(*dof)).for_each(|dof| force[dof.index()] = 0.0);
    force
}

/// Returns the sum of the forces of each restraint of the scene along x and y, force.
pub fn reactions_of_restraints(model: &Model, reactions: &DVector<f64>) -> Vec<[f64; 2]> {
    // The force on a node that is held along two directions is one along each of them.
    let along = |hold: &Hold| {
        let (force, [x, y]) = (hold.node.components(reactions), hold.direction);
        let other = model.holds.of(hold.node).iter().find(|other| other.direction != [x, y]);
        let normal = other.map_or([x, y], |Hold { direction: [x, y], .. }| [-y, *x]);
        let size = (normal[0] * force[0] + normal[1] * force[1]) / (normal[0] * x + normal[1] * y);
        [size * x, size * y]
    };
    let mut sums = vec![[0.0; 2]; model.restraints.len()];
    for (k, hold) in model.holds.iter().filter_map(|hold| Some((hold.restraint?, hold))) {
        let ([x, y], own) = (along(hold), &mut sums[k]);
        *own = [own[0] + x, own[1] + y];
    }
    sums
}

/// Returns which part of the load a force along it, as `transmitted_force` has it, is. None where that says
/// nothing: no load acts, or not on one side of contact alone, the loads cancel each other, or a lever makes
/// the force larger than the load, or turns it round.
pub fn share_of_load(model: &Model, force: f64) -> Option<f64> {
    /// How far a share may be beyond 0 and 1: what is left of loads that cancel, and solving, round.
    const ROUNDING: f64 = 1e-6;
    let sides = sides(model).filter(|[contact, target]| contact != target)?;
    let loaded = (0..model.bodies.len()).filter(|b| is_loaded(model, &[*b]));
    let loaded: Vec<usize> = loaded.collect();
    let is_one_side = sides.iter().any(|side| loaded.iter().all(|b| side.contains(b)));
    let [fx, fy] = model.total_load();
    let size = fx.hypot(fy);
    let sizes = model.node_ids().map(|node| node.components(&model.load));
    let all: f64 = sizes.map(|[x, y]| x.hypot(y)).sum();
    let share = force / size;
    let says = !loaded.is_empty()
        && is_one_side
        && size > ROUNDING * all
        && (share - 0.5).abs() <= 0.5 + ROUNDING;
    says.then_some(share)
}

/// Returns the part of a force on a node that nothing holds, by degree of freedom, force.
pub fn unheld<T: Scalar>(model: &Model, node: NodeId, force: &DVector<T>) -> [T; 2] {
    let (held, force) = (model.restraints_of(node), node.components(force));
    [0, 1].map(|d| if held[d] { T::zero() } else { force[d] })
}

/// Returns the sum of `force` over the restraints of the receivers, and of `load` over all of them, force.
pub(super) fn support_force<T: Scalar>(
    model: &Model,
    force: &DVector<T>,
    load: &DVector<T>,
) -> [T; 2] {
    let mut total = [T::zero(), T::zero()];
    let receivers = receivers(model);
    for dof in dofs(model, &receivers) {
        if model.holds.takes(dof) {
            total[dof.direction()] += force[dof.index()];
        }
        if !load[dof.index()].is_zero() {
            total[dof.direction()] += load[dof.index()];
        }
    }
    total
}

/// Returns whether each degree of freedom is one of the receivers that the run restrains.
pub(super) fn supports(model: &Model) -> Vec<bool> {
    let mut supports = vec![false; model.dofs()];
    dofs(model, &receivers(model)).for_each(|dof| supports[dof.index()] = model.holds.takes(dof));
    supports
}

fn dofs<'a>(model: &'a Model, bodies: &'a [usize]) -> impl Iterator<Item = Dof> + 'a {
    bodies.iter().flat_map(|b| &model.bodies[*b].nodes).flat_map(|node| node.dofs())
}

/// Returns the force that contact passes on, force, where `held` holds the receivers: along the load
/// where the load acts on one side of contact alone, else its size.
pub fn transmitted_force(model: &Model, held: [f64; 2]) -> f64 {
    let [rx, ry] = held;
    let [fx, fy] = model.total_load();
    let size = fx.hypot(fy);
    if size == 0.0 || is_loaded(model, &receivers(model)) {
        return rx.hypot(ry);
    }
    // 0 − x rather than −x: without any reaction the result is 0, not −0.
    0.0 - (rx * (fx / size) + ry * (fy / size))
}
