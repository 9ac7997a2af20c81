//! Snapshots that were compared, each with its file: what was found for people, as JSON, and as JUnit XML.

use serde_json::{Value, json};

use super::words;
use super::{Presence, Verified, VerifiedRun};
use base::xml::Element;
use engine::error::Error;
use output::failure::Failure;
use output::json;
use output::layout::{counted, first_line};
use output::model::Report;
use output::text::COLUMNS;

/// A snapshot's file and what verifying it found, or why it could not be verified.
pub struct VerifiedFile {
    /// The name of the file, as given.
    pub file: String,
    /// What is to be said of the scene that was run: it is the file as it is today, or no file is there.
    pub scene: Option<String>,
    /// What verifying it found, or why it could not be verified.
    pub verified: Result<Verified, Error>,
}

impl VerifiedFile {
    /// Returns whether something was compared and nothing differs.
    pub fn is_same(&self) -> bool {
        self.verified.as_ref().is_ok_and(Verified::is_same)
    }

    fn runs(&self) -> &[VerifiedRun] {
        self.verified.as_ref().map_or(&[], |verified| &verified.runs)
    }
}

/// Returns how a run compares, in a word or two.
fn verdict(run: &VerifiedRun) -> String {
    match (run.compared, run.differences.is_empty()) {
        _ if run.presence != Presence::Both => run.presence.explained(),
        (0, _) => "nothing was compared".into(),
        (compared, true) => {
            let path = run.path.map_or(String::new(), |first| {
                format!("; rounding decides the path from iteration {first} on")
            });
            format!("same, {compared} facts and numbers{path}")
        }
        (_, false) => "differs".into(),
    }
}

/// Reports what verifying found: file by file its runs, and in what they differ; why a file could not be
/// verified stands on a page, and on standard error beside a terminal's report.
pub fn report(checked: &[VerifiedFile], is_page: bool) -> Report {
    checked.iter().fold(Report::default(), |report, VerifiedFile { file, scene, verified }| {
        match verified {
            Err(why) => {
                let report = report.line(format!("{file}: error, it cannot be verified"));
                if is_page { report.code(format!("error: {why}\n")) } else { report }
            }
            Ok(verified) => {
                let report =
                    report.line(format!("{file}: {}", outcome(verified))).notes(scene.clone());
                let report = report.notes((!verified.is_summed_up).then_some(SUMMARY));
                verified.runs.iter().fold(report, |report, run| {
                    let report = report.note(format!("{}: {}", run.name, verdict(run)));
                    match run.differences.is_empty() && run.changes.is_empty() {
                        true => report,
                        false => report.code(run_words(run)),
                    }
                })
            }
        }
    })
}

/// What is said where the first lines of a file do not tell what is in it.
const SUMMARY: &str = "the summary is not that of the runs in the file, which were changed by hand, or it was; snapshot accept writes it anew";

fn outcome(verified: &Verified) -> String {
    let differ = verified.runs.iter().filter(|run| !run.is_same()).count();
    match (verified.runs.len(), differ) {
        (0, _) => "no run in it, nothing was compared".into(),
        (_, 0) if !verified.is_summed_up => "the runs are the same, the summary differs".into(),
        (runs, 0) => format!("same, {}", counted(runs, "run", "runs")),
        (runs, _) => format!("{differ} of {runs} runs differ"),
    }
}

/// Returns in what a run differs.
fn run_words(run: &VerifiedRun) -> String {
    words::first(run) + &words::summary(&run.differences)
}

/// Returns what verifying found as JUnit XML: a suite a file, a case a run.
pub fn junit(checked: &[VerifiedFile]) -> String {
    let test_case =
        |name: &str| Element::new("testcase").set("name", name).set("classname", "snapshot");
    let case = |run: &VerifiedRun| {
        test_case(&run.name).with_all(
            (!run.is_same()).then(|| outcome_of("failure", words::headline(run), &run_words(run))),
        )
    };
    let suite = |checked: &VerifiedFile| {
        let runs = checked.runs();
        let alone = match &checked.verified {
            Err(why) => {
                let why = why.to_string();
                Some(outcome_of("error", first_line(&why).into(), &why))
            }
            Ok(_) if runs.is_empty() => {
                Some(outcome_of("failure", "nothing was compared".into(), ""))
            }
            Ok(verified) if !verified.is_summed_up => {
                Some(outcome_of("failure", SUMMARY.into(), ""))
            }
            Ok(_) => None,
        };
        let errors = usize::from(checked.verified.is_err());
        let failures = runs.iter().filter(|run| !run.is_same()).count();
        let failures = failures + usize::from(alone.is_some()) - errors;
        Element::new("testsuite")
            .set("name", &checked.file)
            .set("tests", runs.len().max(1).to_string())
            .set("failures", failures.to_string())
            .set("errors", errors.to_string())
            .with_all(runs.iter().map(case))
            .with_all(alone.map(|outcome| test_case("runs").with(outcome)))
    };
    let suites = Element::new("testsuites").set("name", "plane-contact");
    suites.with_all(checked.iter().map(suite)).document()
}

/// Returns the outcome of a case: its message, and of the words what does not stand there yet.
fn outcome_of(kind: &'static str, message: String, words: &str) -> Element {
    let rest = words.strip_prefix(&*message).unwrap_or(words).trim_start_matches('\n');
    Element::with_text(kind, rest).set("message", message)
}

/// Returns what verifying found as JSON: whether something was compared in every file and nothing differs,
/// and file by file why it could not be verified, the scene that was run, and its runs as [`VerifiedRun`] has
/// them; and [`report()`].
pub fn json(checked: &[VerifiedFile]) -> String {
    let run = |run: &VerifiedRun| {
        json!({
            "run": run.name,
            "same": run.is_same(),
            "presence": run.presence,
            "compared": run.compared,
            "path": run.path,
            "changes": run.changes,
            "first": run.first,
            "differences": run.differences,
        })
    };
    let file = |checked: &VerifiedFile| {
        let why = checked.verified.as_ref().err().map(Failure::from);
        let mut file = json!({ "file": checked.file, "same": checked.is_same(), "failure": why });
        if let Ok(Verified { input, .. }) = &checked.verified {
            file["units"] = json!(input.scene.units);
            file["scene_sha256"] = json!(input.scene_sha256);
            file["mesh_sha256"] = json!(input.mesh_sha256);
        }
        file["runs"] = checked.runs().iter().map(run).collect();
        file
    };
    let same = checked.iter().all(VerifiedFile::is_same);
    let files: Vec<Value> = checked.iter().map(file).collect();
    let text = report(checked, true).text(COLUMNS);
    json::line(None, &json!({ "same": same, "files": files, "text": text }))
}
