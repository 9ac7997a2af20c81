//! The chapter that goes from the print to the right answer: its runs and its table.

use std::fmt::Display;

use serde_json::{Value, json};

use super::Shared;
use crate::audit::evidence::NoFigures;
use crate::audit::prices::price_tables::ORDER;
use crate::lesson::Repairs;
use crate::lesson::language::fill;
use mathcad::Settings;
use output::layout::listed;
use paper::corrected::FAULTS;

/// Returns the title, with the number of edits.
pub fn title(repairs: &Repairs) -> Value {
    match repairs.needed {
        1 => fill("From the print to the right answer in 1 edit", &[]),
        count => fill("From the print to the right answer in {count} edits", &[("count", &count)]),
    }
}

/// Returns the run of the corrected programs after some repairs, which stands beside the printed one.
pub fn run(repairs: &Repairs, count: usize, printed: &Value, shared: &mut Shared) -> Value {
    let edits: Vec<&str> = repairs.left(count).map(|fault| fault.edit).collect();
    let programs = shared.programs(&edits);
    let mut run = printed.clone();
    run["label"] = label(count);
    run["about"] = about(repairs, count);
    run["c_cnt"] = json!(programs["c_cnt"]);
    run["Km"] = json!(programs["Km"]);
    run["name"] = json!(format!("after {count}"));
    run["programs"] = json!(programs);
    run["settings"] = json!(Settings::default());
    run
}

fn label(count: usize) -> Value {
    match count {
        _ if count == FAULTS.len() => fill("corrected", &[]),
        1 => fill("after 1 repair", &[]),
        _ => fill("after {count} repairs", &[("count", &count)]),
    }
}

/// Returns the table: a row after each number of repairs that is shown.
pub fn json(repairs: &Repairs) -> Value {
    let row = |count: usize| {
        let price = &repairs.rows[count];
        let last = repairs.last(count);
        let words = match last {
            Some(fault) => json!(fault.words()),
            None if count == 0 => fill("all are reintroduced", &[]),
            None => not_needed(repairs),
        };
        let mut row = json!({
            "repairs": count,
            "finding": last.map(|fault| fault.finding),
            "fault": words,
            "places": last.map(|fault| listed(fault.places())),
        });
        match &price.outcome {
            Ok(run) => {
                row["in_contact"] = json!(run.in_contact);
                row["transmitted"] = json!(run.transmitted);
                row["error"] = json!(run.error());
            }
            Err(NoFigures::Rounding) => row["by_rounding"] = json!(true),
            Err(NoFigures::Fails(_) | NoFigures::Refused(_)) => (),
        }
        row
    };
    json!({
        "order": ORDER,
        "rows": repairs.shown().map(row).collect::<Vec<_>>(),
    })
}

/// Names the repairs behind those that lead to the solution.
fn not_needed(repairs: &Repairs) -> Value {
    let others = repairs.rows[repairs.needed + 1..].iter();
    let names: Vec<_> = others.filter_map(|row| row.name.as_deref()).collect();
    let mut said = fill("Not needed here: {names}.", &[]);
    said["values"]["names"] = json!(names);
    said
}

/// Says which repair of a run is the last.
fn about(repairs: &Repairs, count: usize) -> Value {
    match repairs.last(count) {
        Some(fault) => {
            let (finding, places) = (fault.finding, listed(fault.places()));
            let values: [(&str, &dyn Display); 2] = [("finding", &finding), ("places", &places)];
            fill("the last is {finding}: {places}", &values)
        }
        None if count == 0 => fill("all are reintroduced", &[]),
        None => fill("all are repaired", &[]),
    }
}
