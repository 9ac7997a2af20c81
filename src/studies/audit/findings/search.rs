//! Findings of the search for a target edge: c_cnt 1-10.

use super::Measured;
use super::experiment::{at_shapes, c_cnt, contact_nodes};
use super::geometry::{ends, inside_target, place, rise};
use crate::paper::mathcad::array::{Column, Table};
use crate::paper::mirror::{Pairs, Worksheet};
use crate::studies::audit::Case;

/// C1: the target edges turned round.
pub(super) fn turned_edges(case: &Case) -> Measured {
    let mut turned = case.sheet.clone();
    for &e in case.sheet.trg.iter() {
        for (column, other) in [(6, 7), (7, 6)] {
            turned.elem[(e, column)] = case.sheet.elem[(e, other)];
        }
    }
    at_shapes(case, |node_n| {
        let (as_is, other) = (c_cnt(&case.sheet, node_n)?, c_cnt(&turned, node_n)?);
        let state = |pairs: &Pairs<f64>, i1: usize| (pairs.ct[i1] > 0, pairs.dy[i1]);
        Ok(Measured::count(&contact_nodes(
            &case.sheet,
            |i1| state(&as_is, i1) != state(&other, i1),
            |i1| {
                let of = |p: &Pairs<f64>| format!("ct {} dy {}", p.ct[i1], p.dy[i1]);
                format!("{}, turned round {}", of(&as_is), of(&other))
            },
        )))
    })
}

/// C2: `trg` in reverse.
pub(super) fn reversed_trg(case: &Case) -> Measured {
    let reversed = case.sheet.trg.as_slice().iter().rev().copied().collect();
    let reversed = Worksheet { trg: Column::from_vec(reversed), ..case.sheet.clone() };
    at_shapes(case, |node_n| {
        let (as_is, other) = (c_cnt(&case.sheet, node_n)?, c_cnt(&reversed, node_n)?);
        Ok(Measured::count(&contact_nodes(
            &case.sheet,
            |i1| as_is.ct[i1] != other.ct[i1],
            |i1| {
                let of = |p: &Pairs<f64>| format!("ct {} dy {}", p.ct[i1], p.dy[i1]);
                format!("{}, in reverse {}", of(&as_is), of(&other))
            },
        )))
    })
}

/// C3: contact nodes nearer than c_tll to the line of their edge, but not vertically; a vertical edge stops the listing.
pub(super) fn vertical_distance(case: &Case) -> Measured {
    at_shapes(case, |node_n| match c_cnt(&case.sheet, node_n) {
        Ok(pairs) => Ok(Measured::count(&near_a_slope(&case.sheet, node_n, &pairs))),
        Err(failure) if failure.line == 10 => {
            Ok(Measured::holds_if(true, 0.0, failure.to_string()))
        }
        Err(failure) => Err(failure),
    })
}

fn near_a_slope(sheet: &Worksheet<f64>, node_n: &Table<f64>, pairs: &Pairs<f64>) -> Vec<String> {
    let cosine = |i1: usize| {
        let [a, b] = ends(sheet, node_n, pairs.ct[i1]);
        (b[0] - a[0]).abs() / (b[0] - a[0]).hypot(b[1] - a[1])
    };
    contact_nodes(
        sheet,
        |i1| {
            let lost = pairs.ct[i1] > 0 && pairs.dy[i1] == 0;
            lost && pairs.yt[i1].abs() * cosine(i1) < sheet.c_tll
        },
        |i1| {
            let (yt, cosine) = (pairs.yt[i1], cosine(i1));
            format!("yt {yt:.3e}, cos t {cosine:.3}, along the normal {:.3e}", yt * cosine)
        },
    )
}

/// C9: contact nodes inside the target, c_tll or more from the edges above or below them, without a target edge.
pub(super) fn lost_inside(case: &Case) -> Measured {
    at_shapes(case, |node_n| {
        let pairs = c_cnt(&case.sheet, node_n)?;
        Ok(Measured::count(&contact_nodes(
            &case.sheet,
            |i1| {
                let deep = nearest(&case.sheet, node_n, i1) >= case.sheet.c_tll;
                pairs.ct[i1] == 0 && deep && inside_target(case, node_n, i1)
            },
            |i1| format!("inside the target, ct 0 yt {} dy {}", pairs.yt[i1], pairs.dy[i1]),
        )))
    })
}

/// C14: contact nodes over or under a target edge, nearer than c_tll, without a target edge.
pub(super) fn missed_near(case: &Case) -> Measured {
    at_shapes(case, |node_n| {
        let pairs = c_cnt(&case.sheet, node_n)?;
        let near = |i1: usize| nearest(&case.sheet, node_n, i1);
        Ok(Measured::count(&contact_nodes(
            &case.sheet,
            |i1| pairs.ct[i1] == 0 && near(i1) < case.sheet.c_tll,
            |i1| format!("{:.3e} from its edge, ct 0", near(i1)),
        )))
    })
}

/// The smallest vertical distance of contact node `i1` from the target edges that it is over or under.
fn nearest(sheet: &Worksheet<f64>, node_n: &Table<f64>, i1: usize) -> f64 {
    let point = place(node_n, sheet.cnt[i1]);
    let distance = |e: &usize| {
        let [a, b] = ends(sheet, node_n, *e);
        let over = a[0].min(b[0]) <= point[0] && point[0] <= a[0].max(b[0]);
        rise([a, b], point).filter(|_| over).map(f64::abs)
    };
    sheet.trg.iter().filter_map(distance).fold(f64::INFINITY, f64::min)
}
