//! How claims are measured.

use super::{Measured, Outcome, Verdict};
use crate::answer::estimates::{Certainty, certain};
use crate::answer::{Request, distance, solve};
use crate::problem::modelling::Variant;
use crate::studies::audit::Case;
use crate::studies::audit::findings::{self, FINDINGS};
use crate::studies::audit::statuses::{self, Score};
use crate::studies::trade::{Knob, Trial, trials};

/// A relative change that shows in a picture: one part in a hundred.
const NOTICEABLE: f64 = 0.01;

/// Random scenes for each row of the measurement of the status rules, and their seed.
const SCENES: usize = 20;
const SEED: u64 = 1;

fn measured(verdict: Verdict, number: f64, detail: impl Into<String>) -> Outcome<'static> {
    Ok(Measured { verdict, number: Some(number), detail: detail.into() })
}

fn holds_if(holds: bool) -> Verdict {
    if holds { Verdict::Holds } else { Verdict::Fails }
}

/// A finding on its own scene: where it holds, the paper's claim has the given verdict.
fn by_finding(id: &str, verdict: Verdict) -> Outcome<'static> {
    let finding = FINDINGS.iter().find(|finding| finding.id == id).expect("an id of the register");
    let found = finding.measure(&Case::new(finding.scene()));
    let verdict =
        if found.verdict == findings::Verdict::Holds { verdict } else { Verdict::Unknown };
    measured(verdict, found.number, finding.title)
}

pub(super) fn nothing_joins(_: &Case) -> Outcome<'_> {
    by_finding("K1", Verdict::Fails)
}

pub(super) fn nothing_releases(_: &Case) -> Outcome<'_> {
    by_finding("K9", Verdict::Condition)
}

pub(super) fn weights_of_the_initial_shape(_: &Case) -> Outcome<'_> {
    by_finding("C6", Verdict::Fails)
}

pub(super) fn deep_node_is_lost(_: &Case) -> Outcome<'_> {
    by_finding("C9", Verdict::Holds)
}

pub(super) fn no_fixed_distance(_: &Case) -> Outcome<'_> {
    by_finding("C15", Verdict::Fails)
}

pub(super) fn one_pair_a_target_node(_: &Case) -> Outcome<'_> {
    by_finding("C7", Verdict::Fails)
}

pub(super) fn nothing_at_hand(_: &Case) -> Outcome<'_> {
    let detail =
        "neither the code, its version's contact settings, the mesh nor the radii are given";
    Ok(Measured { verdict: Verdict::Unknown, number: None, detail: detail.into() })
}

/// Whether eq. (1) ties what friction would: the largest coefficient that a node in contact needs.
pub(super) fn friction_needed(case: &Case) -> Outcome<'_> {
    let solution = case.run(Variant::Unilateral)?;
    let needed = solution.contact.iter().filter_map(|node| node.friction_needed);
    let needed = needed.reduce(f64::max).ok_or("no node is in contact")?;
    measured(Verdict::Condition, needed, "the coefficient of friction is at least this")
}

/// The share of statuses that the sign rule gets wrong where the stamp jumped to twice c_tll.
pub(super) fn signs_go_wrong(_: &Case) -> Outcome<'_> {
    let measurement = statuses::measure(SCENES, SEED);
    let row = measurement.by_depth.iter().find(|row| row.depth == 2.0).ok_or("no such depth")?;
    let missed = row.rules[0].missed as f64 / row.touching as f64;
    let detail = "target below the stamp, jumped to twice c_tll";
    measured(holds_if(missed < NOTICEABLE), missed, detail)
}

/// Operations of the intersection over those of the sign rule.
pub(super) fn fewer_operations(_: &Case) -> Outcome<'_> {
    let measurement = statuses::measure(SCENES, SEED);
    let [signs, intersection] = [0, 1].map(|rule: usize| {
        let of = |score: &Score| score.operations as f64;
        measurement.by_size.last().map_or(0.0, |row| of(&row.rules[rule]))
    });
    measured(holds_if(signs < intersection), intersection / signs, "on the largest surfaces tried")
}

/// What a tolerance of a thousandth changes of the largest displacement, under the scene's variant
/// of the paper, as `trade` runs it.
pub(super) fn tolerance(case: &Case) -> Outcome<'_> {
    let (request, variant) = (Request::new(&case.scene), case.published_variant());
    let of_variant = |trial: &Trial| trial.variant == variant;
    let trials: Vec<Trial> =
        trials(&request, Knob::Tolerance).into_iter().filter(of_variant).collect();
    let own = trials.iter().find(|trial| trial.own).ok_or("the scene has no contact")?;
    let run = |trial: &Trial| solve(&trial.request(&request)?, &mut |_| ()).map(certain);
    let [(least, of_least), (own_run, of_own)] = [run(&trials[0])?, run(own)?];
    let change = distance(&least, &own_run).displacement_relative;
    let numbers = match [of_least, of_own] {
        [Certainty::Certain, Certainty::Certain] => "",
        both if both.contains(&Certainty::Unknown) => "; rounding may decide who is in contact",
        _ => ", in double-doubles where rounding decides in f64",
    };
    let detail = format!("{variant}, from {} to {}{numbers}", own.label, trials[0].label);
    measured(holds_if(change < NOTICEABLE), change, detail)
}

/// After how many iterations the contact state returns at the end of `tied`; 1 = settled.
pub(super) fn settles(case: &Case) -> Outcome<'_> {
    let last = case.run(Variant::Tied)?.last();
    let length = last.cycle.as_ref().map_or(0, |cycle| cycle.length);
    let detail = match length {
        0 => "the contact state is new in the last iteration",
        1 => "the contact state has settled",
        _ => "the contact state repeats in a cycle",
    };
    measured(holds_if(length == 1), length as f64, detail)
}

/// The error in the energy norm of the scene's variant of the paper against the equilibrium under
/// stick on the same mesh.
pub(super) fn error_of_the_reading(case: &Case) -> Outcome<'_> {
    let equilibrium = case.equilibrium().ok_or("there is no equilibrium to compare with")?;
    let (mut least, mut nearest) = (f64::INFINITY, "none");
    for variant in Variant::OF_THE_PAPER {
        if let Ok(solution) = case.run(*variant) {
            let error = distance(solution, equilibrium).energy_relative;
            if error < least {
                (least, nearest) = (error, variant.name());
            }
        }
    }
    measured(holds_if(least < NOTICEABLE), least, format!("{nearest} is the nearest reading"))
}
