//! What rounding may decide under `unilateral`: in the last contact state, whether an open node
//! touches, a closed one is pressed, and one that sticks would slide; and which part of the target a
//! node faces, where that counts.
//!
//! Under node to segment the latter is tried: each node is moved by the bound of its place in eight
//! directions. Under mortar its integrals are computed again with that bound. States before the last
//! one are not looked at.
//!
//! Gaps and forces are computed from displacements that are known within a bound, along the normals
//! of the last state, which count as exact. A node that touches without any force may as well be open
//! or closed: either way the state is in equilibrium, so that such a tie leaves the displacements.

use nalgebra::DVector;

use crate::answer::contact::{Pairing, Status, Surfaces};
use crate::answer::solution::Unilateral;
use crate::answer::{Detail, Solution, Stiffness};
use crate::numbers::scalar::{Bounded, Scalar, Unsure};
use crate::paper::decisions::Decision;
use crate::problem::model::NodeId;
use crate::problem::modelling::{Coupling, Geometry};

/// The rounding of a coordinate and of what a search computes from it, in units of the coordinate.
const COORDINATE: f64 = 8.0;

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
        let by = Unsure { margin: x.to_f64().abs(), bound: x.error() };
        decisions.push(Decision::unsure(solution.last().k, pairing.node, condition.into(), by));
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
    let parts = parts(solution, last, u);
    only_ties &= parts.is_empty();
    decisions.extend(parts);
    (decisions, only_ties)
}

/// Returns the decisions on which part of the target a node faces in the last state that rounding may
/// have taken and that count: of a node in contact, or of one that would touch the other part.
fn parts(solution: &Solution, last: &Unilateral, u: &DVector<Bounded>) -> Vec<Decision> {
    let (model, contact) = (&*solution.model, &solution.request.contact);
    let Ok(surfaces) = Surfaces::new(model) else { return Vec::new() };
    let is_current = contact.geometry == Geometry::Current;
    let measured_in = if is_current { &solution.last().shape } else { &model.nodes };
    let largest = measured_in.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let moved = (0..u.len()).map(|e| (u[e].to_f64() - solution.u[e]).abs() + u[e].error());
    let of_u = if is_current { moved.fold(0.0, f64::max) } else { 0.0 };
    let radius = of_u + COORDINATE * f64::EPSILON * largest;
    if !radius.is_finite() {
        // Nothing is known of the displacements.
        return Vec::new();
    }
    let k = solution.last().k;
    if contact.coupling == Coupling::Mortar {
        let within = |x: f64| Bounded::new(x, radius);
        let shape: Vec<_> = measured_in.iter().map(|place| place.map(within)).collect();
        let unsure = surfaces.mortar(&shape).unsure.into_iter();
        let condition = || "a comparison of mortar's integrals".into();
        return unsure.map(|(node, by)| Decision::unsure(k, node, condition(), by)).collect();
    }
    let entry = |node: NodeId| model.contact.nodes.iter().position(|other| *other == node);
    let counts = |(node, other): &(NodeId, Option<Pairing>)| {
        entry(*node).is_some_and(|entry| last.statuses[entry].is_closed())
            || other.as_ref().is_some_and(|other| {
                let from = |node: NodeId| model.at(node).map(Bounded::from_f64);
                let gap = opening(other, |node| node.of(u)) + opening(other, from);
                gap.to_f64() <= gap.error()
            })
    };
    let mut nodes: Vec<NodeId> = surfaces
        .facing_otherwise(measured_in, radius)
        .iter()
        .filter(|it| counts(it))
        .map(|it| it.0)
        .collect();
    nodes.dedup();
    let decision = |node| Decision {
        iteration: k,
        node,
        condition: "which part of the target it faces".into(),
        margin: None,
        bound: Some(radius),
    };
    nodes.into_iter().map(decision).collect()
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
