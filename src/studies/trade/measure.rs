//! Trials run in turn, timed, and measured against the best of them.

use std::time::Instant;

use serde::Serialize;

use super::errors::{Errors, Pair, meshes, prolonged};
use super::order::Order;
use super::pareto::pareto;
use super::trials::{Against, Trial, trials};
use super::{Knob, words};
use crate::answer::contact::{self, Outcome, summaries};
use crate::answer::error::Error;
use crate::paper::mirror::Reading;
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;

/// Seconds beyond which a trial is not run again: the median of one is itself.
const PATIENCE: f64 = 4.0;

/// What is measured.
#[derive(Clone, Debug)]
pub struct Options {
    /// Runs of each trial, in turn: A B C A B C ...
    pub runs: usize,
    /// The knobs.
    pub only: Vec<Knob>,
}

/// Speed against accuracy on a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Trade {
    /// The scene.
    pub scene: String,
    /// Its nodes and triangles.
    pub nodes: usize,
    /// Its triangles.
    pub triangles: usize,
    /// Runs of each trial.
    pub runs: usize,
    /// The knobs.
    pub sections: Vec<Section>,
}

/// What came of a knob.
#[derive(Clone, Debug, Serialize)]
pub struct Section {
    /// The knob.
    pub knob: Knob,
    /// What errors are measured against, in words.
    pub against: &'static str,
    /// Its trials.
    pub rows: Vec<Row>,
    /// Orders of convergence, of the element size only.
    pub orders: Vec<Order>,
    /// What the rows say, in words.
    pub answers: Vec<String>,
}

/// What came of a trial. Times and peaks are this machine's.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Where the knob stood.
    pub rung: String,
    /// What was run.
    pub variant: Variant,
    /// Equations, restrained ones included.
    pub equations: usize,
    /// Nodes in contact at the end.
    pub in_contact: Option<usize>,
    /// Iterations after which the contact state at the end returns; 1 = settled.
    pub cycle: Option<usize>,
    /// Median of the times, s.
    pub seconds: Option<f64>,
    /// How many times it was run.
    pub runs: usize,
    /// The most memory of a process that did nothing else, bytes.
    pub peak_bytes: Option<u64>,
    /// How far it is from what the section measures against; nothing of a failure.
    pub error: Option<Errors>,
    /// How far it is from the same variant where the scene has the knob; nothing where the scene has none of the places.
    pub change: Option<Errors>,
    /// Whether the scene has the knob here.
    pub own: bool,
    /// Whether no other of the section is quicker and nearer.
    pub pareto: bool,
    /// Why it has no result.
    pub failure: Option<String>,
}

/// Measures. `peak` gives a trial's peak memory, `watch` is called after each run with what was run.
///
/// # Errors
/// A scene that cannot be refined, or has no worksheet under `reading`. A trial that fails is a row that says why.
pub fn measure(
    scene: &Scene,
    reading: &Reading,
    options: &Options,
    mut peak: impl FnMut(&Trial) -> Option<u64>,
    mut watch: impl FnMut(&str),
) -> Result<Trade, Error> {
    let converged = scene.target().and_then(|_| contact::reference(scene, reading).ok());
    let mut sections = Vec::new();
    for knob in Knob::ALL.iter().filter(|knob| options.only.contains(knob)) {
        let trials = trials(scene, reading, *knob);
        let runs = timed(scene, reading, &trials, options.runs, &mut watch)?;
        let bench = Bench { scene, trials: &trials, runs: &runs, converged: converged.as_ref() };
        let mut rows = Vec::new();
        for (place, trial) in trials.iter().enumerate() {
            rows.push(bench.row(place, peak(trial))?);
            watch("peak memory");
        }
        mark_front(&mut rows);
        let orders = if *knob == Knob::Mesh { bench.orders()? } else { Vec::new() };
        let answers = words::answers(scene, reading, *knob, &rows, &orders);
        sections.push(Section { knob: *knob, against: against(*knob), rows, orders, answers });
    }
    let (nodes, triangles) = (scene.sheet().R(), scene.sheet().M());
    Ok(Trade { scene: scene.name.clone(), nodes, triangles, runs: options.runs, sections })
}

