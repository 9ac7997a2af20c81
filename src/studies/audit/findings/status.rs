//! Findings of the contact status: c_cnt 15-18.

use super::experiment::{at_shapes, c_cnt, contact_nodes};
use super::geometry::inner_sign;
use super::{Measured, Verdict};
use crate::paper::mathcad::array::Table;
use crate::paper::mirror::{self, Cause, Order, Pairs, Reading, Worksheet};
use crate::studies::audit::Case;

/// `node_n` with every y changed by `f(node, y)`.
fn with_y(node_n: &Table<f64>, f: impl Fn(usize, f64) -> f64) -> Table<f64> {
    let mut changed = node_n.clone();
    for n in 1..=node_n.rows() {
        changed[(n, 3)] = f(n, node_n[(n, 3)]);
    }
    changed
}

/// C4: the scene upside down. Only nodes that keep their target edge count: C1 is kept out.
pub(super) fn upside_down(case: &Case) -> Measured {
    at_shapes(case, |node_n| {
        let as_is = c_cnt(&case.sheet, node_n)?;
        let mirrored = c_cnt(&case.sheet, &with_y(node_n, |_, y| -y))?;
        Ok(Measured::count(&contact_nodes(
            &case.sheet,
            |i1| as_is.ct[i1] == mirrored.ct[i1] && as_is.dy[i1] != mirrored.dy[i1],
            |i1| {
                let (yt, dy, other) = (as_is.yt[i1], as_is.dy[i1], mirrored.dy[i1]);
                format!("yt {yt:.3e} dy {dy}, upside down dy {other}")
            },
        )))
    })
}

/// C5: of runs of two or more neighbours deeper inside than c_tll, those that are not flagged.
pub(super) fn deep_runs(case: &Case) -> Measured {
    let sheet = &case.sheet;
    at_shapes(case, |node_n| {
        let pairs = c_cnt(sheet, node_n)?;
        let deep = |i1: usize| {
            let sign =
                pairs.ct.get(i1).filter(|ct| **ct > 0).and_then(|e| inner_sign(sheet, node_n, *e));
            sign.is_some_and(|sign| sign * pairs.yt[i1] >= sheet.c_tll.max(f64::MIN_POSITIVE))
        };
        Ok(Measured::count(&contact_nodes(
            sheet,
            |i1| pairs.dy[i1] == 0 && deep(i1) && (deep(i1 - 1) || deep(i1 + 1)),
            |i1| format!("yt {:.3e} dy 0", pairs.yt[i1]),
        )))
    })
}

/// C8: c_tll = 0: nodes on their edge that are not flagged.
pub(super) fn strictly_less(case: &Case) -> Measured {
    let sheet = Worksheet { c_tll: 0.0, ..case.sheet.clone() };
    at_shapes(case, |node_n| {
        let pairs = c_cnt(&sheet, node_n)?;
        let touches = |i1: usize| pairs.ct[i1] > 0 && pairs.yt[i1] == 0.0;
        let words = |i1: usize| format!("yt {:.3e} dy {}", pairs.yt[i1], pairs.dy[i1]);
        if (1..=sheet.cnt.rows()).any(|i1| touches(i1) && pairs.dy[i1] == 1) {
            return Ok(Measured {
                verdict: Verdict::Contradicted,
                ..Measured::count(&contact_nodes(&sheet, touches, words))
            });
        }
        let mut measured = Measured::count(&contact_nodes(&sheet, touches, words));
        let by_sign = Measured::count(&contact_nodes(&sheet, |i1| pairs.dy[i1] == 1, words));
        measured.detail += &format!("; flagged by lines 17-18: {}", by_sign.detail);
        Ok(measured)
    })
}

/// C10: `∧` evaluated from left to right, at the initial shape.
pub(super) fn left_to_right(case: &Case) -> Measured {
    let reading = Reading { r4: Order::LeftToRight, ..Reading::default() };
    let Ok(pairs) = case.initial() else {
        return Measured::nothing("c_cnt fails before line 18");
    };
    let Some(&first) = pairs.yt.get(1) else { return Measured::nothing("no contact node") };
    let stops = mirror::c_cnt(&case.sheet, &reading, &case.sheet.node);
    match stops {
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
    let sheet = &case.sheet;
    at_shapes(case, |node_n| {
        let pairs = c_cnt(sheet, node_n)?;
        let noise = noise(node_n);
        let on_edge = |i1: usize| pairs.ct[i1] > 0 && pairs.yt[i1].abs() <= noise;
        let moved = |by: f64| {
            let touching = |n| (1..=sheet.cnt.rows()).any(|i1| sheet.cnt[i1] == n && on_edge(i1));
            with_y(node_n, |n, y| if touching(n) { y + by } else { y })
        };
        let (up, down) = (c_cnt(sheet, &moved(2.0 * noise))?, c_cnt(sheet, &moved(-2.0 * noise))?);
        Ok(Measured::count(&contact_nodes(
            sheet,
            |i1| !on_edge(i1) && up.dy[i1] != down.dy[i1],
            |i1| {
                let (yt, up, down) = (pairs.yt[i1], up.dy[i1], down.dy[i1]);
                format!("yt {yt:.3e}, dy {up} or {down} as its neighbour moves by ±{noise:.0e}")
            },
        )))
    })
}

/// What rounding may leave of a difference of coordinates: yt takes some ten operations.
fn noise(node_n: &Table<f64>) -> f64 {
    let largest = node_n.as_matrix().columns(1, 2).amax();
    16.0 * f64::EPSILON * largest
}

/// C15: nodes flagged only because a neighbour that is itself within c_tll has yt > 0.
pub(super) fn touching_neighbour(case: &Case) -> Measured {
    let sheet = &case.sheet;
    at_shapes(case, |node_n| {
        let pairs = c_cnt(sheet, node_n)?;
        Ok(Measured::count(&contact_nodes(
            sheet,
            |i1| by_touching_neighbour(sheet, &pairs, i1),
            |i1| format!("yt {:.3e} dy 1", pairs.yt[i1]),
        )))
    })
}

fn by_touching_neighbour(sheet: &Worksheet<f64>, pairs: &Pairs<f64>, i1: usize) -> bool {
    let beside = [i1.checked_sub(1), Some(i1 + 1)];
    let above: Vec<f64> = beside
        .into_iter()
        .filter_map(|i| pairs.yt.get(i?).copied())
        .filter(|yt| *yt > 0.0)
        .collect();
    let apart = pairs.dy[i1] == 1 && pairs.yt[i1] <= -sheet.c_tll;
    apart && above.iter().all(|yt| *yt < sheet.c_tll)
}
