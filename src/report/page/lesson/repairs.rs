//! The chapter that goes from the print to the right answer: its runs and its table.

use serde_json::{Value, json};

use super::Shared;
use crate::language::Language;
use crate::layout::{counted, listed};
use crate::prices::{ORDER, not_needed};
use mathcad::Settings;
use paper::corrected::FAULTS;
use studies::audit::prices::Outcome;
use studies::lesson::Repairs;

/// Returns the title, with the number of edits.
pub fn title(repairs: &Repairs) -> String {
    let edits = counted(repairs.needed, "edit", "edits");
    format!("From the print to the right answer in {edits}")
}

/// Returns the run of the corrected programs after some repairs, which stands beside the printed one.
pub fn run(
    repairs: &Repairs,
    count: usize,
    printed: &Value,
    shared: &mut Shared,
    language: Language,
) -> Value {
    let edits: Vec<&str> = repairs.left(count).map(|fault| fault.edit).collect();
    let programs = shared.programs(&edits);
    let name = match count {
        _ if count == FAULTS.len() => "corrected".into(),
        1 => format!("after {count} repair"),
        _ => format!("after {count} repairs"),
    };
    let mut run = printed.clone();
    run["label"] = json!(language.say(&name));
    run["about"] = json!(language.say(&about(repairs, count)));
    run["c_cnt"] = json!(programs["c_cnt"]);
    run["Km"] = json!(programs["Km"]);
    run["name"] = json!(name);
    run["programs"] = json!(programs);
    run["settings"] = json!(Settings::default());
    run
}

/// Returns the table: a row after each number of repairs that is shown.
pub fn json(repairs: &Repairs, language: Language) -> Value {
    let row = |count: usize| {
        let outcome = &repairs.rows[count].outcome;
        let last = repairs.last(count);
        let words = match count <= repairs.needed {
            true => repairs.rows[count].fault.clone(),
            false => not_needed(&repairs.rows[repairs.needed + 1..]),
        };
        let mut row = json!({
            "repairs": count,
            "finding": last.map(|fault| fault.finding),
            "fault": language.say(&words),
            "places": last.map(|fault| listed(fault.places())),
        });
        if let Outcome::Result { in_contact, transmitted, .. } = outcome {
            row["in_contact"] = json!(in_contact);
            row["transmitted"] = json!(transmitted);
            row["error"] = json!(outcome.error());
        }
        row
    };
    json!({
        "order": language.say(ORDER),
        "rows": repairs.shown().map(row).collect::<Vec<_>>(),
    })
}

/// Says which repair of a run is the last.
fn about(repairs: &Repairs, count: usize) -> String {
    match repairs.last(count) {
        Some(fault) => format!("the last is {}: {}", fault.finding, listed(fault.places())),
        None if count == 0 => repairs.rows[0].fault.clone(),
        None => "all are repaired".into(),
    }
}
