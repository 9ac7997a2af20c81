//! Trials run in turn, timed, and measured against the best of them.

use rayon::prelude::*;

use super::axis::{AXES, Axis, Truth};
use super::errors::{Contact, Errors};
use super::order::Order;
use super::rows::{Row, Section, Trade};
use super::trial::{TimedTrial, Trial};
use base::error::InputError;
use engine::{Request, Solution, Stiffness, max_displacement, over, solve, summaries};
use problem::scene::Derived;

/// The axes that are varied, in the order of the tables, each with its trials.
pub type Plan = Vec<(&'static Axis, Vec<Trial>)>;

/// Plans the trials of the axes of these names; of all where there are none.
///
/// # Errors
/// The scene cannot be refined.
pub fn plan(request: &Request, only: &[String]) -> Result<Plan, InputError> {
    let is_asked = |axis: &&Axis| only.is_empty() || only.iter().any(|name| name == axis.name);
    let with_trials = |axis: &'static Axis| Ok((axis, axis.trials(request)?));
    AXES.iter().filter(is_asked).map(with_trials).collect()
}

/// Measures trials of a request, each `runs` times in turn, A B C A B C ...; `watch` is called after each run
/// with what was run. A trial that fails is a row that says why.
pub fn measure(request: &Request, plan: Plan, runs: usize, watch: impl Fn(&str)) -> Trade {
    let Request { scene, .. } = request;
    let equilibrium = scene.model.target().map(|_| solve(&request.equilibrium(), &mut |_| ()));
    let (reference, no_reference) = match equilibrium.transpose() {
        Ok(found) => (found, None),
        Err(why) => (None, Some(why.to_string())),
    };
    let section = |(axis, trials): (&'static Axis, Vec<Trial>)| {
        let runs = timed(axis, trials, runs, &watch);
        Bench { axis, runs: &runs, reference: reference.as_ref() }.section()
    };
    Trade {
        scene: scene.name.clone(),
        units: scene.units.clone(),
        nodes: scene.model.nodes.len(),
        triangles: scene.model.triangles.len(),
        runs,
        sections: plan.into_iter().map(section).collect(),
        no_reference,
    }
}

/// Runs the trials in turn, `rounds` times.
fn timed(axis: &Axis, trials: Vec<Trial>, rounds: usize, watch: &impl Fn(&str)) -> Vec<TimedTrial> {
    let ran = |Trial { label, request, .. }: &Trial| {
        watch(&format!("{} {} {label}", axis.name, request.variant));
    };
    let first = |trial| {
        let run = TimedTrial::new(trial, axis);
        ran(&run.trial);
        run
    };
    let mut runs: Vec<TimedTrial> = trials.into_iter().map(first).collect();
    for _ in 1..rounds {
        for run in &mut runs {
            run.repeat();
            ran(&run.trial);
        }
    }
    runs.into_par_iter().map(|run| run.judged(axis)).collect()
}

struct Bench<'a> {
    axis: &'static Axis,
    runs: &'a [TimedTrial],
    reference: Option<&'a Solution>,
}