/// What errors are measured against.
fn against(knob: Knob) -> &'static str {
    match knob {
        Knob::Arithmetic => "the last row that ran",
        Knob::Solver => "f64x2",
        Knob::Mesh => "the finest mesh that ran",
        Knob::Symmetry => "the whole scene under the same variant",
        _ => "the converged answer on the same mesh (unilateral, mortar)",
    }
}

/// What came of the runs of a trial.
struct Run {
    seconds: Vec<f64>,
    equations: usize,
    outcome: Result<Outcome, String>,
}

/// Runs the trials in turn.
fn timed(
    scene: &Scene,
    reading: &Reading,
    trials: &[Trial],
    rounds: usize,
    watch: &mut impl FnMut(&str),
) -> Result<Vec<Run>, Error> {
    let mut runs: Vec<Run> = Vec::new();
    for round in 0..rounds {
        for (place, trial) in trials.iter().enumerate() {
            let again = runs.get(place).is_none_or(|run: &Run| {
                run.outcome.is_ok() && run.seconds.iter().all(|s| *s < PATIENCE)
            });
            if again {
                let scene = trial.scene(scene)?;
                let start = Instant::now();
                let outcome =
                    contact::run_in(&scene, trial.variant, reading, trial.arithmetic, |_| ());
                let seconds = start.elapsed().as_secs_f64();
                if round == 0 {
                    let outcome = outcome.map(light).map_err(|why| why.to_string());
                    let equations = 2 * scene.sheet().R();
                    runs.push(Run { seconds: Vec::new(), equations, outcome });
                }
                runs[place].seconds.push(seconds);
            }
            watch(&trial.name());
        }
    }
    Ok(runs)
}

/// An outcome without all iterations but the last.
fn light(mut outcome: Outcome) -> Outcome {
    let before = outcome.iterations.len().saturating_sub(1);
    outcome.iterations.drain(..before);
    outcome
}

/// The trials of a knob and their runs.
struct Bench<'a> {
    scene: &'a Scene,
    trials: &'a [Trial],
    runs: &'a [Run],
    converged: Option<&'a Outcome>,
}

