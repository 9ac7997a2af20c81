//! What rounding does to the numbers of a run.

use crate::layout::{counted, first_line};
use crate::model::Report;
use crate::numbers::six_digits;
use engine::estimates::{Certainty, ContactChange, Perturbed, When};
use engine::{Assessment, Solution};

/// What is said of a run for which rounding was not measured.
const UNCHECKED: &str = "rounding: not checked; solve --check-rounding repeats the run with inputs changed in \
                         the last digit";

/// Says in which numbers a run is done where rounding in f64 decides who is in contact.
pub fn certainty(certainty: Certainty) -> Option<String> {
    let words = match certainty {
        Certainty::Certain => return None,
        Certainty::InDoubleDouble => {
            "the last digit of the inputs decides who is in contact in f64; this is the run in double-doubles"
        }
        Certainty::Decided => "the last digit of the inputs decides who is in contact",
        Certainty::Unchecked => UNCHECKED,
    };
    Some(words.into())
}

/// Reports what rounding does to the result; nothing where that was left out.
pub fn error_estimates(solution: &Solution, assessment: &Assessment) -> Report {
    let measured = assessment.rounding.as_ref().map(perturbed);
    if assessment.estimates.is_none() {
        // It was asked for even so.
        return Report::default().notes(measured.into_iter().flatten());
    }
    let unmeasured = match solution.request.arithmetic.scalar.is_exact() {
        true => "rounding: none, as the numbers are exact",
        false => UNCHECKED,
    };
    let notes = measured.unwrap_or_else(|| vec![unmeasured.into()]);
    Report::default().heading("Rounding").notes(notes)
}

/// Says what inputs that differ in their last digits change.
pub fn perturbed(found: &Perturbed) -> Vec<String> {
    let Perturbed { other_steps, failures, contact, displacement, stress, .. } = found;
    let contact = match contact {
        None => "change no contact state".into(),
        Some(ContactChange { node, when, nodes }) => {
            let when = match when {
                When::Load(load) => format!("after {} of the load", six_digits(*load)),
                When::Iteration(k) => format!("in iteration {k}"),
            };
            let nodes = counted(*nodes, "node", "nodes");
            format!("CHANGE WHO IS IN CONTACT: the status of {nodes}, first at node {node} {when}")
        }
    };
    let part = |x: &Option<f64>| x.map_or("unknown".into(), |x| format!("{x:.0e}"));
    let inputs = match found.in_double_doubles {
        true => format!(
            "rounding: a run in f64x2 and {} with inputs changed in the last digit",
            found.runs - 1
        ),
        false => format!("rounding: inputs changed in the last digit ({} runs)", found.runs),
    };
    let mut lines = Vec::new();
    if (failures.len() as u64) < found.runs {
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
