//! Snapshots as files, and what verifying them found: for people, as JSON, Markdown and JUnit XML.

mod field;
mod words;

use schemars::JsonSchema;
use serde::Serialize;

pub use field::difference_files;
pub use words::{difference, explanation};

use super::json::{headed, pretty};
use crate::problem::scene::Units;
use crate::studies::snapshot::{
    Acceptance, Difference, Explanation, Run, Snapshot, Verified, VerifiedRun,
};
use crate::xml::Element;

/// A snapshot's file and what verifying it found.
pub struct Checked {
    /// The name of the file, as given.
    pub file: String,
    pub verified: Verified,
}

/// Returns the text of a snapshot's file.
pub fn file(snapshot: &Snapshot) -> String {
    pretty(snapshot)
}

/// Returns what was recorded, for people.
pub fn recorded(snapshot: &Snapshot) -> String {
    let run = |(name, run): (&str, &Run)| {
        let (facts, numbers) = (run.facts.len(), run.numbers.iter().map(|(_, n)| n.places().len()));
        let failure = run.facts.get("failure").filter(|failure| !failure.is_null());
        let failure = failure.map_or(String::new(), |failure| {
            format!("; exit status {}: {failure}", run.exit_status().unwrap_or_default())
        });
        let unbounded = run.numbers.iter().filter(|(_, numbers)| numbers.bound.is_none()).count();
        let unbounded = match unbounded {
            0 => String::new(),
            count => format!("; {count} arrays have no bound on their rounding errors"),
        };
        let numbers: usize = numbers.sum();
        format!(
            "{} {name}: {facts} facts, {numbers} numbers{unbounded}{failure}\n",
            snapshot.input.name
        )
    };
    snapshot.runs.iter().map(run).collect()
}

/// Returns how a run compares, in a word or two.
fn verdict(run: &VerifiedRun) -> String {
    match (run.compared, run.differences.is_empty()) {
        (0, _) => "nothing was compared".into(),
        (compared, true) => format!("same, {compared} facts and numbers"),
        (_, false) => "differs".into(),
    }
}

/// Returns what verifying found, for people.
pub fn text(checked: &[Checked]) -> String {
    checked.iter().map(of_file).collect()
}

fn of_file(checked: &Checked) -> String {
    let mut text = format!("{}: {}\n", checked.file, of_runs(&checked.verified));
    for run in &checked.verified.runs {
        text += &format!("  {}: {}\n", run.name, verdict(run));
        text += &indent(&run_words(run), "    ");
    }
    text
}

fn of_runs(verified: &Verified) -> String {
    let differ = verified.runs.iter().filter(|run| !run.differences.is_empty()).count();
    match (verified.runs.len(), verified.is_same()) {
        (0, _) => "no run in it, nothing was compared".into(),
        (runs, true) => format!("same, {runs} {}", if runs == 1 { "run" } else { "runs" }),
        (runs, false) => format!("{differ} of {runs} runs differ"),
    }
}

/// Returns why a run differs and in what; no text where it does not.
fn run_words(run: &VerifiedRun) -> String {
    if run.differences.is_empty() {
        return String::new();
    }
    let why = run.explanation.as_ref().map(explanation).unwrap_or_default();
    why + &words::summary(&run.differences)
}

fn indent(text: &str, by: &str) -> String {
    text.lines().map(|line| format!("{by}{line}\n")).collect()
}

/// Returns what verifying found as a page of Markdown.
pub fn markdown(checked: &[Checked]) -> String {
    let mut text =
        String::from("# plane-contact verify\n\n| snapshot | run | verdict |\n|---|---|---|\n");
    for Checked { file, verified } in checked {
        for run in &verified.runs {
            text += &format!("| {file} | {} | {} |\n", run.name, verdict(run));
        }
        if verified.runs.is_empty() {
            text += &format!("| {file} | - | {} |\n", of_runs(verified));
        }
    }
    for Checked { file, verified } in checked {
        for run in verified.runs.iter().filter(|run| !run.differences.is_empty()) {
            text += &format!("\n## {file}: {}\n\n```text\n{}```\n", run.name, run_words(run));
        }
    }
    text
}