impl Bench<'_> {
    fn row(&self, place: usize, peak_bytes: Option<u64>) -> Result<Row, Error> {
        let (trial, run) = (&self.trials[place], &self.runs[place]);
        let outcome = run.outcome.as_ref().ok();
        let last = outcome.and_then(|outcome| outcome.iterations.last());
        Ok(Row {
            rung: trial.rung.clone(),
            variant: trial.variant,
            equations: run.equations,
            in_contact: last.map(|last| last.in_contact),
            cycle: last.and_then(|last| last.cycle.as_ref()).map(|cycle| cycle.length),
            seconds: outcome.map(|_| median(&run.seconds)),
            runs: run.seconds.len(),
            peak_bytes: peak_bytes.filter(|_| outcome.is_some()),
            error: self.error(place)?,
            change: self.change(place)?,
            own: trial.own,
            pareto: false,
            failure: run.outcome.as_ref().err().cloned(),
        })
    }

    fn error(&self, place: usize) -> Result<Option<Errors>, Error> {
        match self.trials[place].against {
            Against::Trial(best) => match self.best_that_ran(place, best) {
                Some(best) => self.between(place, best),
                None => Ok(None),
            },
            Against::Converged => {
                let outcome = self.runs[place].outcome.as_ref().ok();
                let both = outcome.zip(self.converged);
                Ok(both.map(|(outcome, truth)| Errors::new(self.scene, outcome, truth)))
            }
        }
    }

    /// `best`, or where it failed the last rung before it that did not.
    fn best_that_ran(&self, place: usize, best: usize) -> Option<usize> {
        if self.trials[place].knob == Knob::Symmetry {
            return Some(best);
        }
        (place..=best).rev().find(|k| self.runs[*k].outcome.is_ok())
    }

    /// From the same variant where the scene has the knob; knobs that change the mesh have their own measure.
    fn change(&self, place: usize) -> Result<Option<Errors>, Error> {
        let trial = &self.trials[place];
        if matches!(trial.knob, Knob::Mesh | Knob::Symmetry) {
            return Ok(None);
        }
        let same = |other: &Trial| other.own && other.variant == trial.variant;
        match self.trials.iter().position(same) {
            Some(own) => self.between(place, own),
            None => Ok(None),
        }
    }

    /// How far the run at `place` is from that at `best`.
    fn between(&self, place: usize, best: usize) -> Result<Option<Errors>, Error> {
        let (Ok(outcome), Ok(truth)) = (&self.runs[place].outcome, &self.runs[best].outcome) else {
            return Ok(None);
        };
        let best = (self.trials[best].setting, truth);
        let pair = Pair::new(self.scene, (&self.trials[place], outcome), best)?;
        Ok(Some(pair.errors()))
    }

    /// Orders of convergence from the ladder of meshes.
    fn orders(&self) -> Result<Vec<Order>, Error> {
        let outcomes: Vec<&Outcome> =
            self.runs.iter().filter_map(|run| run.outcome.as_ref().ok()).collect();
        if outcomes.len() < self.runs.len() {
            return Ok(Vec::new());
        }
        let Some(&finest) = outcomes.last() else { return Ok(Vec::new()) };
        let meshes = meshes(self.scene, outcomes.len() - 1)?;
        let scene = meshes.last().map_or(self.scene, |refined| &refined.scene);
        let stiffness = contact::Stiffness::new(&finest.sheet);
        let on_finest: Vec<_> = outcomes
            .iter()
            .enumerate()
            .map(|(level, outcome)| prolonged((*outcome).clone(), &meshes[level..], finest))
            .collect();
        let norm = stiffness.energy_norm(&finest.u);
        let energy = on_finest
            .windows(2)
            .map(|pair| stiffness.energy_norm(&(&pair[0].u - &pair[1].u)) / norm);
        let mut orders = vec![Order::fit("energy norm", energy.collect())];
        let displacements = outcomes.iter().map(|o| contact::max_displacement(&o.u)).collect();
        orders.push(of_values("largest displacement", displacements));
        let stress = |outcome: &Outcome| {
            let bodies = summaries(scene, outcome);
            bodies.iter().map(|body| body.max_von_mises_stress).fold(0.0, f64::max)
        };
        orders.push(of_values("largest von Mises stress", on_finest.iter().map(stress).collect()));
        Ok(orders)
    }
}

fn of_values(quantity: &'static str, values: Vec<f64>) -> Order {
    let last = values.last().copied().unwrap_or(1.0);
    let differences = values.windows(2).map(|pair| ((pair[0] - pair[1]) / last).abs());
    Order::fit(quantity, differences.collect())
}

/// The middle one, or the mean of the two in the middle.
fn median(times: &[f64]) -> f64 {
    let mut times = times.to_vec();
    times.sort_by(f64::total_cmp);
    let (low, high) = ((times.len() - 1) / 2, times.len() / 2);
    (times[low] + times[high]) / 2.0
}

fn mark_front(rows: &mut [Row]) {
    let place = |row: &Row| row.seconds.zip(row.error).map(|(time, e)| [time, e.displacement]);
    let (at, points): (Vec<usize>, Vec<[f64; 2]>) =
        rows.iter().enumerate().filter_map(|(k, row)| Some((k, place(row)?))).unzip();
    for (k, front) in at.into_iter().zip(pareto(&points)) {
        rows[k].pareto = front;
    }
}
