//! Findings of the stiffness matrix, `Km`, and of the iterations.

use super::experiment::{ROUNDING, at_shapes, c_cnt, contact_nodes, first_in_contact, mjs};
use super::geometry::away;
use super::{Measured, Verdict};
use crate::answer::contact::{Elimination, free_stiffness, max_displacement, ties};
use crate::numbers::solve::DenseLu;
use crate::paper::mathcad::array::{Column, Table};
use crate::paper::mirror::{Failure, Km, Pairs, Reading, Worksheet};
use crate::problem::modelling::Variant;
use crate::problem::scene::Body;
use crate::studies::audit::Case;

/// K1: entries of MJS that join two bodies, at the first shape with contact.
pub(super) fn nothing_joins(case: &Case) -> Measured {
    let Some((node_n, _)) = first_in_contact(case) else { return Measured::nothing("no contact") };
    let mjs = match mjs(&case.sheet, &node_n) {
        Ok(mjs) => mjs,
        Err(failure) => return Measured::nothing(failure.to_string()),
    };
    let joins: usize = case.scene.bodies.iter().map(|body| joins(&mjs, body)).sum();
    let verdict = if joins == 0 { Verdict::Holds } else { Verdict::Contradicted };
    Measured { verdict, number: joins as f64, detail: target_moves(case) }
}

/// Entries of `mjs` in a row of `body` and a column of another.
fn joins(mjs: &Table<f64>, body: &Body) -> usize {
    let mut of_body = vec![false; mjs.rows()];
    for n in &body.nodes {
        of_body[2 * n - 2] = true;
        of_body[2 * n - 1] = true;
    }
    let columns = mjs.as_matrix().column_iter().zip(&of_body).filter(|(_, inside)| !**inside);
    columns
        .map(|(c, _)| c.iter().zip(&of_body).filter(|(x, row)| **row && **x != 0.0).count())
        .sum()
}

fn target_moves(case: &Case) -> String {
    let (Ok(outcome), Some(target)) = (case.run(Variant::Printed), case.scene.target()) else {
        return "printed does not run".into();
    };
    let moved = target.nodes.iter().map(|n| outcome.u.rows(2 * n - 2, 2).norm());
    let (moved, most) = (moved.fold(0.0, f64::max), max_displacement(&outcome.u));
    format!("printed: the target moves by {moved:e}, the stamp by {most:.3e}")
}

/// The weights of the linked nodes of triangle `n`, in its order: pair 1 or 2 of k_cnt.
fn linked(sheet: &Worksheet<f64>, pairs: &Pairs<f64>, n: usize, pair: usize) -> Vec<f64> {
    (1..=3)
        .map(|i1| sheet.EL[(n, i1 + sheet.ind_1 - 1)])
        .filter(|node| pairs.k_cnt[(*node, 2 * pair - 1)] > 0.0)
        .map(|node| pairs.k_cnt[(node, 2 * pair)])
        .collect()
}

/// The additions (triangle, pair) of which `is` is true of the weights of the linked nodes, each in words.
fn additions(
    sheet: &Worksheet<f64>,
    pairs: &Pairs<f64>,
    is: impl Fn(&[f64]) -> bool,
) -> Vec<(usize, String)> {
    let all = (1..=sheet.M()).flat_map(|n| [1, 2].map(|pair| (n, pair)));
    all.map(|(n, pair)| (n, pair, linked(sheet, pairs, n, pair)))
        .filter(|(_, _, weights)| is(weights))
        .map(|(n, pair, weights)| (n, format!("triangle {n}, pair {pair}: weights {weights:?}")))
        .collect()
}

/// K2: triangles with two linked nodes of different weight.
pub(super) fn one_weight_for_all(case: &Case) -> Measured {
    at_shapes(case, |node_n| {
        let pairs = c_cnt(&case.sheet, node_n)?;
        let mut found = additions(&case.sheet, &pairs, |w| w.windows(2).any(|w| w[0] != w[1]));
        found.dedup_by_key(|(n, _)| *n);
        Ok(Measured::count(&found.into_iter().map(|(_, words)| words).collect::<Vec<_>>()))
    })
}

