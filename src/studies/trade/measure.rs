//! Trials run in turn, timed, and measured against the best of them.

use std::time::Instant;

use rayon::prelude::*;

use super::Varied;
use super::errors::{Errors, meshes, prolonged};
use super::order::Order;
use super::rows::{Row, Section, Trade};
use super::trials::{ErrorReference, Setting, Trial, judges, trials};
use engine::error::Error;
use engine::estimates::{Certainty, certain};
use engine::{Request, Solution, Stiffness, max_displacement, over, solve, summaries};
use problem::scene::{Refined, Scene};

/// Seconds in all beyond which a trial is not run again: what interrupts a run is short beside them.
const PATIENCE: f64 = 0.05;

/// What is measured, and how often.
#[derive(Clone, Debug)]
pub struct Options {
    /// How many times each trial is run, in turn: A B C A B C ...
    pub runs: usize,
    /// The parameters that are varied; all where the list is empty.
    pub only: Vec<Varied>,
}

/// Turns the parameters of `request` and measures what comes of each place; `watch` is called after each run
/// with what was run.
///
/// # Errors
/// The scene cannot be refined. A trial that fails is a row that says why.
pub fn measure(request: &Request, options: &Options, watch: impl Fn(&str)) -> Result<Trade, Error> {
    let Request { scene, .. } = request;
    let equilibrium = scene.model.target().map(|_| solve(&request.equilibrium(), &mut |_| ()));
    let (reference, no_reference) = match equilibrium.transpose() {
        Ok(found) => (found, None),
        Err(why) => (None, Some(why.to_string())),
    };
    let mut sections = Vec::new();
    for parameter in Varied::ALL.iter().filter(|parameter| options.only.contains(parameter)) {
        let trials = trials(request, *parameter);
        let runs = timed(request, &trials, options.runs, &watch)?;
        let is_refined = |trial: &&Trial| matches!(trial.setting, Setting::Refined(1..));
        let meshes = meshes(scene, trials.iter().filter(is_refined).count())?;
        let bench =
            Bench { scene, trials: &trials, runs: &runs, meshes, reference: reference.as_ref() };
        sections.push(bench.section(*parameter));
    }
    Ok(Trade {
        scene: scene.name.clone(),
        nodes: scene.model.nodes.len(),
        triangles: scene.model.triangles.len(),
        runs: options.runs,
        no_reference,
        sections,
    })
}

/// How many times [`measure`] calls `watch`.
pub fn steps(request: &Request, options: &Options) -> usize {
    options.only.iter().map(|parameter| trials(request, *parameter).len() * options.runs).sum()
}

/// The runs of a trial: how long each took, and what all of them computed.
struct Run {
    seconds: Vec<f64>,
    equations: usize,
    solution: Result<Solution, String>,
    certainty: Option<Certainty>,
}

/// Runs the trials in turn, `rounds` times, each from the scene alone: a time includes every
/// factorisation.
fn timed(
    request: &Request,
    trials: &[Trial],
    rounds: usize,
    watch: &impl Fn(&str),
) -> Result<Vec<Run>, Error> {
    let requests: Result<Vec<Request>, _> = trials.iter().map(|t| t.request(request)).collect();
    let requests = requests?;
    let mut runs: Vec<Run> = Vec::new();
    for round in 0..rounds {
        for (place, (trial, request)) in trials.iter().zip(&requests).enumerate() {
            let again = runs.get(place).is_none_or(|run: &Run| {
                run.solution.is_ok() && run.seconds.iter().sum::<f64>() < PATIENCE
            });
            if again {
                let start = Instant::now();
                let solution = solve(request, &mut |_| ());
                let seconds = start.elapsed().as_secs_f64();
                if round == 0 {
                    let solution = match solution {
                        Ok(solution) if !judges(trial.parameter) => Ok(light(solution)),
                        other => other.map_err(|why| why.to_string()),
                    };
                    let equations = request.scene.model.dofs();
                    runs.push(Run { seconds: Vec::new(), equations, solution, certainty: None });
                }
                runs[place].seconds.push(seconds);
            }
            watch(&format!("{} {} {}", trial.parameter, trial.variant, trial.label));
        }
    }
    // What rounding decides in it, where its parameter judges.
    let judged = |(trial, run): (&Trial, Run)| match run.solution {
        Ok(solution) if judges(trial.parameter) => {
            let (solution, certainty) = certain(solution);
            Run { solution: Ok(light(solution)), certainty: Some(certainty), ..run }
        }
        solution => Run { solution, ..run },
    };
    Ok(trials.par_iter().zip(runs).map(judged).collect())
}

/// A solution without all steps but the last.
fn light(mut solution: Solution) -> Solution {
    let before = solution.steps.len().saturating_sub(1);
    solution.steps.drain(..before);
    solution
}

struct Bench<'a> {
    scene: &'a Scene,
    trials: &'a [Trial],
    runs: &'a [Run],
    /// The meshes of the parameter *mesh* but the scene's own; none of another one.
    meshes: Vec<Refined>,
    reference: Option<&'a Solution>,
}

