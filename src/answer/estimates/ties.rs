//! What rounding may decide under `unilateral`: in the last contact state, whether an open node
//! touches, a closed one is pressed, and one that sticks would slide.
//!
//! Gaps and forces are computed from displacements that are known within a bound, along the normals
//! of the last state, which count as exact. A node that touches without any force may as well be open
//! or closed: either way the state is in equilibrium, so that such a tie leaves the displacements.

use nalgebra::DVector;

use crate::answer::contact::{Pairing, Status};
use crate::answer::{Detail, Solution, Stiffness};
use crate::numbers::scalar::{Bounded, Scalar};
use crate::paper::decisions::Decision;
use crate::problem::model::NodeId;

/// Returns the decisions of the last state that rounding may have taken, from its displacements `u`
/// within their bounds, and whether all of them are ties that leave the displacements.
pub fn ties(solution: &Solution, u: &DVector<Bounded>) -> (Vec<Decision>, bool) {
    let model = &*solution.model;
    let Detail::Unilateral(last) = &solution.last().detail else { return (Vec::new(), true) };
    let load = model.load_in(Bounded::from_f64) + last.friction.map(Bounded::from_f64);
    let reaction = Stiffness::new(model, Bounded::from_f64).times(u) - load;
    let coefficient = solution.request.contact.friction.coefficient();
    let (mut decisions, mut only_ties) = (Vec::new(), true);
    let mut leave = |pairing: &Pairing, condition: &str, x: Bounded| {
        decisions.push(Decision {
            iteration: solution.last().k,
            node: pairing.node,
            condition: condition.into(),
            margin: Some(x.to_f64().abs()),
            bound: Some(x.error()).filter(|bound| bound.is_finite()),
        });
    };
    for (status, pairing) in last.statuses.iter().zip(&last.pairings) {
        let Some(pairing) = pairing else { continue };
        if *status == Status::Open {
            let from = |node: NodeId| model.at(node).map(Bounded::from_f64);
            let gap = opening(pairing, |node| node.of(u)) + opening(pairing, from);
            if is_left(gap) {
                leave(pairing, "touches without force: gap > 0", gap);
            }
        } else if model.restraints_of(pairing.node) == [false, false] {
            // Restraints of the node would hide its force.
            let [nx, ny] = pairing.normal.map(Bounded::from_f64);
            let [rx, ry] = pairing.node.of(&reaction);
            let (pressed, shear) = (nx * rx + ny * ry, nx * ry - ny * rx);
            if is_left(pressed) && is_left(shear) {
                leave(pairing, "touches without force: force >= 0", pressed);
                continue;
            }
            let limit = Bounded::from_f64(coefficient) * pressed - Scalar::abs(shear);
            let sticks = *status == Status::Stick && coefficient.is_finite();
            for (counts, condition, x) in
                [(true, "force >= 0", pressed), (sticks, "friction * force >= |shear|", limit)]
            {
                if counts && is_left(x) {
                    only_ties = false;
                    leave(pairing, condition, x);
                }
            }
        }
    }
    (decisions, only_ties)
}

/// Returns whether the sign of a number is left to rounding.
fn is_left(x: Bounded) -> bool {
    x.to_f64().abs() <= x.error() && x.error() > 0.0
}

/// Returns n·(v_c − Σ w v_t) of a field, as [`Pairing::opening`] does.
fn opening(pairing: &Pairing, of_node: impl Fn(NodeId) -> [Bounded; 2]) -> Bounded {
    let at = of_node(pairing.node);
    let component = |axis: usize| {
        pairing.masters.iter().fold(Bounded::from_f64(0.0), |sum, &(master, w)| {
            sum + Bounded::from_f64(w) * (at[axis] - of_node(master)[axis])
        })
    };
    let [nx, ny] = pairing.normal.map(Bounded::from_f64);
    nx * component(0) + ny * component(1)
}
