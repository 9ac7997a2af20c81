//! A snapshot verified: every run of it is run again and compared.

use rayon::prelude::*;

use super::compare::{Difference, compare};
use super::explain::{Explanation, Side, explain};
use super::record::{Bounds, record};
use super::{Input, Run, Snapshot, VERSION};
use crate::answer::error::Result;
use crate::error::InputError;
use crate::problem::scene::Scene;

/// What came of verifying a snapshot.
#[derive(Clone, Debug)]
pub struct Verified {
    /// The input that was run.
    pub input: Input,
    /// The runs, in the order of the snapshot.
    pub runs: Vec<VerifiedRun>,
}

/// What came of a run.
#[derive(Clone, Debug)]
pub struct VerifiedRun {
    /// The name of the run.
    pub name: String,
    /// The run as it is now.
    pub run: Run,
    /// What differs, in the order of computation.
    pub differences: Vec<Difference>,
    /// How many facts and numbers were compared.
    pub compared: usize,
    /// Why it differs; None where it does not.
    pub explanation: Option<Explanation>,
}

impl Verified {
    /// Returns whether anything was compared and nothing differs.
    pub fn is_same(&self) -> bool {
        self.runs.iter().all(|run| run.differences.is_empty() && run.compared > 0)
            && !self.runs.is_empty()
    }
}

/// Runs the scene of `snapshot`, or `scene` in its place, under the options of every run, and
/// compares. `done` is called after each run.
///
/// # Errors
/// The snapshot or the scene is at fault.
pub fn verify(
    snapshot: &Snapshot,
    scene: Option<&Scene>,
    done: &(dyn Fn() + Sync),
) -> Result<Verified> {
    let own = snapshot.input.build().map_err(|error| error.within("the snapshot"));
    let (scene, input) = match scene {
        None => (own?, snapshot.input.clone()),
        Some(scene) => (scene.clone(), Input::of(scene)?),
    };
    let runs: Vec<(&str, &Run)> = snapshot.runs.iter().collect();
    let verified = runs.par_iter().map(|(name, old)| {
        let place = || format!("run {name:?} of the snapshot");
        old.expected
            .iter()
            .try_for_each(|e| e.check())
            .map_err(|e: InputError| e.within(&place()))?;
        let verified = verify_run(snapshot, &scene, &input, name, old);
        done();
        verified
    });
    Ok(Verified { runs: verified.collect::<Result<_>>()?, input: input.clone() })
}

fn verify_run(
    snapshot: &Snapshot,
    scene: &Scene,
    input: &Input,
    name: &str,
    old: &Run,
) -> Result<VerifiedRun> {
    let request = old.options.request(scene);
    // Equal bits need no bounds, which take another run.
    let run = record(&request, Bounds::LeftOut)?;
    let (differences, compared) = compare(old, &run);
    let is_same = differences.is_empty()
        && old
            .numbers
            .iter()
            .all(|(name, was)| run.numbers.get(name).is_some_and(|is| is.values == was.values));
    if is_same {
        let (name, explanation) = (name.into(), None);
        return Ok(VerifiedRun { name, run, differences, compared, explanation });
    }
    let run = record(&request, Bounds::Computed)?;
    let (differences, compared) = compare(old, &run);
    let explanation = (!differences.is_empty())
        .then(|| {
            let was = Side { version: &snapshot.version, input: &snapshot.input, run: old };
            let is = Side { version: VERSION, input, run: &run };
            explain(was, is, &differences)
        })
        .flatten();
    Ok(VerifiedRun { name: name.into(), run, differences, compared, explanation })
}

/// Compares two snapshots, the runs of the same name with each other; where each has one run, these.
pub fn difference(old: &Snapshot, new: &Snapshot) -> Verified {
    let single = old.runs.len() == 1 && new.runs.len() == 1;
    let mut runs = Vec::new();
    for (name, was) in old.runs.iter() {
        let other = new.runs.iter().find(|(other, _)| single || *other == name);
        let absent = Run::new(was.options.clone());
        let (other, is) = other.unwrap_or(("nothing", &absent));
        let (differences, compared) = compare(was, is);
        let sides = [
            Side { version: &old.version, input: &old.input, run: was },
            Side { version: &new.version, input: &new.input, run: is },
        ];
        let explanation = explain(sides[0], sides[1], &differences);
        let name = if name == other { name.into() } else { format!("{name} and {other}") };
        runs.push(VerifiedRun { name, run: is.clone(), differences, compared, explanation });
    }
    let added = new.runs.iter().filter(|(name, _)| !single && old.runs.get(name).is_none());
    for (name, is) in added {
        let absent = Run::new(is.options.clone());
        let (differences, compared) = compare(&absent, is);
        let name = format!("nothing and {name}");
        runs.push(VerifiedRun { name, run: is.clone(), differences, compared, explanation: None });
    }
    Verified { input: new.input.clone(), runs }
}