/// Returns what verifying found as JUnit XML: a suite a file, a case a run.
pub fn junit(checked: &[Checked]) -> String {
    let failed = |run: &VerifiedRun| !run.differences.is_empty() || run.compared == 0;
    let case = |run: &VerifiedRun| {
        let case = Element::new("testcase").set("name", &run.name).set("classname", "snapshot");
        match failed(run) {
            false => case,
            true => {
                let failure = Element::with_text("failure", &run_words(run));
                case.with(failure.set("message", words::headline(run)))
            }
        }
    };
    let suite = |Checked { file, verified }: &Checked| {
        let failures = verified.runs.iter().filter(|run| failed(run)).count();
        let is_empty = verified.runs.is_empty();
        let nothing = is_empty.then(|| {
            let failure = Element::with_text("failure", "nothing was compared");
            Element::new("testcase").set("name", "runs").set("classname", "snapshot").with(failure)
        });
        Element::new("testsuite")
            .set("name", file)
            .set("tests", verified.runs.len().max(1).to_string())
            .set("failures", failures.max(usize::from(is_empty)).to_string())
            .with_all(verified.runs.iter().map(case))
            .with_all(nothing)
    };
    Element::new("testsuites").with_all(checked.iter().map(suite)).document()
}

/// What verifying found, as JSON.
#[derive(Serialize, JsonSchema)]
pub struct Document<'a> {
    /// Whether something was compared in every file, and nothing differs.
    same: bool,
    files: Vec<FileRow<'a>>,
}

/// What verifying a file found.
#[derive(Serialize, JsonSchema)]
struct FileRow<'a> {
    file: &'a str,
    same: bool,
    /// The names of the units of the scene that was run.
    units: Units,
    /// The SHA-256 of that scene.
    scene_sha256: &'a str,
    /// The SHA-256 of its mesh.
    mesh_sha256: &'a str,
    runs: Vec<RunRow<'a>>,
}

/// What verifying a run found.
#[derive(Serialize, JsonSchema)]
struct RunRow<'a> {
    run: &'a str,
    same: bool,
    /// How many facts and numbers were compared.
    compared: usize,
    /// Why it differs; null where it does not.
    explanation: &'a Option<Explanation>,
    /// What differs, in the order of computation.
    differences: &'a [Difference],
}

impl<'a> From<&'a VerifiedRun> for RunRow<'a> {
    fn from(run: &'a VerifiedRun) -> Self {
        RunRow {
            run: &run.name,
            same: run.differences.is_empty() && run.compared > 0,
            compared: run.compared,
            explanation: &run.explanation,
            differences: &run.differences,
        }
    }
}

impl<'a> From<&'a Checked> for FileRow<'a> {
    fn from(Checked { file, verified }: &'a Checked) -> Self {
        FileRow {
            file,
            same: verified.is_same(),
            units: verified.input.units(),
            scene_sha256: &verified.input.scene_sha256,
            mesh_sha256: &verified.input.mesh_sha256,
            runs: verified.runs.iter().map(RunRow::from).collect(),
        }
    }
}

/// Returns what verifying found as JSON.
pub fn json(checked: &[Checked]) -> String {
    let same = checked.iter().all(|checked| checked.verified.is_same());
    headed(&Document { same, files: checked.iter().map(FileRow::from).collect() })
}

/// Returns what was accepted, for people.
pub fn accepted(accepted: &[Acceptance]) -> String {
    let one = |a: &Acceptance| {
        let by = match (a.bounds, a.differing) {
            (Some(bounds), Some(count)) => {
                format!(" ({bounds:.3e} times what it may; {count} numbers)")
            }
            (None, Some(count)) => format!(" ({count} numbers)"),
            _ => String::new(),
        };
        format!(
            "accepted {}: {}, was {}{by}\n",
            a.entry,
            words::short(&a.to),
            words::short(&a.from)
        )
    };
    accepted.iter().map(one).collect()
}
