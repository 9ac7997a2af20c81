//! What came out: a table by module, and the mutants that no test notices.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::Deserialize;

use crate::grade::{self, Outcome};
use crate::mutant::{Mutant, State};
use crate::{Failure, Work};

/// A mutant that changes nothing, and why: one on this line of this file.
#[derive(Deserialize)]
struct Reviewed {
    file: String,
    /// The line, without the white space around it.
    line: String,
    /// cargo-mutants' words for what is replaced in which function.
    mutant: String,
    #[serde(rename = "reason")]
    _reason: String,
}

#[derive(Default)]
struct Row {
    mutants: usize,
    caught: usize,
    timeout: usize,
    missed: usize,
    open: usize,
    reviewed: usize,
    unviable: usize,
    not_built: usize,
    ungraded: usize,
}

impl Row {
    fn print(&self, name: &str) {
        let judged = self.caught + self.missed + self.open;
        let score = match judged {
            0 => "-".to_owned(),
            _ => format!("{:.1} %", 100.0 * self.caught as f64 / judged as f64),
        };
        println!(
            "{name:34} {:7} {:7} {:7} {:7} {:7} {:8} {:8} {:9} {:8} {score:>8}",
            self.mutants,
            self.caught,
            self.timeout,
            self.missed,
            self.open,
            self.reviewed,
            self.unviable,
            self.not_built,
            self.ungraded
        );
    }
}

/// Prints the table, in whose score what is open counts as missed; fails where nothing was graded.
pub fn print(work: &Work, reviewed: &Path) -> Result<(), Failure> {
    let mutants: Vec<Mutant> = serde_json::from_str(&fs::read_to_string(work.mutants())?)?;
    let reviewed: Vec<Reviewed> = serde_json::from_str(&fs::read_to_string(reviewed)?)?;
    let results = grade::read(work)?;
    let outcomes: BTreeMap<&str, Outcome> =
        results.iter().map(|graded| (graded.name.as_str(), graded.outcome)).collect();
    let is_reviewed = |mutant: &Mutant| {
        let is_it = |known: &Reviewed| {
            known.file == mutant.file && known.line == mutant.text && known.mutant == mutant.what()
        };
        reviewed.iter().any(is_it)
    };
    let mut rows: BTreeMap<String, Row> = BTreeMap::new();
    let mut missed = Vec::new();
    for mutant in &mutants {
        for module in [mutant.module(), "~".to_owned()] {
            let row = rows.entry(module).or_default();
            row.mutants += 1;
            match (&mutant.state, outcomes.get(mutant.name.as_str())) {
                (State::Unviable, _) => row.unviable += 1,
                (State::Constant | State::Inexpressible(_), _) => row.not_built += 1,
                (State::Built, None) => row.ungraded += 1,
                (State::Built, Some(Outcome::Caught)) => row.caught += 1,
                (State::Built, Some(Outcome::Timeout)) => row.timeout += 1,
                (State::Built, Some(_)) if is_reviewed(mutant) => row.reviewed += 1,
                (State::Built, Some(Outcome::Open)) => row.open += 1,
                (State::Built, Some(Outcome::Missed | Outcome::Unreached)) => row.missed += 1,
            }
        }
        let outcome = outcomes.get(mutant.name.as_str()).copied();
        let is_missed = outcome.is_some_and(|o| o >= Outcome::Missed) && !is_reviewed(mutant);
        missed.extend(is_missed.then_some((mutant, outcome)));
    }
    println!(
        "{:34} {:>7} {:>7} {:>7} {:>7} {:>7} {:>8} {:>8} {:>9} {:>8} {:>8}",
        "module",
        "mutants",
        "caught",
        "timeout",
        "missed",
        "open",
        "reviewed",
        "unviable",
        "not built",
        "ungraded",
        "score"
    );
    rows.iter().for_each(|(name, row)| row.print(if name == "~" { "all" } else { name }));
    for (mutant, outcome) in missed {
        let note = match outcome {
            Some(Outcome::Unreached) => "unreached: ",
            Some(Outcome::Open) => "open: ",
            _ => "missed: ",
        };
        println!("{note}{}\n    {}", mutant.name, mutant.text);
    }
    match outcomes.is_empty() {
        true => Err("nothing was graded".into()),
        false => Ok(()),
    }
}
