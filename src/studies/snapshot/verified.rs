//! Two snapshots compared, run by run; a snapshot verified or accepted is one whose runs are made again.

use rayon::prelude::*;

use super::changes::{Change, changes};
use super::difference::first_iteration;
use super::difference::{Difference, Sides, compare, side_by_side};
use super::first_difference::{First, first};
use super::run::unmeasured;
use super::{Entry, Input, Numbers, Quantity, Run, Snapshot, record};
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
    /// Whether each summary is that of its snapshot's runs.
    pub is_summed_up: bool,
}

choices! {
    /// Where a run is.
    Presence {
        /// On both sides.
        Both = "both",
        /// Missing: the old side alone has it.
        Missing = "missing",
        /// New: the old side does not have it.
        New = "new",
    }
}

/// What came of a run.
#[derive(Clone, Debug, Default)]
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
        self.runs.iter().all(VerifiedRun::is_same) && !self.runs.is_empty() && self.is_summed_up
    }
}

impl VerifiedRun {
    /// Returns whether anything was compared and nothing differs.
    pub fn is_same(&self) -> bool {
        self.differences.is_empty() && self.compared > 0
    }

    /// Makes a run that one side alone has.
    fn alone(name: &str, presence: Presence, run: &Run) -> Self {
        VerifiedRun { name: name.into(), presence, run: run.clone(), ..VerifiedRun::default() }
    }

    /// Compares two runs, each of a snapshot.
    fn compared(name: &str, old: (&Snapshot, &Run), new: (&Snapshot, &Run)) -> Self {
        let (differences, compared) = compare(old.1, new.1);
        let (changes, first) = (changes(old, new), first(old.1, new.1, &differences));
        let run = VerifiedRun::alone(name, Presence::Both, new.1);
        VerifiedRun { differences, compared, changes, first, ..run }
    }

    /// Leaves out the path from iteration `first` on, which rounding decides, and compares the rest with
    /// `old`.
    fn without_path(self, old: &Run, first: usize) -> Self {
        let [old, new] = [old, &self.run].map(|run| {
            let mut run = run.clone();
            run.retain(|entry| !is_of_path(entry, first));
            run
        });
        let (differences, compared) = compare(&old, &new);
        VerifiedRun { differences, compared, path: Some(first), first: None, ..self }
    }
}

/// Compares two snapshots, the runs of the same name with each other; where each has one run, these.
pub fn difference(old: &Snapshot, new: &Snapshot) -> Verified {
    let mut sides = [old, new].into_iter();
    let is_summed_up = sides.all(|side| side.scene().is_ok_and(|scene| side.is_summed_up(&scene)));
    Verified { is_summed_up, ..compared(old, new) }
}

/// Compares the runs of two snapshots, whose summaries are taken for theirs.
fn compared(old: &Snapshot, new: &Snapshot) -> Verified {
    let [old, new] = [old, new].map(Snapshot::with_tolerances);
    let [old, new] = [&old, &new];
    let both = |name: &str, was: &Run, is: &Run| VerifiedRun::compared(name, (old, was), (new, is));
    let run = |(name, sides): (&String, Sides<Run>)| match sides {
        Sides::Both(was, is) => both(name, was, is),
        Sides::Missing(was) => VerifiedRun::alone(name, Presence::Missing, was),
        Sides::New(is) => VerifiedRun::alone(name, Presence::New, is),
    };
    let is_single = old.runs.len() == 1 && new.runs.len() == 1;
    let single = old.runs.first().zip(new.runs.first()).filter(|_| is_single);
    let runs = match single.filter(|((name, _), (other, _))| name != other) {
        Some(((name, was), (other, is))) => vec![both(&format!("{name} and {other}"), was, is)],
        None => side_by_side(&old.runs, &new.runs).map(run).collect(),
    };
    Verified { input: new.input.clone(), runs, is_summed_up: true }
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
    // What it says of its scene must be true, whatever scene is run.
    let own = snapshot.scene()?;
    let is_summed_up = snapshot.is_summed_up(&own);
    let scene = scene.cloned().unwrap_or(own);
    let again = again(snapshot, &scene, |request, old| {
        let run = run_to_compare(request, old);
        done();
        run
    })?;
    let verified = compared(snapshot, &again);
    let runs = verified.runs.into_par_iter().map(|run| {
        let old = &snapshot.runs[&run.name];
        let path = decided_by_rounding(&old.options.request(&scene)?, &run)?;
        Ok(match path {
            Some(first) => run.without_path(old, first),
            None => run,
        })
    });
    Ok(Verified { runs: runs.collect::<Result<_>>()?, is_summed_up, ..verified })
}

/// Records the runs of `snapshot` again, on its own scene or on `scene` in its place. What is recorded
/// of each, and the tolerances that it gives, stay.
///
/// # Errors
/// The snapshot or the scene is at fault.
pub fn accept(snapshot: &Snapshot, scene: Option<&Scene>) -> Result<Snapshot> {
    let scene = scene.map_or_else(|| snapshot.scene(), |scene| Ok(scene.clone()))?;
    again(snapshot, &scene, |request, old| Ok(record(request)?.recorded_as(old)))
}

/// Returns the snapshot of a scene with the runs of `snapshot`, each made by `run` of its request and of what
/// it was.
fn again(
    snapshot: &Snapshot,
    scene: &Scene,
    run: impl Fn(&Request, &Run) -> Result<Run> + Sync,
) -> Result<Snapshot> {
    let runs: Vec<(&String, &Run)> = snapshot.runs.iter().collect();
    let runs = runs
        .par_iter()
        .map(|(name, old)| Ok(((*name).clone(), run(&old.options.request(scene)?, old)?)));
    let runs = runs.collect::<Result<Vec<_>>>()?.into_iter().collect();
    Ok(Snapshot::of_runs(scene, snapshot.scene_file.clone(), snapshot.tolerance, runs))
}

/// Records a run to be compared with an earlier one: of equal bits it need not be known what rounding does.
fn run_to_compare(request: &Request, old: &Run) -> Result<Run> {
    let run = unmeasured(request)?.recorded_as(old);
    let has_bits = |(name, was): (&Entry, &Numbers)| {
        run.numbers.get(name).is_some_and(|is| is.values == was.values)
    };
    match compare(old, &run).0.is_empty() && old.numbers.iter().all(has_bits) {
        true => Ok(run),
        false => Ok(record(request)?.recorded_as(old)),
    }
}

/// Returns the first iteration of the differences of a run from an earlier one where these are of the
/// path alone, and rounding decides it: with inputs that differ in their last digits the run takes another
/// path there too, or before.
///
/// # Errors
/// The scene with such inputs is at fault.
fn decided_by_rounding(request: &Request, verified: &VerifiedRun) -> Result<Option<usize>> {
    let VerifiedRun { run, differences, .. } = verified;
    let Some(first) = first_iteration(differences) else { return Ok(None) };
    if run.options.variant != Some(Variant::Unilateral)
        || !differences.iter().all(|d| is_of_path(d.entry, first))
    {
        return Ok(None);
    }
    for request in perturbed_requests(request) {
        let changed = unmeasured(&request)?;
        if first_iteration(&compare(run, &changed).0).is_some_and(|other| other <= first) {
            return Ok(Some(first));
        }
    }
    Ok(None)
}

fn is_of_path(entry: Entry, first: usize) -> bool {
    entry == Quantity::Iterations.into() || entry.iteration.is_some_and(|k| k >= first)
}