impl Bench<'_> {
    /// What is measured of a parameter, but for the memory that its trials take.
    fn section(&self, parameter: Varied) -> Section {
        let places = (0..self.trials.len()).into_par_iter();
        let mut rows: Vec<Row> = places.map(|place| self.row(place)).collect();
        mark_front(&mut rows, |place| {
            let times = self.runs[place].seconds.iter().copied();
            [times.clone().fold(f64::INFINITY, f64::min), times.fold(0.0, f64::max)]
        });
        let orders = if parameter == Varied::Mesh { self.orders() } else { Vec::new() };
        Section { parameter, against: parameter.against(), rows, orders }
    }

    fn row(&self, place: usize) -> Row {
        let (trial, run) = (&self.trials[place], &self.runs[place]);
        let solution = run.solution.as_ref().ok();
        let last = solution.and_then(|solution| solution.steps.last());
        // The trial of the same variant where the scene has the parameter; parameters that change the mesh
        // have their own measure.
        let is_mesh = matches!(trial.parameter, Varied::Mesh | Varied::Symmetry);
        let same = |other: &Trial| !is_mesh && other.own && other.variant == trial.variant;
        let unchanged = self.trials.iter().position(same);
        Row {
            label: trial.label.clone(),
            variant: trial.variant,
            equations: run.equations,
            in_contact: last.map(|last| last.in_contact),
            cycle: last.and_then(|last| last.cycle.as_ref()).map(|cycle| cycle.length),
            seconds: solution.map(|_| median(&run.seconds)),
            runs: run.seconds.len(),
            error: match trial.against {
                ErrorReference::Trial(best) if trial.parameter == Varied::Symmetry => {
                    self.between(place, Some(best))
                }
                // Where it failed, the last trial before it that did not.
                ErrorReference::Trial(best) => {
                    let ran = |k: &usize| self.runs[*k].solution.is_ok();
                    self.between(place, (place..=best).rev().find(ran))
                }
                ErrorReference::Reference => {
                    solution.zip(self.reference).map(|(own, truth)| Errors::new(own, truth))
                }
            },
            change: self.between(place, unchanged),
            certainty: run.certainty,
            own: trial.own,
            pareto: false,
            failure: run.solution.as_ref().err().cloned(),
        }
    }

    /// How far the run at `place` is from that at `best`; nothing where one of them failed.
    fn between(&self, place: usize, best: Option<usize>) -> Option<Errors> {
        let solution_of = |place: usize| {
            let solution = self.runs[place].solution.as_ref().ok()?;
            Some((self.trials[place].setting, solution))
        };
        let (own, truth) = (solution_of(place)?, solution_of(best?)?);
        Some(Errors::between(self.scene, &self.meshes, own, truth))
    }

    /// Orders of convergence, from meshes each of half the element size of the one before; nothing where
    /// one of them failed.
    fn orders(&self) -> Vec<Order> {
        let solutions: Vec<&Solution> =
            self.runs.iter().filter_map(|run| run.solution.as_ref().ok()).collect();
        let Some(&finest) = solutions.last().filter(|_| solutions.len() == self.runs.len()) else {
            return Vec::new();
        };
        let stiffness = Stiffness::new(&finest.model, |x| x);
        let levels = solutions.par_iter().enumerate();
        let on_finest: Vec<Solution> = levels
            .map(|(level, solution)| prolonged((*solution).clone(), &self.meshes[level..], finest))
            .collect();
        let norm = stiffness.energy_norm(&finest.u);
        let between = |a: usize, b: usize| {
            over(stiffness.energy_norm(&(&on_finest[a].u - &on_finest[b].u)), norm)
        };
        let neighbours = (1..solutions.len()).map(|l| between(l - 1, l));
        let displacements = solutions.iter().map(|s| max_displacement(&s.u)).collect();
        let stress = |solution: &Solution| {
            let bodies = summaries(solution);
            bodies.iter().map(|body| body.max_von_mises_stress).fold(0.0, f64::max)
        };
        // Differences relative to the last value.
        let of_values = |quantity, values: Vec<f64>| {
            let last = values.last().copied().unwrap_or(1.0);
            let differences = values.windows(2).map(|pair| over(pair[0] - pair[1], last).abs());
            Order::fit(quantity, differences.collect(), 1)
        };
        vec![
            Order::fit("energy norm", neighbours.collect(), 2),
            of_values("largest displacement", displacements),
            of_values("largest von Mises stress", on_finest.iter().map(stress).collect()),
        ]
    }
}

/// The middle one of `times`, or the mean of the two in the middle.
fn median(times: &[f64]) -> f64 {
    let mut times = times.to_vec();
    times.sort_by(f64::total_cmp);
    let (low, high) = ((times.len() - 1) / 2, times.len() / 2);
    (times[low] + times[high]) / 2.0
}

/// Marks the rows that no other is quicker and nearer than, from the times of each one's runs.
fn mark_front(rows: &mut [Row], times: impl Fn(usize) -> [f64; 2]) {
    let point = |(k, row): (usize, &Row)| {
        let error = row.seconds.and(row.error)?.displacement;
        Some((k, Point { seconds: times(k), error }))
    };
    let (at, points): (Vec<usize>, Vec<Point>) = rows.iter().enumerate().filter_map(point).unzip();
    for (k, front) in at.into_iter().zip(pareto(&points)) {
        rows[k].pareto = front;
    }
}

/// What a run costs, and how far it is off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The least and the greatest time of its repetitions, seconds.
    pub seconds: [f64; 2],
    /// The difference of a displacement over the largest displacement.
    pub error: f64,
}

/// Whether each point is on the Pareto front: no other is better in one and at least as good in the other, as far
/// as noise tells: times of which the ranges meet are equal, and so are errors by rounding, below 1e-9, that are
/// less than ten times each other.
pub fn pareto(points: &[Point]) -> Vec<bool> {
    const ROUNDING: f64 = 1e-9;
    let quicker = |a: &Point, b: &Point| a.seconds[1] < b.seconds[0];
    let nearer = |a: &Point, b: &Point| {
        let noise = if b.error < ROUNDING { 0.1 } else { 1.0 };
        a.error < noise * b.error
    };
    let better = |a: &Point, b: &Point| quicker(a, b) || nearer(a, b);
    let beats = |a: &Point, b: &Point| better(a, b) && !better(b, a);
    points.iter().map(|b| !points.iter().any(|a| beats(a, b))).collect()
}
