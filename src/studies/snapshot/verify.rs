//! A snapshot verified: every run of it is run again and compared.

use rayon::prelude::*;

use super::compare::{Difference, compare};
use super::explain::{Explanation, Side, explain};
use super::record::{Bounds, record};
use super::way::{decided_by_rounding, without_way};
use super::{Input, Numbers, Run, Snapshot, VERSION};
use base::choices;
use engine::error::Result;
use problem::scene::Scene;

/// What came of verifying a snapshot.
#[derive(Clone, Debug)]
pub struct Verified {
    /// The input that was run.
    pub input: Input,
    /// The runs, in the order of the snapshot.
    pub runs: Vec<VerifiedRun>,
}

choices! {
    /// Where a run is.
    Presence {
        /// On both sides.
        Both = "both",
        /// On the old side alone.
        Missing = "missing",
        /// On the new side alone.
        New = "new",
    }
}

/// What came of a run.
#[derive(Clone, Debug)]
pub struct VerifiedRun {
    /// The name of the run.
    pub name: String,
    /// The side that has it; what one side alone has is not compared.
    pub presence: Presence,
    /// The run as it is now.
    pub run: Run,
    /// What differs, in the order of computation.
    pub differences: Vec<Difference>,
    /// How many facts and numbers were compared.
    pub compared: usize,
    /// The iteration from which on rounding decides the way to the equilibrium, which the two runs
    /// reach by different ones; these are not compared from there on.
    pub way: Option<usize>,
    /// Why it differs; None where it does not.
    pub explanation: Option<Explanation>,
}

impl Verified {
    /// Returns whether anything was compared and nothing differs.
    pub fn is_same(&self) -> bool {
        self.runs.iter().all(VerifiedRun::is_same) && !self.runs.is_empty()
    }
}

impl VerifiedRun {
    /// Returns whether anything was compared and nothing differs.
    pub fn is_same(&self) -> bool {
        self.differences.is_empty() && self.compared > 0
    }

    fn same(name: &str, run: Run, compared: usize, way: Option<usize>) -> Self {
        let (name, presence, differences) = (name.into(), Presence::Both, Vec::new());
        VerifiedRun { name, presence, run, differences, compared, way, explanation: None }
    }

    fn compared(name: String, old: Side, new: Side) -> Self {
        let (differences, compared) = compare(old.run, new.run);
        let explanation = explain(old, new, &differences);
        let (presence, run) = (Presence::Both, new.run.clone());
        VerifiedRun { name, presence, run, differences, compared, way: None, explanation }
    }

    fn alone(name: &str, presence: Presence, run: &Run) -> Self {
        let (name, run) = (name.into(), run.clone());
        let (differences, compared, explanation) = (Vec::new(), 0, None);
        VerifiedRun { name, presence, run, differences, compared, way: None, explanation }
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
    let runs: Vec<(&String, &Run)> = snapshot.runs.iter().collect();
    let verified = runs.par_iter().map(|(name, old)| {
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
    let again = |bounds: Bounds| -> Result<Run> {
        let mut run = record(&request, bounds)?;
        run.keep_only(old.only.clone());
        Ok(run)
    };
    // Equal bits need no bounds, which take another run.
    let run = again(Bounds::LeftOut)?;
    let (differences, compared) = compare(old, &run);
    let has_bits = |(name, was): (&String, &Numbers)| {
        run.numbers.get(name).is_some_and(|is| is.values == was.values)
    };
    if differences.is_empty() && old.numbers.iter().all(has_bits) {
        return Ok(VerifiedRun::same(name, run, compared, None));
    }
    let run = again(Bounds::Computed)?;
    let (differences, _) = compare(old, &run);
    if let Some(first) = decided_by_rounding(input, &run, &differences)? {
        let (_, compared) = compare(&without_way(old, first), &without_way(&run, first));
        return Ok(VerifiedRun::same(name, run, compared, Some(first)));
    }
    let was = Side { version: &snapshot.version, input: &snapshot.input, run: old };
    Ok(VerifiedRun::compared(name.into(), was, Side { version: VERSION, input, run: &run }))
}

/// Compares two snapshots, the runs of the same name with each other; where each has one run, these.
pub fn difference(old: &Snapshot, new: &Snapshot) -> Verified {
    let single = old.runs.len() == 1 && new.runs.len() == 1;
    let compared = old.runs.iter().map(|(name, was)| {
        let other = if single { new.runs.first() } else { new.runs.get_key_value(name) };
        let Some((other, is)) = other else {
            return VerifiedRun::alone(name, Presence::Missing, was);
        };
        let name = if name == other { name.clone() } else { format!("{name} and {other}") };
        let was = Side { version: &old.version, input: &old.input, run: was };
        let is = Side { version: &new.version, input: &new.input, run: is };
        VerifiedRun::compared(name, was, is)
    });
    let added = new.runs.iter().filter(|(name, _)| !single && !old.runs.contains_key(*name));
    let added = added.map(|(name, is)| VerifiedRun::alone(name, Presence::New, is));
    Verified { input: new.input.clone(), runs: compared.chain(added).collect() }
}
