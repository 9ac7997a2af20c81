//! Findings of the contact status: c_cnt 15-18.

use super::experiment::{Shape, at_shapes, c_cnt, contact_nodes, dy};
use super::geometry::inner_sign;
use super::{Measured, Verdict};
use crate::paper::door::Call;
use crate::paper::mirror::{Cause, Order, Reading};
use crate::problem::model::{Model, NodeId};
use crate::studies::audit::Case;

/// A shape with every y changed by `f(node, y)`.
fn with_y(shape: &Shape, f: impl Fn(NodeId, f64) -> f64) -> Vec<[f64; 2]> {
    NodeId::all(shape.len()).zip(shape).map(|(node, [x, y])| [*x, f(node, *y)]).collect()
}

/// C4: the scene upside down. Only nodes that keep their target edge count: C1 is kept out.
pub(super) fn upside_down(case: &Case) -> Measured {
    at_shapes(case, |shape| {
        let as_is = c_cnt(case.model(), shape)?;
        let mirrored = c_cnt(case.model(), &with_y(shape, |_, y| -y))?;
        Ok(Measured::count(&contact_nodes(
            case.model(),
            |i| {
                let (own, other) = (as_is.statuses[i], mirrored.statuses[i]);
                own.edge == other.edge && own.in_contact != other.in_contact
            },
            |i| {
                let yt = as_is.statuses[i].distance;
                format!("yt {yt:.3e} dy {}, upside down dy {}", dy(&as_is, i), dy(&mirrored, i))
            },
        )))
    })
}

/// C5: of runs of two or more neighbours deeper inside than c_tll, those that are not flagged.
pub(super) fn deep_runs(case: &Case) -> Measured {
    let model = case.model();
    at_shapes(case, |shape| {
        let call = c_cnt(model, shape)?;
        let least = model.contact.tolerance.max(f64::MIN_POSITIVE);
        let deep = |i: usize| {
            let Some(status) = call.statuses.get(i) else { return false };
            let sign = status.edge.and_then(|edge| inner_sign(model, shape, edge));
            sign.is_some_and(|sign| sign * status.distance >= least)
        };
        let beside = |i: usize| i.checked_sub(1).is_some_and(deep) || deep(i + 1);
        Ok(Measured::count(&contact_nodes(
            model,
            |i| !call.statuses[i].in_contact && deep(i) && beside(i),
            |i| format!("yt {:.3e} dy 0", call.statuses[i].distance),
        )))
    })
}

/// C8: c_tll = 0: nodes on their edge that are not flagged.
pub(super) fn strictly_less(case: &Case) -> Measured {
    let mut model = case.model().clone();
    model.contact.tolerance = 0.0;
    at_shapes(case, |shape| {
        let call = c_cnt(&model, shape)?;
        let touches =
            |i: usize| call.statuses[i].edge.is_some() && call.statuses[i].distance == 0.0;
        let flagged = |i: usize| call.statuses[i].in_contact;
        let words = |i: usize| format!("yt {:.3e} dy {}", call.statuses[i].distance, dy(&call, i));
        let mut measured = Measured::count(&contact_nodes(&model, touches, words));
        if (0..call.statuses.len()).any(|i| touches(i) && flagged(i)) {
            return Ok(Measured { verdict: Verdict::Contradicted, ..measured });
        }
        let by_sign = Measured::count(&contact_nodes(&model, flagged, words));
        measured.detail += &format!("; flagged by lines 17-18: {}", by_sign.detail);
        Ok(measured)
    })
}

/// C10: `∧` evaluated from left to right, at the initial shape.
pub(super) fn left_to_right(case: &Case) -> Measured {
    let reading = Reading { r4: Order::LeftToRight, ..Reading::default() };
    let Ok(call) = case.initial() else {
        return Measured::nothing("c_cnt fails before line 18");
    };
    let Some(first) = call.statuses.first().map(|status| status.distance) else {
        return Measured::nothing("no contact node");
    };
    match Call::c_cnt(case.model(), &reading, &case.model().nodes) {
        Err(f) if f.line == 18 && f.cause == Cause::InvalidIndex => {
            Measured::holds_if(true, first, f.to_string())
        }
        _ if first < 0.0 => Measured {
            verdict: Verdict::Contradicted,
            number: first,
            detail: "yt[1] < 0, and line 18 does not stop".into(),
        },
        _ => Measured::holds_if(false, first, "yt[1] is not below 0"),
    }
}

/// C11: nodes that lie on their edge but for rounding, moved up and down by as much: whose status follows?
pub(super) fn rounding_noise(case: &Case) -> Measured {
    let model = case.model();
    at_shapes(case, |shape| {
        let call = c_cnt(model, shape)?;
        let noise = noise(shape);
        let on_edge =
            |i: usize| call.statuses[i].edge.is_some() && call.statuses[i].distance.abs() <= noise;
        let touching = |node: NodeId| {
            let mut entries = model.contact.nodes.iter().enumerate();
            entries.any(|(i, other)| *other == node && on_edge(i))
        };
        let moved = |by: f64| with_y(shape, |node, y| if touching(node) { y + by } else { y });
        let up = c_cnt(model, &moved(2.0 * noise))?;
        let down = c_cnt(model, &moved(-2.0 * noise))?;
        Ok(Measured::count(&contact_nodes(
            model,
            |i| !on_edge(i) && up.statuses[i].in_contact != down.statuses[i].in_contact,
            |i| {
                let (yt, up, down) = (call.statuses[i].distance, dy(&up, i), dy(&down, i));
                format!("yt {yt:.3e}, dy {up} or {down} as its neighbour moves by ±{noise:.0e}")
            },
        )))
    })
}

/// What rounding may leave of a difference of coordinates: yt takes some ten operations.
fn noise(shape: &Shape) -> f64 {
    let largest = shape.as_flattened().iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    16.0 * f64::EPSILON * largest
}

/// C15: nodes flagged only because a neighbour that is itself within c_tll has yt > 0.
pub(super) fn touching_neighbour(case: &Case) -> Measured {
    let model = case.model();
    at_shapes(case, |shape| {
        let call = c_cnt(model, shape)?;
        Ok(Measured::count(&contact_nodes(
            model,
            |i| by_touching_neighbour(model, &call, i),
            |i| format!("yt {:.3e} dy 1", call.statuses[i].distance),
        )))
    })
}

fn by_touching_neighbour(model: &Model, call: &Call, i: usize) -> bool {
    let tolerance = model.contact.tolerance;
    let beside = [i.checked_sub(1), Some(i + 1)].into_iter().flatten();
    let mut above =
        beside.filter_map(|i| Some(call.statuses.get(i)?.distance)).filter(|yt| *yt > 0.0);
    let apart = call.statuses[i].in_contact && call.statuses[i].distance <= -tolerance;
    apart && above.all(|yt| yt < tolerance)
}
