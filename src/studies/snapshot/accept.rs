//! New values accepted into a snapshot, each with its reason.

use std::collections::HashSet;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::compare::{Difference, Kind};
use super::verify::{Verified, VerifiedRun};
use super::{Numbers, Run, Snapshot, VERSION};
use base::error::{InputError, Result};
use base::suggestion::did_you_mean;

/// A value that was accepted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Acceptance {
    /// The run and the entry: `stepped/u`, or `input`.
    pub entry: String,
    /// What it was; of numbers the one that changed most, in multiples of its tolerance.
    pub from: Value,
    /// What it is.
    pub to: Value,
    /// By how much, in units of the bound on rounding errors or the tolerance; null of facts.
    pub bounds: Option<f64>,
    /// How many numbers of the entry changed by more than that; null of facts.
    pub differing: Option<usize>,
    /// Why it was accepted.
    pub reason: String,
    /// The version of the program that gave the new value.
    pub version: String,
}

/// Which differences are accepted.
#[derive(Clone, Copy, Debug)]
pub struct Chosen<'a> {
    /// A run, or a run and an entry: `stepped`, `stepped/u`; None for all.
    pub entry: Option<&'a str>,
    /// Why.
    pub reason: &'a str,
    /// Whether a run that fails may take the place of one that did not, or failed otherwise.
    pub failing: bool,
}

/// Takes the new values of `verified` into `snapshot`, and returns what was accepted.
///
/// # Errors
/// The reason is empty; nothing differs, or nothing of what was chosen; a run fails that did not, and
/// that is not asked for.
pub fn accept(
    snapshot: &mut Snapshot,
    verified: &Verified,
    chosen: Chosen,
) -> Result<Vec<Acceptance>> {
    if chosen.reason.trim().is_empty() {
        let fix = "say why the new value is right";
        return Err(InputError::new("reason", "the reason is empty", fix));
    }
    chosen.entry.map_or(Ok(()), |entry| check_entry(entry, snapshot, verified))?;
    let [was, is] = [&snapshot.input, &verified.input]
        .map(|input| [input.scene_sha256.clone(), input.mesh_sha256.clone()]);
    let mut accepted = Vec::new();
    if was != is {
        if chosen.entry.is_some() {
            let what = "another scene is accepted with all that it gives";
            return Err(InputError::new("entry", what, "leave it out"));
        }
        let (entry, from, to) = ("input".into(), json!(was), json!(is));
        let (reason, version) = (chosen.reason.into(), VERSION.into());
        let (bounds, differing) = (None, None);
        accepted.push(Acceptance { entry, from, to, bounds, differing, reason, version });
    }
    for new in &verified.runs {
        let Some(old) = snapshot.runs.get_mut(&new.name) else { continue };
        let taken: Vec<&Difference> =
            new.differences.iter().filter(|d| chosen.takes(&new.name, d)).collect();
        check_run(new, &taken, chosen.failing)?;
        accepted.extend(taken.iter().map(|d| acceptance(&new.name, d, chosen.reason)));
        let all = taken.len() == new.differences.len();
        take(old, &new.run, (!all).then_some(&taken));
    }
    if accepted.is_empty() {
        let what = "nothing differs in what is to be accepted";
        let fix =
            "see `plane-contact snapshot verify`; an entry is named run/entry, such as stepped/u";
        return Err(InputError::new("entry", what, fix));
    }
    snapshot.input = verified.input.clone();
    if chosen.entry.is_none() {
        snapshot.version = VERSION.into();
    }
    snapshot.log.extend(accepted.iter().cloned());
    Ok(accepted)
}

impl Chosen<'_> {
    /// Returns whether a difference of a run is accepted.
    fn takes(&self, run: &str, difference: &Difference) -> bool {
        let is_of_run = |chosen: &str| match chosen.strip_prefix(run) {
            Some("") => true,
            Some(rest) => rest.strip_prefix('/') == Some(&difference.entry),
            None => false,
        };
        self.entry.is_none_or(is_of_run)
    }
}

