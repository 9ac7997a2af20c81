//! Findings of the weights: c_cnt 21-30, and what `Km` makes of them.

use super::Measured;
use super::experiment::{ROUNDING, at_shapes, c_cnt, contact_nodes, mjs};
use crate::answer::contact::ties;
use crate::paper::mathcad::array::Column;
use crate::paper::mirror::{Pairs, Worksheet};
use crate::problem::modelling::Variant;
use crate::studies::audit::Case;

/// C6: how far the weights of nodes in contact leave [0, 1], over all iterations of all variants that run.
pub(super) fn outside_the_edge(case: &Case) -> Measured {
    let mut furthest = Measured::nothing("every weight lies in [0, 1]");
    for variant in Variant::OF_THE_PAPER {
        let Ok(outcome) = case.run(*variant) else { continue };
        for it in &outcome.iterations {
            for tie in ties(&case.sheet, &it.pairs) {
                let [k1, k2] = [0, 1].map(|k: usize| tie.weights[k].1);
                let outside = [k1, k2].map(|k| (k - 1.0).max(-k)).into_iter().fold(0.0, f64::max);
                if outside > furthest.number {
                    let (k, node) = (it.k, tie.node);
                    let detail = format!("{variant}, iteration {k}: node {node}: {k1:.4}, {k2:.4}");
                    furthest = Measured::holds_if(true, outside, detail);
                }
            }
        }
    }
    furthest
}

/// C7: target nodes that stand for two or more contact nodes.
pub(super) fn forgotten_mates(case: &Case) -> Measured {
    let sheet = &case.sheet;
    at_shapes(case, |node_n| {
        let pairs = c_cnt(sheet, node_n)?;
        let mates = mates(sheet, &pairs);
        let shared = (1..=sheet.R()).filter(|n| mates[n - 1].len() > 1).map(|n| {
            let row: Vec<String> = pairs.k_cnt.row(n).map(f64::to_string).collect();
            format!("node {n}: mates {:?}, k_cnt {}", mates[n - 1], row.join(" "))
        });
        Ok(Measured::count(&shared.collect::<Vec<_>>()))
    })
}

/// For each node the contact nodes that are tied to it.
fn mates(sheet: &Worksheet<f64>, pairs: &Pairs<f64>) -> Vec<Vec<usize>> {
    let mut mates = vec![Vec::new(); sheet.R()];
    for tie in ties(sheet, pairs) {
        for (mate, _) in tie.weights {
            mates[mate - 1].push(tie.node);
        }
    }
    mates
}

/// C12: the sum of the weights of a node that `cnt` lists more than once.
pub(super) fn listed_twice(case: &Case) -> Measured {
    let sheet = &case.sheet;
    at_shapes(case, |node_n| {
        let pairs = c_cnt(sheet, node_n)?;
        let times = |n: usize| sheet.cnt.iter().filter(|c| **c == n).count();
        let sum = |n: usize| pairs.k_cnt[(n, 2)] + pairs.k_cnt[(n, 4)];
        let twice = contact_nodes(
            sheet,
            |i1| times(sheet.cnt[i1]) > 1 && pairs.dy[i1] == 1,
            |i1| {
                format!(
                    "listed {} times, weights sum to {}",
                    times(sheet.cnt[i1]),
                    sum(sheet.cnt[i1])
                )
            },
        );
        let largest = ties(sheet, &pairs).iter().map(|tie| sum(tie.node)).fold(0.0, f64::max);
        Ok(Measured { number: largest, ..Measured::count(&twice) })
    })
}

/// C13: `cnt` in reverse: entries of MJS that change by more than rounding.
pub(super) fn reversed_cnt(case: &Case) -> Measured {
    let reversed = case.sheet.cnt.as_slice().iter().rev().copied().collect();
    let reversed = Worksheet { cnt: Column::from_vec(reversed), ..case.sheet.clone() };
    at_shapes(case, |node_n| {
        let as_is = mjs(&case.sheet, node_n)?.into_matrix();
        let change = mjs(&reversed, node_n)?.into_matrix() - &as_is;
        let rounding = ROUNDING * as_is.amax();
        let changed = change.iter().filter(|x| x.abs() > rounding).count();
        let detail = format!("the largest change is {:.3e} of {:.3e}", change.amax(), as_is.amax());
        Ok(Measured::holds_if(changed > 0, changed as f64, detail))
    })
}
