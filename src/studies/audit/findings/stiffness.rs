//! Findings of the stiffness matrix, `Km`, and of the iterations.

use std::collections::HashSet;

use super::experiment::{
    ROUNDING, at_calls, at_shapes, away, count, count_nodes, first_in_contact, mjs,
};
use super::{Evidence, Presence};
use crate::audit::Case;
use crate::audit::evidence::Outcome;
use base::plain::six_digits;
use engine::linear::SparseCholesky;
use engine::{Constraint, Detail, Elimination, Stiffness, max_displacement};
use output::layout::listed;
use output::numbers::with_unit;
use paper::door::{self, Call};
use paper::mirror::Failure;
use problem::model::{Dof, Model, NodeId, TriangleId};
use problem::modelling::Variant;

/// K1: entries of MJS that join two bodies, at the first shape with contact.
pub(super) fn nothing_joins(case: &Case) -> Outcome<Evidence> {
    let (model, mjs) = (case.model(), first_in_contact(case)?.km(case.reading())?);
    let mut joins = 0;
    for body in &model.bodies {
        let mut of_body = vec![false; mjs.size()];
        body.nodes.iter().flat_map(|n| n.dofs()).for_each(|dof| of_body[dof.index()] = true);
        joins += mjs.entries().filter(|(i, j, _)| of_body[*i] && !of_body[*j]).count();
    }
    let detail = match (case.run(Variant::Printed), model.target()) {
        (Ok(solution), Some(target)) => {
            let norm = |n: &NodeId| solution.u.rows(n.x().index(), 2).norm();
            let largest = target.nodes.iter().map(norm).fold(0.0, f64::max);
            let most = max_displacement(&solution.u);
            let [target, stamp] =
                [largest, most].map(|x| with_unit(&six_digits(x), &case.scene.units.length));
            format!("under printed the stamp moves by {stamp}, the target by {target}")
        }
        _ => "printed does not run".into(),
    };
    Ok(Evidence::must_be_present(joins == 0, joins as f64, detail))
}

/// The additions (triangle, pair 1 or 2 of k_cnt) of which `is` is true of the weights of the linked nodes,
/// in the triangle's order; in words.
fn additions(model: &Model, call: &Call, is: impl Fn(&[f64]) -> bool) -> Vec<(TriangleId, String)> {
    let mut found = Vec::new();
    for (id, pair) in model.triangle_ids().flat_map(|id| [(id, 1), (id, 2)]) {
        let rows = model.triangle(id).nodes.into_iter().map(|node| call.row(node));
        let linked = rows.filter(|row| row[2 * pair - 2] > 0.0);
        let weights: Vec<f64> = linked.map(|row| row[2 * pair - 1]).collect();
        if is(&weights) {
            let weights = listed(weights.into_iter().map(six_digits));
            found.push((
                id,
                format!(
                    "pair {pair} of triangle {id} has the weights {weights}, and fl keeps the last"
                ),
            ));
        }
    }
    found
}

/// K2: triangles with two linked nodes of different weight.
pub(super) fn one_weight_for_all(case: &Case) -> Outcome<Evidence> {
    at_calls(case, |_, call| {
        let different = |w: &[f64]| w.windows(2).any(|w| w[0] != w[1]);
        let mut found = additions(case.model(), call, different);
        found.dedup_by_key(|(id, _)| *id);
        count(found.into_iter().map(|(_, words)| words))
    })
}

/// K7: additions whose last weight is 0 while another is not.
pub(super) fn switched_off(case: &Case) -> Outcome<Evidence> {
    at_calls(case, |_, call| {
        let off = |w: &[f64]| w.last() == Some(&0.0) && w.iter().any(|k| *k != 0.0);
        count(additions(case.model(), call, off).into_iter().map(|(_, words)| words))
    })
}

/// K3: the 1 of a restrained equation outside the range of the other diagonal entries.
pub(super) fn ones_on_the_diagonal(case: &Case) -> Outcome<Evidence> {
    at_shapes(case, |shape| {
        let diagonal = mjs(case, case.model(), shape)?.diagonal();
        let range = |is_free: bool| {
            let entries = diagonal.iter().zip(case.model().all_dofs());
            let of = entries.filter(|(_, dof)| case.model().is_restrained(*dof) != is_free);
            of.fold((f64::INFINITY, 0.0_f64), |(low, high), (x, _)| (low.min(*x), high.max(*x)))
        };
        let ((low, high), (one, _)) = (range(true), range(false));
        let [own, least, most] = [one, low, high].map(six_digits);
        let detail = format!(
            "restrained equations have {own} on the diagonal, the others {least} to {most}"
        );
        let outside = one < low || (one > high && one.is_finite());
        Ok(Evidence::present_if(outside, high.max(one) / low.min(one), detail))
    })
}

