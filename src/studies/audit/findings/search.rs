//! Findings of the search for a target edge: c_cnt 1-10.

use super::Evidence;
use super::experiment::{
    Shape, at_calls, at_shapes, c_cnt, count_nodes, dy, ends, inside_target, rise,
};
use crate::audit::Case;
use crate::audit::evidence::Outcome;
use engine::contact::turned;
use paper::door::ContactStatus;
use problem::model::{EdgeId, Model};

/// C1: the target edges reversed.
pub(super) fn turned_edges(case: &Case) -> Outcome<Evidence> {
    let state = |status: &ContactStatus| (status.edge.is_some(), status.in_contact);
    compared(case, &turned(case.model()), "reversed", |own, other| state(own) != state(other))
}

/// C2: `trg` in reverse.
pub(super) fn reversed_target(case: &Case) -> Outcome<Evidence> {
    let mut reversed = case.model().clone();
    reversed.contact.target.reverse();
    compared(case, &reversed, "in reverse", |own, other| own.edge != other.edge)
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
            let of = |status: &ContactStatus| {
                let ct = status.edge.map_or(0, |edge| case.model().edge(edge).number);
                format!("ct {ct} dy {}", usize::from(status.in_contact))
            };
            differ(own, other).then(|| format!("{}, {name} {}", of(own), of(other)))
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
            let (yt, along) = (status.distance, status.distance * cosine);
            let words = || format!("yt {yt:.3e}, cos t {cosine:.3}, along the normal {along:.3e}");
            (yt.abs() * cosine < case.model().contact.tolerance).then(words)
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
            let deep = nearest(model, shape, i) >= model.contact.tolerance;
            let lost = call.statuses[i].edge.is_none() && deep && inside_target(model, shape, i);
            let yt = call.statuses[i].distance;
            lost.then(|| format!("inside the target, ct 0 yt {yt} dy {}", dy(call, i)))
        })
    })
}

/// C14: contact nodes over or under a target edge, nearer than c_tll, without a target edge.
pub(super) fn missed_near(case: &Case) -> Outcome<Evidence> {
    let model = case.model();
    at_calls(case, |shape, call| {
        count_nodes(model, |i| {
            let near = nearest(model, shape, i);
            let missed = call.statuses[i].edge.is_none() && near < model.contact.tolerance;
            missed.then(|| format!("{near:.3e} from its edge, ct 0"))
        })
    })
}

/// The smallest vertical distance of entry `i` of the contact surface from the target edges that it
/// is over or under.
fn nearest(model: &Model, shape: &Shape, i: usize) -> f64 {
    let point = shape[model.contact.nodes[i].index()];
    let distance = |edge: &EdgeId| {
        let [a, b] = ends(model, shape, *edge);
        let over = a[0].min(b[0]) <= point[0] && point[0] <= a[0].max(b[0]);
        rise([a, b], point).filter(|_| over).map(f64::abs)
    };
    model.contact.target.iter().filter_map(distance).fold(f64::INFINITY, f64::min)
}
