//! How claims are measured.

use std::num::ParseFloatError;

use super::{Evidence, Outcome, Verdict};
use crate::audit::Case;
use crate::audit::variants::Penetration;
use engine::contact::pulling;
use engine::estimates::Certainty;
use engine::{distance, max_displacement, over};
use problem::modelling::Variant;

/// A relative change that shows in a picture: one part in a hundred.
const NOTICEABLE: f64 = 0.01;

/// What a test measured of the status rules on random scenes whose contact is known.
const STATUSES: &str = include_str!("../../../../golden/tables/statuses.md");

/// Returns the cells of the rows of that table whose first cell begins with `first`.
fn status_rows(first: &str) -> Vec<Vec<&'static str>> {
    let rows = STATUSES.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    rows.map(|row| row.split(" | ").collect::<Vec<_>>())
        .filter(|cells| cells[0].starts_with(first))
        .collect()
}

fn measured(verdict: Verdict, number: f64, detail: impl Into<String>) -> Outcome<'static> {
    Ok(Evidence::new(verdict, Some(number), detail))
}

fn true_if(is_true: bool) -> Verdict {
    if is_true { Verdict::True } else { Verdict::False }
}

/// The largest penetration of a contact node at the end of the scene's variant of the paper, over the
/// largest displacement of the target.
pub(super) fn penetrates(case: &Case) -> Outcome<'_> {
    let variant = case.published_variant();
    let (solution, _) = case.certain(variant)?;
    let Penetration { node, in_contact, depth, relative } =
        Penetration::of(solution).ok_or("no contact node faces the target")?;
    let pulling = pulling(&solution.contact, solution.model.load.amax());
    let is_true = relative < NOTICEABLE && pulling.is_empty();
    let verdict = if is_true { Verdict::TrueOnlyIf } else { Verdict::False };
    let pulls = match pulling.len() {
        0 => "no node in contact pulls".to_string(),
        1 => "1 node in contact pulls".into(),
        n => format!("{n} nodes in contact pull"),
    };
    let status = if in_contact { "in contact" } else { "not in contact" };
    let detail = match verdict {
        Verdict::TrueOnlyIf => pulls,
        Verdict::False if depth == 0.0 => format!("{variant}: nothing penetrates; {pulls}"),
        Verdict::True | Verdict::False | Verdict::NotCheckable => {
            format!("{variant}: node {node}, {status}, ends {depth:.1e} inside the target; {pulls}")
        }
    };
    Ok(Evidence { variant: Some(variant), ..Evidence::new(verdict, Some(relative), detail) })
}

/// Whether eq. (1) ties what friction would: the largest coefficient that a node in contact needs.
pub(super) fn friction_needed(case: &Case) -> Outcome<'_> {
    let solution = case.run(Variant::Unilateral)?;
    let needed = solution.contact.iter().filter_map(|node| node.friction_needed);
    let needed = needed.reduce(f64::max).ok_or("no node is in contact")?;
    measured(Verdict::TrueOnlyIf, needed, "the coefficient of friction is at least the value")
}

/// The share of the nodes in contact that the sign rule misses where the stamp jumped to twice c_tll.
pub(super) fn signs_go_wrong(_: &Case) -> Outcome<'_> {
    let rows = status_rows("2");
    let [below, above] = &rows[..] else { return Err("no such depth".into()) };
    let share =
        |row: &[&str]| Ok::<_, ParseFloatError>(row[3].parse::<f64>()? / row[2].parse::<f64>()?);
    let sample = |row: &[&str]| format!("target {}: {} of {} missed", row[1], row[3], row[2]);
    let (share_below, share_above) = (share(below)?, share(above)?);
    let detail = format!("{}, {}", sample(below), sample(above));
    measured(true_if(share_below.max(share_above) < NOTICEABLE), share_below, detail)
}

/// Operations of the intersection over those of the sign rule.
pub(super) fn fewer_operations(_: &Case) -> Outcome<'_> {
    let rows = status_rows("operations");
    let row = rows.last().ok_or("no such row")?;
    let quotient: f64 = row[5].parse()?;
    measured(true_if(quotient > 1.0), quotient, row[0])
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
    let [own_largest, least_largest] = [own, least].map(|run| max_displacement(&run.u));
    let detail = format!(
        "{variant}, from {tolerance:e} to {:e}{numbers}; the largest displacement itself changes by \
         {:.1} %",
        tolerance / 1000.0,
        100.0 * over(least_largest - own_largest, own_largest).abs()
    );
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
    let mut nearest: Option<(f64, Variant, Certainty)> = None;
    // `printed` passes no load on, whoever is in contact: rounding makes it no nearer.
    let printed = case.run(Variant::Printed).map(|solution| (solution, Certainty::Certain));
    let certain =
        |variant| case.certain(variant).map(|(solution, certainty)| (solution, *certainty));
    for (solution, certainty) in
        [certain(Variant::Stepped), certain(Variant::Tied), printed].into_iter().flatten()
    {
        let error = distance(solution, equilibrium).energy_relative;
        if nearest.is_none_or(|(least, ..)| error < least) {
            nearest = Some((error, solution.request.variant, certainty));
        }
    }
    let (least, variant, certainty) = nearest.ok_or("no variant of the paper runs")?;
    let detail = format!("{variant} is the nearest variant{}", numbers(&[certainty]));
    let measured = Evidence::new(true_if(least < NOTICEABLE), Some(least), detail);
    Ok(Evidence { variant: Some(variant), ..measured })
}