/// K8: the smallest diagonal entry of MJS.
pub(super) fn stiffness_taken_away(case: &Case) -> Outcome<Evidence> {
    at_shapes(case, |shape| {
        let diagonal = mjs(case, case.model(), shape)?.diagonal();
        let (at, smallest) = diagonal.argmin();
        let (node, axis, least) = (at / 2 + 1, ["x", "y"][at % 2], six_digits(smallest));
        let detail =
            format!("the least diagonal entry of MJS is {least}, at {axis} of node {node}");
        Ok(Evidence::present_if(smallest < 0.0, smallest, detail))
    })
}

/// K4: rows of zeros that one node without a triangle adds, free or restrained.
pub(super) fn orphan(case: &Case) -> Outcome<Evidence> {
    let zero_rows = |orphan: Option<&[Dof]>| -> Result<usize, Failure> {
        let mut model = case.model().clone();
        if let Some(fixed) = orphan {
            model.add_node([0.0; 2]);
            model.holds.fix(fixed.iter().copied());
        }
        let mjs = Call::without_contact(&model).km(case.reading())?;
        let filled: HashSet<usize> = mjs.entries().map(|(row, ..)| row).collect();
        Ok(mjs.size() - filled.len())
    };
    let dofs = NodeId::new(case.model().nodes.len()).dofs();
    let [own, free, restrained] = [None, Some(&[][..]), Some(&dofs)].map(zero_rows);
    let (own, free, restrained) = (own?, free?, restrained?);
    let detail = format!(
        "MJS has {own} rows of zeros without such a node, {free} with it, {restrained} if S holds it"
    );
    Ok(Evidence::must_be_present(free == own + 2, (free - own) as f64, detail))
}

/// K5: the cycle in which `tied` ends.
pub(super) fn cycle(case: &Case) -> Outcome<Evidence> {
    let steps = &case.run(Variant::Tied)?.steps;
    let cycle = steps.last().and_then(|step| step.cycle.as_ref());
    let cycle = cycle.ok_or_else(|| format!("no state came back in {} iterations", steps.len()))?;
    let counts = cycle.members.iter().map(|k| steps[k - 1].in_contact);
    let how = if cycle.length == 1 { "settles" } else { "alternates" };
    let detail = format!("the contact state {how} with {} nodes in contact", listed(counts));
    let entered = steps.iter().any(|step| step.statuses != steps[0].statuses);
    let verdict = match cycle.length {
        1 if entered => Presence::Contradicted,
        1 => Presence::NotTriggered,
        _ => Presence::Present,
    };
    Ok(Evidence::new(verdict, cycle.length as f64, detail))
}

/// K9: nodes that eq. (1) binds to the target with a pull, at the end of `stepped`.
pub(super) fn pulls(case: &Case) -> Outcome<Evidence> {
    let model = case.model();
    let solution = case.run(Variant::Stepped)?;
    // What eq. (1) adds at each equation; at a restrained one the support's reaction is part of it.
    let force = Stiffness::new(model, |x| x).times(&solution.u) - &model.load;
    let rounding = ROUNDING * force.amax();
    let statuses = match &solution.last().detail {
        Detail::Published(step) => door::statuses(&solution.model, step),
        Detail::Unilateral(_) => Vec::new(),
    };
    let push = |i: usize| {
        let away = statuses[i].edge.and_then(|edge| away(model, &model.nodes, edge));
        let away = away.unwrap_or_default();
        let free = statuses[i].node.dofs().into_iter().filter(|dof| !model.is_restrained(*dof));
        free.map(|dof| force[dof.index()] * away[dof.direction()]).sum::<f64>()
    };
    let force_of = |x: f64| with_unit(&six_digits(x), &case.scene.units.force);
    Ok(count_nodes(model, |i| {
        let pulls = statuses[i].in_contact && push(i) < -rounding;
        pulls.then(|| format!("stays in contact although it pulls with {}", force_of(-push(i))))
    }))
}

/// K6: the stamp released from its restraints, eq. (1) on one and on two of its nodes in contact.
pub(super) fn hinge(case: &Case) -> Outcome<Evidence> {
    let call = first_in_contact(case)?;
    let stiffness = Stiffness::new(case.model(), |x| x);
    let linked = door::linked(&call.sheet, &call.pairs);
    let mut holds = case.model().holds.clone();
    let stamp = case.model().body_of(case.model().contact.nodes[0]);
    holds.release(stamp.into_iter().flat_map(|body| &body.nodes).flat_map(|n| n.dofs()));
    // Nothing where the scene has not so many nodes in contact.
    let singular = [1, 2].map(|count| {
        let few: Vec<Constraint> =
            linked.get(..count)?.iter().map(|bound| (*bound).into()).collect();
        let reduced = stiffness.reduced(&Elimination::new(&holds, &few));
        Some(SparseCholesky::new(&reduced).is_err())
    });
    let most = singular.iter().rposition(|singular| *singular == Some(true)).map_or(0, |at| at + 1);
    let [one, two] = singular.map(|singular| match singular {
        Some(true) => "singular",
        Some(false) => "solvable",
        None => "not in this scene",
    });
    let detail = format!("the released stamp with one linked node is {one}, with two {two}");
    Ok(Evidence::must_be_present(singular[0] == Some(true), most as f64, detail))
}
