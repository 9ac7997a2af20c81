//! Findings of the search for a target edge: c_cnt 1-10.

use super::Measured;
use super::experiment::{Shape, at_shapes, c_cnt, contact_nodes, ct, dy};
use super::geometry::{ends, inside_target, place, rise};
use crate::paper::door::Call;
use crate::problem::model::{EdgeId, Model};
use crate::studies::audit::Case;

/// C1: the target edges turned round.
pub(super) fn turned_edges(case: &Case) -> Measured {
    let mut turned = case.model().clone();
    for edge in &case.model().contact.target {
        turned.edges[edge.index()].nodes = {
            let [a, b] = case.model().edge(*edge).nodes;
            [b, a]
        };
    }
    at_shapes(case, |shape| {
        let (as_is, other) = (c_cnt(case.model(), shape)?, c_cnt(&turned, shape)?);
        let state =
            |call: &Call, i: usize| (call.statuses[i].edge.is_some(), call.statuses[i].in_contact);
        Ok(Measured::count(&contact_nodes(
            case.model(),
            |i| state(&as_is, i) != state(&other, i),
            |i| {
                let of = |call| format!("ct {} dy {}", ct(case.model(), call, i), dy(call, i));
                format!("{}, turned round {}", of(&as_is), of(&other))
            },
        )))
    })
}

/// C2: `trg` in reverse.
pub(super) fn reversed_target(case: &Case) -> Measured {
    let mut reversed = case.model().clone();
    reversed.contact.target.reverse();
    at_shapes(case, |shape| {
        let (as_is, other) = (c_cnt(case.model(), shape)?, c_cnt(&reversed, shape)?);
        Ok(Measured::count(&contact_nodes(
            case.model(),
            |i| as_is.statuses[i].edge != other.statuses[i].edge,
            |i| {
                let of = |call| format!("ct {} dy {}", ct(case.model(), call, i), dy(call, i));
                format!("{}, in reverse {}", of(&as_is), of(&other))
            },
        )))
    })
}

/// C3: contact nodes nearer than c_tll to the line of their edge, but not vertically; a vertical edge stops the listing.
pub(super) fn vertical_distance(case: &Case) -> Measured {
    at_shapes(case, |shape| match c_cnt(case.model(), shape) {
        Ok(call) => Ok(Measured::count(&near_a_slope(case.model(), shape, &call))),
        Err(failure) if failure.line == 10 => {
            Ok(Measured::holds_if(true, 0.0, failure.to_string()))
        }
        Err(failure) => Err(failure),
    })
}

fn near_a_slope(model: &Model, shape: &Shape, call: &Call) -> Vec<String> {
    let cosine = |edge: EdgeId| {
        let [a, b] = ends(model, shape, edge);
        (b[0] - a[0]).abs() / (b[0] - a[0]).hypot(b[1] - a[1])
    };
    let along_normal = |i: usize| {
        let status = call.statuses[i];
        let cosine = cosine(status.edge.filter(|_| !status.in_contact)?);
        Some((status.distance, cosine))
    };
    contact_nodes(
        model,
        |i| along_normal(i).is_some_and(|(yt, cos)| yt.abs() * cos < model.contact.tolerance),
        |i| {
            let (yt, cosine) = along_normal(i).unwrap_or_default();
            format!("yt {yt:.3e}, cos t {cosine:.3}, along the normal {:.3e}", yt * cosine)
        },
    )
}

/// C9: contact nodes inside the target, c_tll or more from the edges above or below them, without a target edge.
pub(super) fn lost_inside(case: &Case) -> Measured {
    let model = case.model();
    at_shapes(case, |shape| {
        let call = c_cnt(model, shape)?;
        Ok(Measured::count(&contact_nodes(
            model,
            |i| {
                let deep = nearest(model, shape, i) >= model.contact.tolerance;
                call.statuses[i].edge.is_none() && deep && inside_target(model, shape, i)
            },
            |i| {
                let yt = call.statuses[i].distance;
                format!("inside the target, ct 0 yt {yt} dy {}", dy(&call, i))
            },
        )))
    })
}

/// C14: contact nodes over or under a target edge, nearer than c_tll, without a target edge.
pub(super) fn missed_near(case: &Case) -> Measured {
    let model = case.model();
    at_shapes(case, |shape| {
        let call = c_cnt(model, shape)?;
        let near = |i: usize| nearest(model, shape, i);
        Ok(Measured::count(&contact_nodes(
            model,
            |i| call.statuses[i].edge.is_none() && near(i) < model.contact.tolerance,
            |i| format!("{:.3e} from its edge, ct 0", near(i)),
        )))
    })
}

/// The smallest vertical distance of entry `i` of the contact surface from the target edges that it is over or under.
fn nearest(model: &Model, shape: &Shape, i: usize) -> f64 {
    let point = place(shape, model.contact.nodes[i]);
    let distance = |edge: &EdgeId| {
        let [a, b] = ends(model, shape, *edge);
        let over = a[0].min(b[0]) <= point[0] && point[0] <= a[0].max(b[0]);
        rise([a, b], point).filter(|_| over).map(f64::abs)
    };
    model.contact.target.iter().filter_map(distance).fold(f64::INFINITY, f64::min)
}
