//! Snapshots as files, and what verifying them found: for people, as JSON, Markdown and JUnit XML.

mod field;
mod words;

use schemars::JsonSchema;
use serde::Serialize;

pub use field::difference_files;
pub use words::{difference, explanation};

use super::failure::Failure;
use super::json::{headed, pretty};
use base::xml::Element;
use engine::error::Error;
use problem::scene::Units;
use studies::snapshot::{
    Acceptance, Difference, Explanation, Presence, Run, Snapshot, Verified, VerifiedRun,
};

/// A snapshot's file and what verifying it found, or why it could not be verified.
pub struct Checked {
    /// The name of the file, as given.
    pub file: String,
    pub verified: Result<Verified, Error>,
}

impl Checked {
    /// Returns whether something was compared and nothing differs.
    pub fn is_same(&self) -> bool {
        self.verified.as_ref().is_ok_and(Verified::is_same)
    }

    fn runs(&self) -> &[VerifiedRun] {
        self.verified.as_ref().map_or(&[], |verified| &verified.runs)
    }
}

/// Returns the text of a snapshot's file.
pub fn file(snapshot: &Snapshot) -> String {
    pretty(snapshot)
}

/// Returns what was recorded, for people.
pub fn recorded(snapshot: &Snapshot) -> String {
    let run = |(name, run): (&String, &Run)| {
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
        _ if run.presence != Presence::Both => words::presence(run.presence).into(),
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

/// Returns what verifying found, for people.
pub fn text(checked: &[Checked]) -> String {
    checked.iter().map(of_file).collect()
}

fn of_file(checked: &Checked) -> String {
    let verified = match &checked.verified {
        Ok(verified) => verified,
        Err(_) => return format!("{}: error, it cannot be verified\n", checked.file),
    };
    let mut text = format!("{}: {}\n", checked.file, of_runs(verified));
    for run in &verified.runs {
        text += &format!("  {}: {}\n", run.name, verdict(run));
        text += &indent(&run_words(run), "    ");
    }
    text
}

fn of_runs(verified: &Verified) -> String {
    let differ = verified.runs.iter().filter(|run| !run.is_same()).count();
    match (verified.runs.len(), differ) {
        (0, _) => "no run in it, nothing was compared".into(),
        (runs, 0) => format!("same, {runs} {}", if runs == 1 { "run" } else { "runs" }),
        (runs, _) => format!("{differ} of {runs} runs differ"),
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
    let mut text = String::from(
        "# plane-contact snapshot verify\n\n| snapshot | run | verdict |\n|---|---|---|\n",
    );
    let row = |file: &str, run: &str, verdict: &str| {
        format!("| {} | {} | {} |\n", escaped(file), escaped(run), escaped(verdict))
    };
    for Checked { file, verified } in checked {
        match verified {
            Err(_) => text += &row(file, "-", "error"),
            Ok(verified) if verified.runs.is_empty() => text += &row(file, "-", &of_runs(verified)),
            Ok(verified) => {
                text.extend(verified.runs.iter().map(|run| row(file, &run.name, &verdict(run))));
            }
        }
    }
    for checked in checked {
        let file = escaped(&checked.file);
        if let Err(why) = &checked.verified {
            text += &format!("\n## {file}\n\n{}", block(&format!("error: {why}\n")));
        }
        for run in checked.runs().iter().filter(|run| !run.differences.is_empty()) {
            text += &format!("\n## {file}: {}\n\n{}", escaped(&run.name), block(&run_words(run)));
        }
    }
    text
}

/// Returns a text that stands in a line of Markdown or a cell of a table as it is.
fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '&' => "&amp;".into(),
        '<' => "&lt;".into(),
        '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '~' | '#' | '$' => format!("\\{c}"),
        c if c.is_control() => " ".into(),
        c => c.to_string(),
    };
    text.chars().map(escape).collect()
}

/// Returns lines as a block of Markdown, whose fence is longer than any in them.
fn block(lines: &str) -> String {
    let runs = lines.split(|c| c != '`').map(str::len);
    let fence = "`".repeat(runs.max().unwrap_or(0).max(2) + 1);
    format!("{fence}text\n{lines}{fence}\n")
}

/// Returns what verifying found as JUnit XML: a suite a file, a case a run.
pub fn junit(checked: &[Checked]) -> String {
    Element::new("testsuites").with_all(checked.iter().map(suite)).document()
}

fn suite(checked: &Checked) -> Element {
    let runs = checked.runs();
    let alone = match &checked.verified {
        Err(why) => {
            Some(Element::with_text("error", &why.to_string()).set("message", first_line(why)))
        }
        Ok(_) if runs.is_empty() => Some(Element::with_text("failure", "nothing was compared")),
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
}

fn case(run: &VerifiedRun) -> Element {
    let case = test_case(&run.name);
    if run.is_same() {
        return case;
    }
    let failure = Element::with_text("failure", &run_words(run));
    case.with(failure.set("message", words::headline(run)))
}

fn test_case(name: &str) -> Element {
    Element::new("testcase").set("name", name).set("classname", "snapshot")
}

fn first_line(why: &Error) -> String {
    why.to_string().lines().next().unwrap_or_default().into()
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
    /// Why it could not be verified; null where it was.
    failure: Option<Failure>,
    #[serde(flatten)]
    scene: Option<SceneRow<'a>>,
    runs: Vec<RunRow<'a>>,
}

/// The scene that was run.
#[derive(Serialize, JsonSchema)]
struct SceneRow<'a> {
    /// The names of its units.
    units: Units,
    /// Its SHA-256.
    scene_sha256: &'a str,
    /// The SHA-256 of its mesh.
    mesh_sha256: &'a str,
}

/// What verifying a run found.
#[derive(Serialize, JsonSchema)]
struct RunRow<'a> {
    run: &'a str,
    same: bool,
    /// The side that has it; what one side alone has is not compared.
    presence: Presence,
    /// How many facts and numbers were compared.
    compared: usize,
    /// The iteration from which on rounding decides the path to the equilibrium, which is not compared
    /// from there on; null where the runs take the same path.
    path: Option<usize>,
    /// Why it differs; null where it does not.
    explanation: &'a Option<Explanation>,
    /// What differs, in the order of computation.
    differences: &'a [Difference],
}