/// Checks that `entry` names a run, or a run and an entry of it.
///
/// # Errors
/// It names neither.
fn check_entry(entry: &str, snapshot: &Snapshot, verified: &Verified) -> Result<()> {
    let runs = snapshot.runs.iter().chain(verified.runs.iter().map(|run| (&run.name, &run.run)));
    let names = runs.flat_map(|(name, run)| {
        let entries = run.facts.keys().chain(run.numbers.keys());
        std::iter::once(name.clone()).chain(entries.map(move |entry| format!("{name}/{entry}")))
    });
    let names: Vec<String> = names.collect();
    if names.iter().any(|name| name == entry) {
        return Ok(());
    }
    let fix = did_you_mean(entry, names.iter().map(String::as_str))
        + "name a run, or run/entry, such as stepped/u";
    Err(InputError::new("entry", format!("no run or entry is named {entry:?}"), fix))
}

/// Checks that the differences `taken` of a run may be accepted.
///
/// # Errors
/// The run fails that did not, unless `failing` says that it may; it misses a number that is expected.
fn check_run(new: &VerifiedRun, taken: &[&Difference], failing: bool) -> Result<()> {
    let fails = taken.iter().any(|d| d.entry == "exit status")
        && new.run.exit_status().is_some_and(|status| status != 0);
    if fails && !failing {
        let failure = new.run.facts.get("failure").cloned().unwrap_or_default();
        let what = format!("run {:?} fails now: {failure}", new.name);
        let fix = "nothing was accepted; where the failure is expected, ask for `failing`";
        return Err(InputError::new("exit status", what, fix));
    }
    if let Some(missed) = taken.iter().find(|d| matches!(d.kind, Kind::Expected { .. })) {
        let what = format!("the run misses a number that is expected of {}", missed.entry);
        let fix = "change or remove the number under `expected`, with its reason";
        return Err(InputError::new(format!("run {:?}", new.name), what, fix));
    }
    Ok(())
}

/// Takes the entries of `some` differences from `new`, with None all of it: numbers that agree take
/// their new bits with them, and the run is whole again. Tolerances stay.
fn take(old: &mut Run, new: &Run, some: Option<&Vec<&Difference>>) {
    let chosen = some.map(|some| some.iter().map(|d| &d.entry[..]).collect::<HashSet<_>>());
    let is_taken = |name: &str| chosen.as_ref().is_none_or(|chosen| chosen.contains(name));
    old.facts.retain(|name, _| !is_taken(name) || new.facts.get(name).is_some());
    for (name, fact) in new.facts.iter().filter(|(name, _)| is_taken(name)) {
        old.facts.insert(name.clone(), fact.clone());
    }
    old.numbers.retain(|name, _| !is_taken(name) || new.numbers.get(name).is_some());
    for (name, numbers) in new.numbers.iter().filter(|(name, _)| is_taken(name)) {
        let tolerance = old.numbers.get(name).and_then(|numbers| numbers.tolerance);
        old.numbers.insert(name.clone(), Numbers { tolerance, ..numbers.clone() });
    }
    if chosen.is_none() {
        old.decided_by_rounding = new.decided_by_rounding.clone();
    }
    old.sort();
}

fn acceptance(run: &str, difference: &Difference, reason: &str) -> Acceptance {
    let (from, to, bounds, differing) = match &difference.kind {
        Kind::Missing => (json!("present"), json!("missing"), None, None),
        Kind::Extra => (json!("missing"), json!("present"), None, None),
        Kind::Fact { was, is } => (was.clone(), is.clone(), None, None),
        Kind::Unit { was, is } => (json!(was), json!(is), None, None),
        Kind::Shape { was, is, .. } => {
            (json!(format!("{was} numbers")), json!(format!("{is} numbers")), None, None)
        }
        Kind::Numbers(worst) => {
            let by = (worst.is.0 - worst.was.0).abs() / worst.limit.0;
            let by = Some(by).filter(|by| by.is_finite());
            (json!(worst.was), json!(worst.is), by, Some(worst.differing))
        }
        Kind::Expected { was, is, .. } => (json!(was), json!(is), None, None),
    };
    Acceptance {
        entry: format!("{run}/{}", difference.entry),
        from,
        to,
        bounds,
        differing,
        reason: reason.into(),
        version: VERSION.into(),
    }
}
