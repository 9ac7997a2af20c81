//! What rounding does to the numbers of a run.

use crate::layout::{counted, first_line};
use crate::model::Report;
use crate::numbers::{or_dash, six_digits, with_unit};
use engine::estimates::{BodyEstimates, Certainty, ContactChange, Perturbed};
use engine::{Assessment, Decision, Solution};
use problem::modelling::Variant;

/// What is said of a run of `unilateral` for which rounding was not measured.
const UNCHECKED: &str = "rounding: not checked; solve --check-rounding repeats the run with inputs changed in \
                         the last digit";

/// Says in which numbers a run is done where rounding in f64 may decide who is in contact.
pub fn certainty(certainty: Certainty) -> Option<String> {
    let numbers = match certainty {
        Certainty::Certain => return None,
        Certainty::InDoubleDouble => "this is the run in double-doubles, where it decides nothing",
        Certainty::Unknown => "in no other numbers is it known not to",
        Certainty::Unchecked => return Some(UNCHECKED.into()),
    };
    Some(format!("rounding in f64 may decide who is in contact; {numbers}"))
}

/// Reports what rounding does to the result; nothing where that was left out.
pub fn error_estimates(solution: &Solution, assessment: &Assessment) -> Report {
    let Some(estimates) = &assessment.estimates else {
        // It was asked for even so.
        return Report::default().notes(assessment.rounding.iter().flat_map(perturbed));
    };
    let (errors, units) = (&estimates.errors, &solution.request.scene.units);
    let report = Report::default().heading("Rounding");
    if solution.request.variant == Variant::Unilateral {
        return report
            .notes(assessment.rounding.as_ref().map_or(vec![UNCHECKED.into()], perturbed));
    }
    let displacement = moved_by_rounding(errors.displacement_arithmetic, &units.length);
    let stress = |body: &BodyEstimates| {
        let moved = moved_by_rounding(body.arithmetic, &units.stress);
        format!("largest von Mises stress, {}: {moved}", body.name)
    };
    report
        .note(format!("largest |u|: {displacement}"))
        .notes(errors.bodies.iter().map(stress))
        .notes(by_rounding(solution, errors.decided_by_rounding.as_deref()))
}

/// Says what rounding may do to a number, by the bound that is kept.
fn moved_by_rounding(by: Option<f64>, unit: &str) -> String {
    match by {
        Some(by) => {
            format!("rounding moves it by at most {}", with_unit(&format!("{by:.1e}"), unit))
        }
        None => "what rounding does to it is not known".into(),
    }
}

/// Says what rounding may have decided: the first decision, and how many there are.
fn by_rounding(solution: &Solution, decisions: Option<&[Decision]>) -> Option<String> {
    let Some(decisions) = decisions else {
        return Some("who is in contact: whether rounding decides it is not known".into());
    };
    let Decision { iteration, node, condition, margin, bound } = decisions.first()?;
    let length = |x: f64| with_unit(&format!("{x:.1e}"), &solution.request.scene.units.length);
    let margin = margin.map_or(String::new(), |margin| {
        format!(" (margin {}, bound {})", length(margin), or_dash(*bound, length))
    });
    let times = counted(decisions.len(), "time", "times");
    Some(format!(
        "who is in contact: rounding may have decided {times}, first in iteration {iteration} at node \
         {node}: {condition}{margin}"
    ))
}

/// Says what inputs that differ in their last digits change.
pub fn perturbed(found: &Perturbed) -> Vec<String> {
    let Perturbed { runs, other_steps, failures, contact, displacement, stress } = found;
    let contact = match contact {
        None => "change no contact state".into(),
        Some(ContactChange { node, load, nodes }) => format!(
            "CHANGE WHO IS IN CONTACT: the status of {}, first at node {node} after {} of the load",
            counted(*nodes, "node", "nodes"),
            six_digits(*load)
        ),
    };
    let part = |x: &Option<f64>| x.map_or("unknown".into(), |x| format!("{x:.0e}"));
    let inputs = format!("rounding: inputs changed in the last digit ({runs} runs)");
    let mut lines = Vec::new();
    if (failures.len() as u64) < *runs {
        let steps = match other_steps {
            0 => String::new(),
            n => format!("; {n} of the runs take OTHER STEPS of the load"),
        };
        lines.push(format!(
            "{inputs} {contact}, displacements by {} of the largest, and stresses by {}{steps}",
            part(displacement),
            part(stress)
        ));
    }
    lines.extend(failures.first().map(|why| {
        format!("{inputs} end {} of the runs WITHOUT A RESULT: {}", failures.len(), first_line(why))
    }));
    lines
}