/// K7: additions whose last weight is 0 while another is not.
pub(super) fn switched_off(case: &Case) -> Measured {
    at_shapes(case, |node_n| {
        let pairs = c_cnt(&case.sheet, node_n)?;
        let off = |w: &[f64]| w.last() == Some(&0.0) && w.iter().any(|k| *k != 0.0);
        let found = additions(&case.sheet, &pairs, off);
        Ok(Measured::count(&found.into_iter().map(|(_, words)| words).collect::<Vec<_>>()))
    })
}

/// K3: the 1 of a held equation outside the range of the other diagonal entries.
pub(super) fn ones_on_the_diagonal(case: &Case) -> Measured {
    at_shapes(case, |node_n| {
        let diagonal = mjs(&case.sheet, node_n)?.as_matrix().diagonal();
        let range = |held: usize| {
            let of = diagonal.iter().zip(case.sheet.S.iter()).filter(|(_, s)| **s == held);
            of.fold((f64::INFINITY, 0.0_f64), |(low, high), (x, _)| (low.min(*x), high.max(*x)))
        };
        let ((low, high), (held, _)) = (range(0), range(1));
        let detail = format!("held: {held}, others {low:.4e} to {high:.4e}");
        let outside = held < low || (held > high && held.is_finite());
        Ok(Measured::holds_if(outside, high.max(held) / low.min(held), detail))
    })
}

/// K8: the smallest diagonal entry of MJS.
pub(super) fn stiffness_taken_away(case: &Case) -> Measured {
    at_shapes(case, |node_n| {
        let diagonal = mjs(&case.sheet, node_n)?.as_matrix().diagonal();
        let (at, smallest) = diagonal.argmin();
        let detail = format!("node {}, direction {}", at / 2 + 1, ["x", "y"][at % 2]);
        Ok(Measured::holds_if(smallest < 0.0, smallest, detail))
    })
}

/// K4: rows of zeros that one node without a triangle adds, free or held.
pub(super) fn orphan(case: &Case) -> Measured {
    let zero_rows = |orphans: usize, held: usize| -> Result<usize, Failure> {
        let sheet = with_orphans(&case.sheet, orphans, held);
        let mjs = Km(&sheet, &Reading::default(), &Table::filled(sheet.R(), 4, 0.0))?;
        Ok((1..=mjs.rows()).filter(|&i| mjs.row(i).all(|x| *x == 0.0)).count())
    };
    let counted = zero_rows(0, 0).and_then(|own| Ok((own, zero_rows(1, 0)?, zero_rows(1, 1)?)));
    match counted {
        Ok((own, free, held)) => Measured {
            verdict: if free == own + 2 { Verdict::Holds } else { Verdict::Contradicted },
            number: (free - own) as f64,
            detail: format!(
                "rows of zeros: {own} without the node, {free} with it, {held} where S holds it"
            ),
        },
        Err(failure) => Measured::nothing(failure.to_string()),
    }
}

/// The arrays with nodes added that belong to no triangle; `held` is their S.
fn with_orphans(sheet: &Worksheet<f64>, orphans: usize, held: usize) -> Worksheet<f64> {
    let last = sheet.R();
    let node = |n: usize, j: usize| if n <= last { sheet.node[(n, j)] } else { n as f64 };
    let mut held_too = sheet.S.as_slice().to_vec();
    held_too.extend(vec![held; 2 * orphans]);
    Worksheet {
        node: Table::from_fn(last + orphans, 4, node),
        S: Column::from_vec(held_too),
        ..sheet.clone()
    }
}

/// K5: the cycle in which `tied` ends.
pub(super) fn cycle(case: &Case) -> Measured {
    let iterations = match case.run(Variant::Tied) {
        Ok(outcome) => &outcome.iterations,
        Err(error) => return Measured::nothing(error.to_string()),
    };
    let Some(cycle) = iterations.last().and_then(|it| it.cycle.as_ref()) else {
        return Measured::nothing(format!("no state came back in {} iterations", iterations.len()));
    };
    let counts = cycle.members.iter().map(|k| iterations[k - 1].in_contact);
    let detail = format!("nodes in contact: {:?}", counts.collect::<Vec<_>>());
    let entered = iterations.iter().any(|it| it.pairs.dy != iterations[0].pairs.dy);
    let verdict = match cycle.length {
        1 if entered => Verdict::Contradicted,
        1 => Verdict::DoesNotArise,
        _ => Verdict::Holds,
    };
    Measured { verdict, number: cycle.length as f64, detail }
}

