//! Findings of the weights: c_cnt 21-30, and what `Km` makes of them.

use super::Evidence;
use super::experiment::{ROUNDING, at_calls, at_shapes, count, count_nodes, mjs};
use crate::audit::Case;
use crate::audit::evidence::Outcome;
use base::plain::six_digits;
use engine::Detail;
use output::layout::listed;
use paper::door::{NodeToSegment, linked, worksheet};
use problem::model::NodeId;
use problem::modelling::Variant;

/// C6: how far the weights of nodes in contact leave [0, 1], over all iterations of all variants.
pub(super) fn outside_the_edge(case: &Case) -> Outcome<Evidence> {
    let mut furthest = Evidence::present_if(false, 0.0, "every weight lies in [0, 1]");
    for variant in Variant::OF_THE_PAPER {
        let Ok(solution) = case.run(*variant) else { continue };
        let sheet = worksheet(&solution.model, |x| x);
        for step in &solution.steps {
            let Detail::Published(found) = &step.detail else { continue };
            for NodeToSegment { node, masters } in linked(&sheet, found) {
                let [k1, k2] = masters.map(|(_, weight)| weight);
                let outside = [k1, k2].map(|k| (k - 1.0).max(-k)).into_iter().fold(0.0, f64::max);
                if outside > furthest.number.unwrap_or(0.0).max(ROUNDING) {
                    let k = step.k;
                    let [k1, k2] = [k1, k2].map(six_digits);
                    let detail = format!(
                        "iteration {k} of {variant} gives node {node} the weights {k1} and {k2}"
                    );
                    furthest = Evidence::present_if(true, outside, detail);
                }
            }
        }
    }
    Ok(furthest)
}

/// C7: target nodes that stand for two or more contact nodes.
pub(super) fn shared_nodes(case: &Case) -> Outcome<Evidence> {
    let model = case.model();
    at_calls(case, |_, call| {
        // For each node the numbers of the contact nodes of which it is a master node.
        let mut constrained = vec![Vec::new(); model.nodes.len()];
        for bound in linked(&call.sheet, &call.pairs) {
            for (master, _) in bound.masters {
                constrained[master.index()].push(bound.node.number());
            }
        }
        count(model.node_ids().zip(&constrained).filter(|(_, by)| by.len() > 1).map(|(n, by)| {
            let ([kept, sum, ..], by) = (call.row(n).map(six_digits), listed(by));
            format!("node {n} is a mate of nodes {by}, but keeps node {kept} alone, with the weight {sum}")
        }))
    })
}

/// C12: the sum of the weights of a node that `cnt` lists more than once.
pub(super) fn listed_twice(case: &Case) -> Outcome<Evidence> {
    let model = case.model();
    at_calls(case, |_, call| {
        let sum = |n: NodeId| {
            let [_, k1, _, k2] = call.row(n);
            k1 + k2
        };
        let twice = count_nodes(model, |i| {
            let node = model.contact.nodes[i];
            let times = model.contact.nodes.iter().filter(|other| **other == node).count();
            let is_first = !model.contact.nodes[..i].contains(&node);
            let words =
                || format!("is listed {times} times, and its weights add up to {}", sum(node));
            (times > 1 && is_first && call.statuses[i].in_contact).then(words)
        });
        let linked = linked(&call.sheet, &call.pairs);
        let largest = linked.iter().map(|bound| sum(bound.node)).fold(0.0, f64::max);
        Evidence { number: Some(largest), ..twice }
    })
}

/// C13: `cnt` in reverse: entries of MJS that change by more than rounding.
pub(super) fn reversed_contact(case: &Case) -> Outcome<Evidence> {
    let mut reversed = case.model().clone();
    reversed.contact.nodes.reverse();
    at_shapes(case, |shape| {
        let as_is = mjs(case, case.model(), shape)?;
        let other = mjs(case, &reversed, shape)?;
        let largest = as_is.amax();
        let changes: Vec<f64> = other.differences(&as_is).map(f64::abs).collect();
        let changed = changes.iter().filter(|x| **x > ROUNDING * largest).count();
        let change = changes.into_iter().fold(0.0, f64::max);
        let [change, largest] = [change, largest].map(six_digits);
        let detail = format!(
            "an entry of MJS changes by {change} once cnt is reversed; the largest entry is {largest}"
        );
        Ok(Evidence::present_if(changed > 0, changed as f64, detail))
    })
}
