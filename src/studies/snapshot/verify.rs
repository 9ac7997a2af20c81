//! A snapshot verified: every run of it is run again and compared, or takes the place of what was recorded.

use rayon::prelude::*;

use super::changes::{Change, changes};
use super::compare::{Difference, compare};
use super::first::{First, first};
use super::record::{Bounds, record};
use super::{Entry, Quantity};
use super::{Input, Numbers, Run, Snapshot, VERSION};
use base::choices;
use engine::Request;
use engine::error::Result;
use engine::estimates::perturbed_requests;
use problem::modelling::Variant;
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
    /// The iteration from which on rounding decides the path to the equilibrium, such as which of two
    /// nodes closes first. The two runs take different paths, which are not compared from there on.
    pub path: Option<usize>,
    /// What went in and differs.
    pub changes: Vec<Change>,
    /// Where it first differs; None where it does not.
    pub first: Option<First>,
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

    /// Makes a run that is not compared.
    fn new(name: impl Into<String>, presence: Presence, run: Run) -> Self {
        let (name, differences, changes) = (name.into(), Vec::new(), Vec::new());
        let (compared, path, first) = (0, None, None);
        VerifiedRun { name, presence, run, differences, compared, path, changes, first }
    }

    /// Compares two runs, each given with its snapshot's version and input.
    fn compared(name: String, old: (&str, &Input, &Run), new: (&str, &Input, &Run)) -> Self {
        let (differences, compared) = compare(old.2, new.2);
        let changes = changes(old, new);
        let first = first(old.2, new.2, &differences);
        let run = VerifiedRun::new(name, Presence::Both, new.2.clone());
        VerifiedRun { differences, compared, changes, first, ..run }
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
    let (scene, input) = given_or_own(snapshot, scene)?;
    let runs: Vec<(&String, &Run)> = snapshot.runs.iter().collect();
    let verified = runs.par_iter().map(|(name, old)| {
        let verified = verify_run(snapshot, &scene, &input, name, old);
        done();
        verified
    });
    Ok(Verified { runs: verified.collect::<Result<_>>()?, input: input.clone() })
}

/// Records the runs of `snapshot` again, on its own scene or on `scene` in its place. What is recorded
/// of each, and the tolerances that it gives, stay.
///
/// # Errors
/// The snapshot or the scene is at fault.
pub fn accept(snapshot: &Snapshot, scene: Option<&Scene>) -> Result<Snapshot> {
    let (scene, input) = given_or_own(snapshot, scene)?;
    let runs: Vec<(&String, &Run)> = snapshot.runs.iter().collect();
    let again = runs.par_iter().map(|(name, old)| {
        let mut run = record(&old.options.request(&scene)?, Bounds::Computed)?;
        run.keep_only(old.only.clone());
        for (entry, numbers) in &mut run.numbers {
            numbers.tolerance = old.numbers.get(entry).and_then(|numbers| numbers.tolerance);
        }
        Ok(((*name).clone(), run))
    });
    let runs = again.collect::<Result<Vec<_>>>()?.into_iter().collect();
    Ok(Snapshot::of_runs(input, snapshot.scene_file.clone(), runs))
}

/// Returns `scene`, or that of the snapshot, with what a snapshot of it has.
fn given_or_own(snapshot: &Snapshot, scene: Option<&Scene>) -> Result<(Scene, Input)> {
    Ok(match scene {
        None => (snapshot.scene()?, snapshot.input.clone()),
        Some(scene) => (scene.clone(), Input::from_scene(scene)?),
    })
}

fn verify_run(
    snapshot: &Snapshot,
    scene: &Scene,
    input: &Input,
    name: &str,
    old: &Run,
) -> Result<VerifiedRun> {
    let request = old.options.request(scene)?;
    let rerun = |bounds: Bounds| -> Result<Run> {
        let mut run = record(&request, bounds)?;
        run.keep_only(old.only.clone());
        Ok(run)
    };
    // Equal bits need no bounds, which take another run.
    let run = rerun(Bounds::LeftOut)?;
    let (differences, compared) = compare(old, &run);
    let has_bits = |(name, was): (&Entry, &Numbers)| {
        run.numbers.get(name).is_some_and(|is| is.values == was.values)
    };
    if differences.is_empty() && old.numbers.iter().all(has_bits) {
        return Ok(VerifiedRun { compared, ..VerifiedRun::new(name, Presence::Both, run) });
    }
    let run = rerun(Bounds::Computed)?;
    let (differences, _) = compare(old, &run);
    if let Some(first) = decided_by_rounding(&request, &run, &differences)? {
        let (_, compared) = compare(&without_path(old, first), &without_path(&run, first));
        let run = VerifiedRun::new(name, Presence::Both, run);
        return Ok(VerifiedRun { compared, path: Some(first), ..run });
    }
    let was = (&*snapshot.version, &snapshot.input, old);
    Ok(VerifiedRun::compared(name.into(), was, (VERSION, input, &run)))
}

/// Compares two snapshots, the runs of the same name with each other; where each has one run, these.
pub fn difference(old: &Snapshot, new: &Snapshot) -> Verified {
    let single = old.runs.len() == 1 && new.runs.len() == 1;
    let compared = old.runs.iter().map(|(name, was)| {
        let other = if single { new.runs.first() } else { new.runs.get_key_value(name) };
        let Some((other, is)) = other else {
            return VerifiedRun::new(name, Presence::Missing, was.clone());
        };
        let name = if name == other { name.clone() } else { format!("{name} and {other}") };
        VerifiedRun::compared(name, (&old.version, &old.input, was), (&new.version, &new.input, is))
    });
    let added = new.runs.iter().filter(|(name, _)| !single && !old.runs.contains_key(*name));
    let added = added.map(|(name, is)| VerifiedRun::new(name, Presence::New, is.clone()));
    Verified { input: new.input.clone(), runs: compared.chain(added).collect() }
}

/// Returns the first iteration of the `differences` of a run from an earlier one where these are of the
/// path alone, and rounding decides it: with inputs that differ in their last digits the run takes another
/// path there too, or before.
///
/// # Errors
/// The scene with such inputs is at fault.
fn decided_by_rounding(
    request: &Request,
    run: &Run,
    differences: &[Difference],
) -> Result<Option<usize>> {
    let Some(first) = first_iteration(differences) else { return Ok(None) };
    if run.options.variant != Some(Variant::Unilateral)
        || !differences.iter().all(|d| is_of_path(d.entry, first))
    {
        return Ok(None);
    }
    for request in perturbed_requests(request) {
        let changed = record(&request, Bounds::LeftOut)?;
        if first_iteration(&compare(run, &changed).0).is_some_and(|other| other <= first) {
            return Ok(Some(first));
        }
    }
    Ok(None)
}

/// Returns a run without its path from iteration `first` on.
fn without_path(run: &Run, first: usize) -> Run {
    let mut run = run.clone();
    run.facts.retain(|name, _| !is_of_path(*name, first));
    run.numbers.retain(|name, _| !is_of_path(*name, first));
    run
}

fn is_of_path(entry: Entry, first: usize) -> bool {
    entry == Quantity::Iterations.into() || entry.iteration.is_some_and(|k| k >= first)
}

/// Returns the first iteration of which something differs; None where nothing does.
fn first_iteration(differences: &[Difference]) -> Option<usize> {
    differences.iter().filter_map(|d| d.entry.iteration).min()
}
