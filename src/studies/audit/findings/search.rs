//! Findings of the search for a target edge: c_cnt 1-10.

use super::Evidence;
use super::experiment::{
    Shape, at_calls, at_shapes, c_cnt, count_nodes, ends, inside_target, place, rise, said,
};
use crate::audit::Case;
use crate::audit::evidence::Outcome;
use base::plain::six_digits;
use engine::contact::turned;
use paper::door::ContactStatus;
use problem::model::{EdgeId, Model};

/// C1: the target edges reversed.
pub(super) fn turned_edges(case: &Case) -> Outcome<Evidence> {
    let state = |status: &ContactStatus| (status.edge.is_some(), status.in_contact);
    compared(case, &turned(case.model()), "each target edge is reversed", |own, other| {
        state(own) != state(other)
    })
}

/// C2: `trg` in reverse.
pub(super) fn reversed_target(case: &Case) -> Outcome<Evidence> {
    let mut reversed = case.model().clone();
    reversed.contact.target.reverse();
    compared(case, &reversed, "trg is reversed", |own, other| own.edge != other.edge)
}

/// Counts the contact nodes whose status on another model differs: the listing's `ct` and `dy`.
fn compared(
    case: &Case,
    other: &Model,
    name: &str,
    differ: impl Fn(&ContactStatus, &ContactStatus) -> bool,
) -> Outcome<Evidence> {
    at_shapes(case, |shape| {
        let calls = [c_cnt(case, case.model(), shape)?, c_cnt(case, other, shape)?];
        Ok(count_nodes(case.model(), |i| {
            let [own, other] = calls.each_ref().map(|call| &call.statuses[i]);
            let words = || format!("{}, but once {name} it {}", said(case, own), said(case, other));
            differ(own, other).then(words)
        }))
    })
}

/// C3: contact nodes nearer than c_tll to the line of their edge, but not vertically; a vertical
/// edge stops the listing.
pub(super) fn vertical_distance(case: &Case) -> Outcome<Evidence> {
    at_shapes(case, |shape| match c_cnt(case, case.model(), shape) {
        Ok(call) => Ok(count_nodes(case.model(), |i| {
            let status = call.statuses[i];
            let [a, b] = ends(case.model(), shape, status.edge.filter(|_| !status.in_contact)?);
            let cosine = (b[0] - a[0]).abs() / (b[0] - a[0]).hypot(b[1] - a[1]);
            let along = status.distance.abs() * cosine;
            let words = || {
                let (said, along) = (said(case, &status), six_digits(along));
                format!("{said}, although it is {along} from it along the normal")
            };
            (along < case.model().contact.tolerance).then(words)
        })),
        Err(failure) if failure.line == 10 => {
            Ok(Evidence::present_if(true, 0.0, failure.to_string()))
        }
        Err(failure) => Err(failure),
    })
}

/// C9: contact nodes inside the target, c_tll or more from the edges above or below them, without a
/// target edge.
pub(super) fn lost_inside(case: &Case) -> Outcome<Evidence> {
    let model = case.model();
    at_calls(case, |shape, call| {
        count_nodes(model, |i| {
            let nearest = nearest(model, shape, i);
            let deep = nearest.is_none_or(|(_, below)| below.abs() >= model.contact.tolerance);
            let lost = call.statuses[i].edge.is_none() && deep && inside_target(model, shape, i);
            let place = nearest.map_or("lies".into(), |(edge, below)| place(case, edge, below));
            lost.then(|| format!("{place}, inside the target, and {LOST}"))
        })
    })
}

/// C14: contact nodes over or under a target edge, nearer than c_tll, without a target edge.
pub(super) fn missed_near(case: &Case) -> Outcome<Evidence> {
    let model = case.model();
    at_calls(case, |shape, call| {
        count_nodes(model, |i| {
            let (edge, below) = nearest(model, shape, i)?;
            let near = call.statuses[i].edge.is_none() && below.abs() < model.contact.tolerance;
            near.then(|| format!("{}, and {LOST}", place(case, edge, below)))
        })
    })
}

/// What becomes of a node without a target edge.
const LOST: &str = "the search finds no edge for it";

/// The nearest of the target edges that entry `i` of the contact surface is over or under, and how far below
/// it that lies.
fn nearest(model: &Model, shape: &Shape, i: usize) -> Option<(EdgeId, f64)> {
    let point = shape[model.contact.nodes[i].index()];
    let below = |edge: &EdgeId| {
        let [a, b] = ends(model, shape, *edge);
        let over = a[0].min(b[0]) <= point[0] && point[0] <= a[0].max(b[0]);
        rise([a, b], point).filter(|_| over).map(|below| (*edge, below))
    };
    let edges = model.contact.target.iter().filter_map(below);
    edges.min_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))
}
