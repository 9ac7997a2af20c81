//! The chapter that goes from the print to the right answer: its runs and its table.

use std::fmt::Display;

use serde_json::{Value, json};

use super::Shared;
use crate::audit::prices::Outcome;
use crate::audit::prices::table::ORDER;
use crate::lesson::Repairs;
use mathcad::Settings;
use paper::corrected::FAULTS;
use report::language::Language;
use report::layout::listed;

/// Returns the title, with the number of edits.
pub fn title(repairs: &Repairs, language: Language) -> String {
    match repairs.needed {
        1 => language.say("From the print to the right answer in 1 edit").to_string(),
        count => language
            .fill("From the print to the right answer in {count} edits", &[("count", &count)]),
    }
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
    let mut run = printed.clone();
    run["label"] = json!(name(count, language));
    run["about"] = json!(about(repairs, count, language));
    run["c_cnt"] = json!(programs["c_cnt"]);
    run["Km"] = json!(programs["Km"]);
    run["name"] = json!(name(count, Language::En));
    run["programs"] = json!(programs);
    run["settings"] = json!(Settings::default());
    run
}

fn name(count: usize, language: Language) -> String {
    match count {
        _ if count == FAULTS.len() => language.say("corrected").to_string(),
        1 => language.say("after 1 repair").to_string(),
        _ => language.fill("after {count} repairs", &[("count", &count)]),
    }
}

/// Returns the table: a row after each number of repairs that is shown.
pub fn json(repairs: &Repairs, language: Language) -> Value {
    let row = |count: usize| {
        let outcome = &repairs.rows[count].outcome;
        let last = repairs.last(count);
        let words = match last {
            Some(fault) => language.say(&fault.words()).to_string(),
            None if count == 0 => language.say("all are put back").to_string(),
            None => not_needed(repairs, language),
        };
        let mut row = json!({
            "repairs": count,
            "finding": last.map(|fault| fault.finding),
            "fault": words,
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

/// Names the repairs behind those that lead to the solution.
fn not_needed(repairs: &Repairs, language: Language) -> String {
    let others = repairs.rows[repairs.needed + 1..].iter().filter_map(|row| row.name.as_deref());
    let names = listed(others.map(|name| language.say(name)));
    language.fill("Not needed here: {names}.", &[("names", &names)])
}

/// Says which repair of a run is the last.
fn about(repairs: &Repairs, count: usize, language: Language) -> String {
    match repairs.last(count) {
        Some(fault) => {
            let (finding, places) = (fault.finding, listed(fault.places()));
            let values: [(&str, &dyn Display); 2] = [("finding", &finding), ("places", &places)];
            language.fill("the last is {finding}: {places}", &values)
        }
        None if count == 0 => language.say("all are put back").to_string(),
        None => language.say("all are repaired").to_string(),
    }
}