impl<'a> From<&'a VerifiedRun> for RunRow<'a> {
    fn from(run: &'a VerifiedRun) -> Self {
        RunRow {
            run: &run.name,
            same: run.is_same(),
            presence: run.presence,
            compared: run.compared,
            path: run.path,
            explanation: &run.explanation,
            differences: &run.differences,
        }
    }
}

impl<'a> From<&'a Checked> for FileRow<'a> {
    fn from(checked: &'a Checked) -> Self {
        let scene = checked.verified.as_ref().ok().map(|Verified { input, .. }| SceneRow {
            units: input.units(),
            scene_sha256: &input.scene_sha256,
            mesh_sha256: &input.mesh_sha256,
        });
        FileRow {
            file: &checked.file,
            same: checked.is_same(),
            failure: checked.verified.as_ref().err().map(Failure::from),
            scene,
            runs: checked.runs().iter().map(RunRow::from).collect(),
        }
    }
}

/// Returns what verifying found as JSON.
pub fn json(checked: &[Checked]) -> String {
    let same = checked.iter().all(Checked::is_same);
    headed(&Document { same, files: checked.iter().map(FileRow::from).collect() })
}

/// The most lines of what was accepted.
const LINES: usize = 20;

/// Returns what was accepted, for people: a line for each entry, one for all iterations of a run.
pub fn accepted(accepted: &[Acceptance]) -> String {
    let mut lines: Vec<(String, usize)> = Vec::new();
    for acceptance in accepted {
        match in_iteration(&acceptance.entry) {
            None => lines.push((line(acceptance), 1)),
            Some(run) => {
                let start = format!("accepted {run}/iteration ");
                match lines.last_mut().filter(|(line, _)| line.starts_with(&start)) {
                    Some((_, count)) => *count += 1,
                    None => lines.push((line(acceptance), 1)),
                }
            }
        }
    }
    let entries = |lines: &[(String, usize)]| lines.iter().map(|(_, count)| count).sum::<usize>();
    let shown = if lines.len() > LINES { LINES - 1 } else { lines.len() };
    let mut text: String = lines[..shown]
        .iter()
        .map(|(line, count)| match count {
            1 => format!("{line}\n"),
            count => format!("{line}; and {} other entries of iterations\n", count - 1),
        })
        .collect();
    if shown < lines.len() {
        text += &format!("and {} other entries, see the log\n", entries(&lines[shown..]));
    }
    text
}

/// Returns the run of an entry that is one of an iteration.
fn in_iteration(entry: &str) -> Option<&str> {
    entry.split_once("/iteration ").map(|(run, _)| run)
}

fn line(a: &Acceptance) -> String {
    let by = match (a.bounds, a.differing) {
        (Some(bounds), Some(count)) => format!(" ({bounds:.3e} x tolerance; {count} numbers)"),
        (None, Some(count)) => format!(" ({count} numbers)"),
        _ => String::new(),
    };
    format!("accepted {}: {}, was {}{by}", a.entry, words::short(&a.to), words::short(&a.from))
}
