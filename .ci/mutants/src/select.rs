//! Which mutants are graded: all, those of some files, those on changed lines, or a random sample.

use std::path::PathBuf;
use std::process::Command;

use crate::Failure;
use crate::mutant::{Mutant, State};

/// The seconds of tests a mutant, where none are asked for.
const BUDGET: f64 = 30.0;

pub struct Options {
    pub jobs: usize,
    /// How long the tests of a mutant may take by themselves, in seconds.
    pub budget: f64,
    only: Vec<String>,
    changed: Option<Vec<(String, usize, usize)>>,
    sample: Option<(usize, u64)>,
}

impl Options {
    pub fn read(options: &[String]) -> Result<Self, Failure> {
        let mut read =
            Options { jobs: 1, budget: BUDGET, only: vec![], changed: None, sample: None };
        let mut rest = options.iter();
        while let Some(option) = rest.next() {
            let mut value = || rest.next().ok_or(format!("{option}: a value is missing"));
            match option.as_str() {
                "--jobs" => read.jobs = value()?.parse()?,
                "--budget" => read.budget = value()?.parse()?,
                "--only" => read.only.push(value()?.clone()),
                "--changed-since" => read.changed = Some(changed(value()?)?),
                "--sample" => read.sample = Some((value()?.parse()?, value()?.parse()?)),
                _ => return Err(format!("{option}: unknown").into()),
            }
        }
        Ok(read)
    }

    /// Returns the mutants of the build that are to be graded.
    pub fn select<'a>(&self, mutants: &'a [Mutant]) -> Vec<&'a Mutant> {
        let is_chosen = |mutant: &&Mutant| {
            mutant.state == State::Built
                && (self.only.is_empty() || self.only.iter().any(|part| mutant.file.contains(part)))
                && self
                    .changed
                    .as_ref()
                    .is_none_or(|lines| lines.iter().any(|l| touches(mutant, l)))
        };
        let mut chosen: Vec<&Mutant> = mutants.iter().filter(is_chosen).collect();
        if let Some((count, seed)) = self.sample {
            shuffle(&mut chosen, seed);
            chosen.truncate(count);
        }
        chosen
    }
}

fn touches(mutant: &Mutant, (file, first, last): &(String, usize, usize)) -> bool {
    let span =
        if mutant.genre == "FnValue" { mutant.function.as_ref().map(|f| f.span) } else { None };
    let span = span.unwrap_or(mutant.span);
    mutant.file == *file && span.start.line <= *last && span.end.line >= *first
}

/// Returns the lines that changed since a commit: file, first and last line.
fn changed(since: &str) -> Result<Vec<(String, usize, usize)>, Failure> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let arguments = ["diff", "-U0", "--no-color", "--relative", since, "--", "src"];
    let output = Command::new("git").args(arguments).current_dir(root).output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
    }
    let mut file = String::new();
    let mut lines = Vec::new();
    for line in String::from_utf8(output.stdout)?.lines() {
        if let Some(name) = line.strip_prefix("+++ b/") {
            file = name.to_owned();
        } else if let Some(place) = line.strip_prefix("@@ ").and_then(|l| l.split('+').nth(1)) {
            let place = place.split(' ').next().unwrap_or_default();
            let (first, count) = place.split_once(',').unwrap_or((place, "1"));
            let (first, count): (usize, usize) = (first.parse()?, count.parse()?);
            lines.push((file.clone(), first, (first + count).saturating_sub(1)));
        }
    }
    Ok(lines)
}

/// Shuffles by a linear congruential generator (Knuth's MMIX), the same way for the same seed.
fn shuffle<T>(items: &mut [T], seed: u64) {
    let mut state = seed;
    for last in (1..items.len()).rev() {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        items.swap(last, (state >> 33) as usize % (last + 1));
    }
}