impl Bench<'_> {
    /// What is measured of an axis, but for the memory that its trials take.
    fn section(&self) -> Section {
        let places = (0..self.runs.len()).into_par_iter();
        let mut rows: Vec<Row> = places.map(|place| self.row(place)).collect();
        mark_front(&mut rows, |place| {
            let times = self.runs[place].seconds.iter().copied();
            [times.clone().fold(f64::INFINITY, f64::min), times.fold(0.0, f64::max)]
        });
        let orders = if self.axis.truth == Truth::Finest { self.orders() } else { Vec::new() };
        Section { parameter: self.axis.name, against: self.axis.truth.words(), rows, orders }
    }

    fn row(&self, place: usize) -> Row {
        let TimedTrial { trial, seconds, solution, certainty } = &self.runs[place];
        let (failure, solution) = (solution.as_ref().err().cloned(), solution.as_ref().ok());
        let last = solution.and_then(|solution| solution.steps.last());
        let same =
            |run: &TimedTrial| run.trial.own && run.trial.request.variant == trial.request.variant;
        let from_own = || self.between(place, self.runs.iter().position(same));
        let finest = || self.runs.iter().rposition(|run| run.solution.is_ok());
        let (error, change) = match self.axis.truth {
            Truth::Equilibrium => {
                let found = solution.zip(self.reference);
                (found.map(|(own, truth)| Errors::new(own, truth)), from_own())
            }
            Truth::Last(_) | Truth::Finest => (self.between(place, finest()), None),
            Truth::Own(_) => (from_own(), None),
        };
        let truth = finest().filter(|_| self.axis.truth == Truth::Finest);
        let truth = truth.and_then(|place| self.runs[place].solution.as_ref().ok());
        Row {
            contact: solution.zip(truth).and_then(|(own, truth)| Contact::new(own, truth)),
            label: trial.label.clone(),
            variant: trial.request.variant,
            equations: trial.request.scene.model.dofs(),
            in_contact: last.map(|last| last.in_contact),
            cycle: last.and_then(|last| last.cycle.as_ref()).map(|cycle| cycle.length),
            seconds: solution.map(|_| median(seconds)),
            runs: seconds.len(),
            error,
            change,
            certainty: *certainty,
            own: trial.own,
            pareto: false,
            failure,
        }
    }

    /// How far the run at `place` is from that at `best`; nothing where one of them failed.
    fn between(&self, place: usize, best: Option<usize>) -> Option<Errors> {
        let [own, truth] = [place, best?].map(|k| self.runs[k].solution.as_ref().ok());
        let [on_finer, on_half] = [self.carried(place, best?), self.carried(best?, place)];
        Some(Errors::new(on_finer.as_ref().or(own)?, on_half.as_ref().or(truth)?))
    }

    /// The run at `from` on the mesh of that at `to`, in as many steps as that was made of its own; nothing
    /// where it was not, and where one of them failed.
    fn carried(&self, from: usize, to: usize) -> Option<Solution> {
        let [own, other] = [from, to].map(|k| self.runs[k].solution.as_ref().ok());
        let (mut meshes, mut at): (Vec<&Derived>, _) = (Vec::new(), to);
        while at != from {
            let (of, mesh) = self.runs[at].trial.mesh.as_ref()?;
            meshes.push(mesh);
            at = *of;
        }
        let Solution { u, elements, .. } = own?.clone();
        let fields = meshes.iter().rev().fold((u, elements), |(u, elements), mesh| {
            let states = mesh.triangles.iter().map(|id| elements[id.index()].clone());
            (mesh.displacements(&u), states.collect())
        });
        Some(other?.with_fields(fields.0, fields.1))
    }

    /// Orders of convergence, from meshes each of half the element size of the one before; nothing where
    /// one of them failed.
    fn orders(&self) -> Vec<Order> {
        let finest = self.runs.len() - 1;
        let levels = (0..=finest).into_par_iter().map(|level| self.carried(level, finest));
        let Some(on_finest) = levels.collect::<Option<Vec<Solution>>>() else { return Vec::new() };
        let stiffness = Stiffness::new(&on_finest[finest].model, |x| x);
        let norm = stiffness.energy_norm(&on_finest[finest].u);
        let between =
            |pair: &[Solution]| over(stiffness.energy_norm(&(&pair[0].u - &pair[1].u)), norm);
        let stress = |solution: &Solution| {
            let bodies = summaries(solution);
            bodies.iter().map(|body| body.max_von_mises_stress).fold(0.0, f64::max)
        };
        // Differences relative to the last value.
        let of_values = |quantity, value: &dyn Fn(&Solution) -> f64| {
            let values: Vec<f64> = on_finest.iter().map(value).collect();
            let differences =
                values.windows(2).map(|pair| over(pair[0] - pair[1], values[finest]).abs());
            Order::fit(quantity, differences.collect(), 1)
        };
        vec![
            Order::fit("energy norm", on_finest.windows(2).map(between).collect(), 2),
            of_values("largest displacement", &|solution| max_displacement(&solution.u)),
            of_values("largest von Mises stress", &stress),
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

/// Whether each point is on the Pareto front: no other is better in one and at least as good in the other, as
/// far as noise tells: times of which the ranges meet are equal, and so are errors by rounding, below 1e-9,
/// that are less than ten times each other.
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
