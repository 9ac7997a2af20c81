//! How claims are measured.

use super::{Evidence, Outcome, Verdict};
use crate::audit::Case;
use crate::audit::statuses::{self, Score};
use engine::distance;
use engine::estimates::Certainty;
use problem::modelling::Variant;

/// A relative change that shows in a picture: one part in a hundred.
const NOTICEABLE: f64 = 0.01;

/// Random scenes for each row of the measurement of the status rules, and their seed.
const SCENES: usize = 20;
const SEED: u64 = 1;

fn measured(verdict: Verdict, number: f64, detail: impl Into<String>) -> Outcome<'static> {
    Ok(Evidence { verdict, number: Some(number), detail: detail.into() })
}

fn true_if(is_true: bool) -> Verdict {
    if is_true { Verdict::True } else { Verdict::False }
}

/// Whether eq. (1) ties what friction would: the largest coefficient that a node in contact needs.
pub(super) fn friction_needed(case: &Case) -> Outcome<'_> {
    let solution = case.run(Variant::Unilateral)?;
    let needed = solution.contact.iter().filter_map(|node| node.friction_needed);
    let needed = needed.reduce(f64::max).ok_or("no node is in contact")?;
    measured(Verdict::TrueOnlyIf, needed, "the coefficient of friction is at least the value")
}

/// The share of statuses that the sign rule gets wrong where the stamp jumped to twice c_tll.
pub(super) fn signs_go_wrong(_: &Case) -> Outcome<'_> {
    let measurement = statuses::measure(SCENES, SEED);
    let row = measurement.by_depth.iter().find(|row| row.depth == 2.0).ok_or("no such depth")?;
    let missed = row.rules[0].missed as f64 / row.touching as f64;
    let detail = "target below the stamp, jumped to twice c_tll";
    measured(true_if(missed < NOTICEABLE), missed, detail)
}

/// Operations of the intersection over those of the sign rule.
pub(super) fn fewer_operations(_: &Case) -> Outcome<'_> {
    let measurement = statuses::measure(SCENES, SEED);
    let [signs, intersection] = [0, 1].map(|rule: usize| {
        let of = |score: &Score| score.operations as f64;
        measurement.by_size.last().map_or(0.0, |row| of(&row.rules[rule]))
    });
    measured(true_if(signs < intersection), intersection / signs, "on the largest surfaces tried")
}

/// The largest difference of a node's displacement between c_tll and a thousandth of it, over the largest
/// displacement, under the scene's variant of the paper.
pub(super) fn tolerance(case: &Case) -> Outcome<'_> {
    case.model().target().ok_or("the scene has no contact")?;
    let variant = case.published_variant();
    let (own, of_own) = case.certain(variant)?;
    let tolerance = own.request.scene.model.contact.tolerance;
    let (least, of_least) = case.finer()?;
    let change = distance(least, own).displacement_relative;
    let numbers = numbers(&[*of_own, *of_least]);
    let detail = format!("{variant}, from {tolerance:e} to {:e}{numbers}", tolerance / 1000.0);
    measured(true_if(change < NOTICEABLE), change, detail)
}

/// Says in which numbers runs were made where rounding counts.
fn numbers(runs: &[Certainty]) -> &'static str {
    if runs.contains(&Certainty::Unknown) {
        "; rounding may decide who is in contact"
    } else if runs.contains(&Certainty::InDoubleDouble) {
        ", in double-doubles where rounding decides in f64"
    } else {
        ""
    }
}

/// The final period of the contact state of `tied`, iterations; 1 = settled, 0 = none yet.
pub(super) fn settles(case: &Case) -> Outcome<'_> {
    let (tied, certainty) = case.certain(Variant::Tied)?;
    let length = tied.last().cycle.as_ref().map_or(0, |cycle| cycle.length);
    let state = match length {
        0 => "the contact state is new in the last iteration",
        1 => "the contact state has settled",
        _ => "the contact state repeats in a cycle",
    };
    let detail = format!("{state}{}", numbers(&[*certainty]));
    measured(true_if(length == 1), length as f64, detail)
}

/// The smallest distance in the energy norm of the paper's variants from the equilibrium under the
/// scene's own friction on the same mesh.
pub(super) fn error_of_the_reading(case: &Case) -> Outcome<'_> {
    let equilibrium = case.equilibrium().ok_or("there is no equilibrium to compare with")?;
    let (mut least, mut nearest) = (f64::INFINITY, "no variant of the paper runs".into());
    // `printed` passes no load on, whoever is in contact: rounding makes it no nearer.
    let printed = case.run(Variant::Printed).map(|solution| (solution, Certainty::Certain));
    let certain =
        |variant| case.certain(variant).map(|(solution, certainty)| (solution, *certainty));
    for (solution, certainty) in
        [certain(Variant::Stepped), certain(Variant::Tied), printed].into_iter().flatten()
    {
        let error = distance(solution, equilibrium).energy_relative;
        if error < least {
            let (variant, numbers) = (solution.request.variant, numbers(&[certainty]));
            (least, nearest) = (error, format!("{variant} is the nearest variant{numbers}"));
        }
    }
    measured(true_if(least < NOTICEABLE), least, nearest)
}
