//! Findings of the weights: c_cnt 21-30, and what `Km` makes of them.

use super::Measured;
use super::experiment::{ROUNDING, at_shapes, c_cnt, contact_nodes, mjs};
use crate::answer::{Detail, Step};
use crate::paper::door::{Call, linked, worksheet};
use crate::problem::model::{Model, NodeId};
use crate::problem::modelling::Variant;
use crate::studies::audit::Case;

/// C6: how far the weights of nodes in contact leave [0, 1], over all iterations of all variants that run.
pub(super) fn outside_the_edge(case: &Case) -> Measured {
    let mut furthest = Measured::nothing("every weight lies in [0, 1]");
    for variant in Variant::OF_THE_PAPER {
        let Ok(solution) = case.run(*variant) else { continue };
        for step in &solution.steps {
            for (node, [k1, k2]) in weights(&solution.model, step) {
                let outside = [k1, k2].map(|k| (k - 1.0).max(-k)).into_iter().fold(0.0, f64::max);
                if outside > furthest.number {
                    let k = step.k;
                    let detail = format!("{variant}, iteration {k}: node {node}: {k1:.4}, {k2:.4}");
                    furthest = Measured::holds_if(true, outside, detail);
                }
            }
        }
    }
    furthest
}

/// The two weights of each node in contact that `c_cnt` found in a step.
fn weights(model: &Model, step: &Step) -> Vec<(NodeId, [f64; 2])> {
    let Detail::Published(found) = &step.detail else { return Vec::new() };
    let linked = linked(&worksheet(model, |x| x), &found.pairs);
    linked.into_iter().map(|bound| (bound.node, bound.masters.map(|(_, k)| k))).collect()
}

/// C7: target nodes that stand for two or more contact nodes.
pub(super) fn forgotten_mates(case: &Case) -> Measured {
    let model = case.model();
    at_shapes(case, |shape| {
        let call = c_cnt(model, shape)?;
        let mates = mates(model, &call);
        let shared = model.node_ids().filter(|n| mates[n.index()].len() > 1).map(|n| {
            let row: Vec<String> = call.row(n).iter().map(f64::to_string).collect();
            format!("node {n}: mates {:?}, k_cnt {}", mates[n.index()], row.join(" "))
        });
        Ok(Measured::count(&shared.collect::<Vec<_>>()))
    })
}

/// For each node the numbers of the contact nodes that are bound to it.
fn mates(model: &Model, call: &Call) -> Vec<Vec<usize>> {
    let mut mates = vec![Vec::new(); model.nodes.len()];
    for bound in linked(&call.sheet, &call.pairs) {
        for (master, _) in bound.masters {
            mates[master.index()].push(bound.node.number());
        }
    }
    mates
}

/// C12: the sum of the weights of a node that `cnt` lists more than once.
pub(super) fn listed_twice(case: &Case) -> Measured {
    let model = case.model();
    at_shapes(case, |shape| {
        let call = c_cnt(model, shape)?;
        let node = |i: usize| model.contact.nodes[i];
        let times = |n: NodeId| model.contact.nodes.iter().filter(|c| **c == n).count();
        let sum = |n: NodeId| {
            let [_, k1, _, k2] = call.row(n);
            k1 + k2
        };
        let twice = contact_nodes(
            model,
            |i| times(node(i)) > 1 && call.statuses[i].in_contact,
            |i| {
                let (times, sum) = (times(node(i)), sum(node(i)));
                format!("listed {times} times, weights sum to {sum}")
            },
        );
        let linked = linked(&call.sheet, &call.pairs);
        let largest = linked.iter().map(|bound| sum(bound.node)).fold(0.0, f64::max);
        Ok(Measured { number: largest, ..Measured::count(&twice) })
    })
}

/// C13: `cnt` in reverse: entries of MJS that change by more than rounding.
pub(super) fn reversed_contact(case: &Case) -> Measured {
    let mut reversed = case.model().clone();
    reversed.contact.nodes.reverse();
    at_shapes(case, |shape| {
        let as_is = mjs(case.model(), shape)?;
        let change = mjs(&reversed, shape)? - &as_is;
        let rounding = ROUNDING * as_is.amax();
        let changed = change.iter().filter(|x| x.abs() > rounding).count();
        let detail = format!("the largest change is {:.3e} of {:.3e}", change.amax(), as_is.amax());
        Ok(Measured::holds_if(changed > 0, changed as f64, detail))
    })
}
