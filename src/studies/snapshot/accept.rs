//! New values accepted into a snapshot, each with its reason.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::compare::{Difference, Kind};
use super::verify::Verified;
use super::{Snapshot, VERSION};
use crate::error::{InputError, Result};

/// A value that was accepted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Acceptance {
    /// The run and the entry: `stepped/u`, or `input`.
    pub entry: String,
    /// What it was; of numbers the one that changed most, in units of what it may.
    pub from: Value,
    /// What it is.
    pub to: Value,
    /// By how much, in units of the bound on rounding errors or the tolerance; null of facts.
    pub bounds: Option<f64>,
    /// How many numbers of the entry changed by more than that; null of facts.
    pub differing: Option<usize>,
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
        return Err(InputError::new("--reason", "the reason is empty", fix));
    }
    let mut accepted = Vec::new();
    let input_changed = snapshot.input != verified.input;
    let all = chosen.entry.is_none();
    for new in &verified.runs {
        let Some(old) = snapshot.runs.get_mut(&new.name) else { continue };
        let takes = |difference: &Difference| {
            let entry = format!("{}/{}", new.name, difference.entry);
            chosen.entry.is_none_or(|chosen| chosen == new.name || chosen == entry)
        };
        let taken: Vec<&Difference> = new.differences.iter().filter(|d| takes(d)).collect();
        let fails = taken.iter().any(|d| d.entry == "exit status")
            && new.run.exit_status().is_some_and(|status| status != 0);
        if fails && !chosen.failing {
            let failure = new.run.facts.get("failure").cloned().unwrap_or_default();
            let what = format!("run {:?} fails now: {failure}", new.name);
            let fix = "nothing was accepted; where the failure is expected, say so with --failing";
            return Err(InputError::new("exit status", what, fix));
        }
        for difference in &taken {
            if let Kind::Expected { .. } = difference.kind {
                let what =
                    format!("the run misses a number that is expected of {}", difference.entry);
                let fix = "change or remove the number under `expected`, with its reason";
                return Err(InputError::new(format!("run {:?}", new.name), what, fix));
            }
            accepted.push(acceptance(&new.name, difference, chosen.reason));
            let entry = &difference.entry;
            match new.run.facts.get(entry) {
                Some(fact) => old.facts.set(entry, fact.clone()),
                None => old.facts.remove(entry),
            }
            match new.run.numbers.get(entry) {
                Some(numbers) => {
                    let tolerance = old.numbers.get(entry).and_then(|numbers| numbers.tolerance);
                    let numbers = super::Numbers { tolerance, ..numbers.clone() };
                    old.numbers.set(entry, numbers);
                }
                None => old.numbers.remove(entry),
            }
        }
        if taken.len() == new.differences.len() {
            // Numbers that agree take their new bits with them: the run is whole again.
            let given: Vec<_> =
                old.numbers.iter().map(|(n, x)| (n.to_string(), x.tolerance)).collect();
            old.facts = new.run.facts.clone();
            old.numbers = new.run.numbers.clone();
            old.decided_by_rounding = new.run.decided_by_rounding.clone();
            for (name, tolerance) in given {
                if let Some(numbers) = old.numbers.get_mut(&name) {
                    numbers.tolerance = tolerance;
                }
            }
        }
    }
    if accepted.is_empty() && !input_changed {
        let what = "nothing differs in what is to be accepted";
        let fix = "see `plane-contact verify`; an entry is named run/entry, such as stepped/u";
        return Err(InputError::new("--entry", what, fix));
    }
    if input_changed {
        if !all {
            let what = "another scene is accepted with all that it gives";
            return Err(InputError::new("--entry", what, "leave it out"));
        }
        accepted.insert(
            0,
            Acceptance {
                entry: "input".into(),
                from: json!([snapshot.input.scene_sha256, snapshot.input.mesh_sha256]),
                to: json!([verified.input.scene_sha256, verified.input.mesh_sha256]),
                bounds: None,
                differing: None,
                reason: chosen.reason.into(),
                version: VERSION.into(),
            },
        );
        snapshot.input = verified.input.clone();
    }
    if all {
        snapshot.version = VERSION.into();
    }
    snapshot.log.extend(accepted.iter().cloned());
    Ok(accepted)
}

fn acceptance(run: &str, difference: &Difference, reason: &str) -> Acceptance {
    let (from, to, bounds, differing) = match &difference.kind {
        Kind::Missing => (json!("there"), json!("missing"), None, None),
        Kind::Extra => (json!("missing"), json!("there"), None, None),
        Kind::Fact { was, is } => (was.clone(), is.clone(), None, None),
        Kind::Shape { was, is, .. } => {
            (json!(format!("{was} numbers")), json!(format!("{is} numbers")), None, None)
        }
        Kind::Numbers(worst) => {
            let by = (worst.is - worst.was).abs() / worst.limit;
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