/// K9: nodes that eq. (1) holds on the target with a pull, at the end of `stepped`.
pub(super) fn pulls(case: &Case) -> Measured {
    let sheet = &case.sheet;
    let (outcome, k) =
        match (case.run(Variant::Stepped), free_stiffness(sheet, &Reading::default())) {
            (Ok(outcome), Ok(k)) => (outcome, k),
            (Err(error), _) => return Measured::nothing(error.to_string()),
            (_, Err(failure)) => return Measured::nothing(failure.to_string()),
        };
    let Some(last) = outcome.iterations.last() else { return Measured::nothing("no iteration") };
    // What eq. (1) adds at each equation; at a held one it cannot be told from the support's reaction.
    let tie = k.as_matrix() * &outcome.u - &case.scene.load;
    let rounding = ROUNDING * tie.amax();
    let push = |i1: usize| {
        let away = away(sheet, &sheet.node, last.pairs.ct[i1]).unwrap_or_default();
        let equation = |direction: usize| 2 * sheet.cnt[i1] - 1 + direction;
        let free = [0, 1].into_iter().filter(|&d| sheet.S[equation(d)] == 0);
        free.map(|d| tie[equation(d) - 1] * away[d]).sum::<f64>()
    };
    Measured::count(&contact_nodes(
        sheet,
        |i1| last.pairs.dy[i1] == 1 && push(i1) < -rounding,
        |i1| format!("held with {:.3e}", -push(i1)),
    ))
}

/// K6: the stamp released from its restraints, eq. (1) on one and on two of its nodes in contact.
pub(super) fn hinge(case: &Case) -> Measured {
    let Some((_, pairs)) = first_in_contact(case) else { return Measured::nothing("no contact") };
    let k = match free_stiffness(&case.sheet, &Reading::default()) {
        Ok(k) => k,
        Err(failure) => return Measured::nothing(failure.to_string()),
    };
    let released = released(case, case.sheet.cnt[1]);
    // Nothing where the scene has not so many nodes in contact.
    let singular = [1, 2].map(|count| {
        let few = first_ties(&case.sheet, &pairs, count)?;
        Some(
            DenseLu::new(Elimination::new(&released, &ties(&released, &few)).matrix(k.as_matrix()))
                .is_err(),
        )
    });
    let most = singular.iter().rposition(|singular| *singular == Some(true)).map_or(0, |at| at + 1);
    let [one, two] = singular.map(|singular| match singular {
        Some(true) => "singular",
        Some(false) => "solvable",
        None => "not in this scene",
    });
    let verdict = if singular[0] == Some(true) { Verdict::Holds } else { Verdict::Contradicted };
    let detail = format!("one linked node: {one}; two: {two}");
    Measured { verdict, number: most as f64, detail }
}

/// The arrays with the body of `node` held by nothing.
fn released(case: &Case, node: usize) -> Worksheet<f64> {
    let mut sheet = case.sheet.clone();
    for n in case.scene.body_of(node).into_iter().flat_map(|body| &body.nodes) {
        sheet.S[2 * n - 1] = 0;
        sheet.S[2 * n] = 0;
    }
    sheet
}

/// The pairs with only the first `count` different contact nodes in contact; nothing where there are fewer.
fn first_ties(sheet: &Worksheet<f64>, pairs: &Pairs<f64>, count: usize) -> Option<Pairs<f64>> {
    let mut few = pairs.clone();
    let mut kept: Vec<usize> = Vec::new();
    for i1 in (1..=pairs.dy.rows()).filter(|&i1| pairs.dy[i1] == 1) {
        let node = sheet.cnt[i1];
        if kept.len() < count && !kept.contains(&node) {
            kept.push(node);
        } else if !kept.contains(&node) {
            few.dy[i1] = 0;
        }
    }
    (kept.len() == count).then_some(few)
}
