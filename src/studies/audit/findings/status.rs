//! Findings of the contact status: c_cnt 15-18.

use super::experiment::{Shape, at_calls, at_shapes, c_cnt, count_nodes, inner_sign, said};
use super::{Evidence, Presence};
use crate::audit::Case;
use crate::audit::evidence::Outcome;
use mathcad::Conjunction;
use paper::door::Call;
use paper::mirror::{Cause, Reading};
use problem::model::NodeId;

/// A shape with every y changed by `f(node, y)`.
fn with_y(shape: &Shape, f: impl Fn(NodeId, f64) -> f64) -> Vec<[f64; 2]> {
    NodeId::all(shape.len()).zip(shape).map(|(node, [x, y])| [*x, f(node, *y)]).collect()
}

/// C4: the scene upside down. Only nodes that keep their target edge count: C1 is kept out.
pub(super) fn upside_down(case: &Case) -> Outcome<Evidence> {
    at_shapes(case, |shape| {
        let as_is = c_cnt(case, case.model(), shape)?;
        let mirrored = c_cnt(case, case.model(), &with_y(shape, |_, y| -y))?;
        Ok(count_nodes(case.model(), |i| {
            let (own, other) = (as_is.statuses[i], mirrored.statuses[i]);
            let words =
                || format!("{}, but upside down it {}", said(case, &own), said(case, &other));
            (own.edge == other.edge && own.in_contact != other.in_contact).then(words)
        }))
    })
}

/// C5: of runs of two or more neighbours deeper inside than c_tll, those that are not flagged.
pub(super) fn deep_runs(case: &Case) -> Outcome<Evidence> {
    let model = case.model();
    at_calls(case, |shape, call| {
        let least = model.contact.tolerance.max(f64::MIN_POSITIVE);
        let deep = |i: usize| {
            let Some(status) = call.statuses.get(i) else { return false };
            let sign = status.edge.and_then(|edge| inner_sign(model, shape, edge));
            sign.is_some_and(|sign| sign * status.distance >= least)
        };
        let beside = |i: usize| i.checked_sub(1).is_some_and(deep) || deep(i + 1);
        count_nodes(model, |i| {
            let status = call.statuses[i];
            let missed = !status.in_contact && deep(i) && beside(i);
            missed.then(|| said(case, &status))
        })
    })
}

/// C8: c_tll = 0: nodes on their edge that are not flagged.
pub(super) fn strictly_less(case: &Case) -> Outcome<Evidence> {
    let mut model = case.model().clone();
    model.contact.tolerance = 0.0;
    at_shapes(case, |shape| {
        let call = c_cnt(case, &model, shape)?;
        let touches =
            |i: usize| call.statuses[i].edge.is_some() && call.statuses[i].distance == 0.0;
        let flagged = |i: usize| call.statuses[i].in_contact;
        let words = |i: usize| said(case, &call.statuses[i]);
        let on_edge = count_nodes(&model, |i| touches(i).then(|| words(i)));
        if (0..call.statuses.len()).any(|i| touches(i) && flagged(i)) {
            return Ok(Evidence { verdict: Presence::Contradicted, ..on_edge });
        }
        let by_sign = count_nodes(&model, |i| flagged(i).then(|| words(i))).detail;
        let detail = format!("{}; by lines 17 and 18, {by_sign}", on_edge.detail);
        Ok(Evidence { detail, ..on_edge })
    })
}

/// C10: `∧` evaluated from left to right, at the initial shape.
pub(super) fn left_to_right(case: &Case) -> Outcome<Evidence> {
    let reading = Reading { r4: Conjunction::LeftToRight, ..*case.reading() };
    let call = case.initial().map_err(|_| "c_cnt fails before line 18")?;
    let first = call.statuses.first().ok_or("no contact node")?.distance;
    if first >= 0.0 {
        return Ok(Evidence::present_if(false, first, "yt[1] is not below 0"));
    }
    match Call::c_cnt(case.model(), &reading, &case.model().nodes) {
        Err(f) if f.line == 18 && f.cause == Cause::InvalidIndex => {
            Ok(Evidence::present_if(true, first, f.to_string()))
        }
        Err(other) => Err(other.into()),
        Ok(_) => {
            Ok(Evidence::must_be_present(false, first, "yt[1] < 0, and line 18 does not stop"))
        }
    }
}

/// C11: nodes that lie on their edge but for rounding, moved up and down by as much: whose status
/// follows?
pub(super) fn rounding_noise(case: &Case) -> Outcome<Evidence> {
    let model = case.model();
    at_shapes(case, |shape| {
        let call = c_cnt(case, model, shape)?;
        // What rounding may leave of a difference of coordinates: yt takes some ten operations.
        let largest = shape.as_flattened().iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let noise = 16.0 * f64::EPSILON * largest;
        let on_edge =
            |i: usize| call.statuses[i].edge.is_some() && call.statuses[i].distance.abs() <= noise;
        let touching = |node: NodeId| {
            let mut entries = model.contact.nodes.iter().enumerate();
            entries.any(|(i, other)| *other == node && on_edge(i))
        };
        let moved = |by: f64| with_y(shape, |node, y| if touching(node) { y + by } else { y });
        let up = c_cnt(case, model, &moved(2.0 * noise))?;
        let down = c_cnt(case, model, &moved(-2.0 * noise))?;
        Ok(count_nodes(model, |i| {
            let [own, up, down] = [&call, &up, &down].map(|call| call.statuses[i]);
            let way = if up.in_contact { "up" } else { "down" };
            let words = || {
                format!(
                    "{} once its neighbour moves {way} by {noise:.0e}, else not",
                    said(case, &own)
                )
            };
            (!on_edge(i) && up.in_contact != down.in_contact).then(words)
        }))
    })
}

/// C15: nodes flagged only because a neighbour that is itself within c_tll has yt > 0.
pub(super) fn touching_neighbour(case: &Case) -> Outcome<Evidence> {
    let tolerance = case.model().contact.tolerance;
    at_calls(case, |_, call| {
        count_nodes(case.model(), |i| {
            let status = call.statuses[i];
            let beside = [i.checked_sub(1), Some(i + 1)].into_iter().flatten();
            let distances = beside.filter_map(|i| Some(call.statuses.get(i)?.distance));
            let only_touch = distances.filter(|yt| *yt > 0.0).all(|yt| yt < tolerance);
            let apart = status.in_contact && status.distance <= -tolerance;
            let words = || format!("{}, as a node beside it touches", said(case, &status));
            (apart && only_touch).then(words)
        })
    })
}
