//! The path of the load: stage by stage, in equal steps, each of which starts from the one before.

use std::sync::Arc;

use nalgebra::DVector;

use super::equilibria::{TakenStep, nearest_decision, uniqueness};
use super::forces::{ContactForce, load_of};
use super::problem::{Configuration, Equilibrium, Iteration, Problem, Setting, Watch};
use crate::contact::{ContactNode, ROUNDING_OF_A_FORCE, Status, Traction};
use crate::error::{Cause, Error, NoEquilibrium};
use crate::solution::{
    self, Detail, Path, Solution, Start, Step, last_under_each_load, max_displacement,
};
use crate::support::{support_force, transmitted_force};

/// How often a step without an equilibrium is halved.
const HALVINGS: usize = 6;

/// How often a step of the path is divided where nodes close in it.
const CLOSINGS: usize = 16;

/// The part of a step, at either end, within which the first node closes that does not divide it; later
/// ones do not then either.
const AT_THE_END: f64 = 1e-3;

/// A point of the path: what the next step starts from.
struct Point {
    /// The part of the path that was applied; whole numbers end stages.
    load: f64,
    /// The displacements, length.
    u: DVector<f64>,
    /// The statuses; none at the beginning.
    statuses: Option<Vec<Status>>,
}

impl Point {
    fn after(load: f64, Equilibrium { last, .. }: Equilibrium) -> Self {
        Point { load, u: last.solution.u, statuses: Some(last.statuses) }
    }
}

/// Follows the path of the load to its end: under friction in equal steps of each stage, otherwise in one.
/// Under friction nodes that overlap at the start come to touch before any load, the bodies as rigid ones where
/// nothing presses them together, else in a step of its own: they would slip with its first part otherwise.
///
/// # Errors
/// No equilibrium was found, or nothing restrains the bodies.
pub(super) fn solve(problem: &Problem, watch: &mut dyn FnMut(&Step)) -> Result<Solution, Error> {
    problem.turns_nowhere()?;
    let with_friction = problem.friction > 0.0;
    // Without friction only the whole load counts.
    let stages = if with_friction { problem.model.stages.len() } else { 1 };
    let per_stage = if with_friction { problem.request.contact.load_steps } else { 1 };
    let total = stages * per_stage;
    let mut point = Point { load: 0.0, u: DVector::zeros(problem.model.dofs()), statuses: None };
    let mut run = Run {
        problem,
        watch,
        steps: Vec::new(),
        factored: 0,
        halved: 0,
        closings: 0,
        start: Start::Held,
        keeps_all: false,
        taken: Vec::new(),
    };
    if with_friction {
        let config = problem.configuration(&point.u);
        run.keeps_all = problem.number_of_states(&config, total).is_some();
        if problem.overlaps(&config) {
            run.start = Start::Closed;
            if let Some(released) = problem.released()? {
                (run.start, point.u) = released;
            } else if let Ok(closed) = run.advance(&point, 0.0, 0) {
                point = Point::after(0.0, closed);
            } else {
                run.steps.clear();
                run.start = Start::Overlapping;
            }
        } else if !problem.is_held_initially(&config) {
            run.start = Start::Loose;
        }
    }
    for step in 1..=total {
        let to = step as f64 / per_stage as f64;
        let equilibrium = run.step_of_path(&point, to).map_err(|why| {
            let may_slide = with_friction && matches!(why, Error::Equilibrium(_));
            let slides = may_slide.then(|| problem.slides(&point.u, [point.load, to])).flatten();
            slides.map_or_else(|| with_load(why, to, stages, step == total), Error::from)
        })?;
        problem.in_range([&point.u, &equilibrium.last.solution.u], [point.load, to])?;
        if step == total {
            let confirmed = run.confirmed(to, equilibrium);
            let end = confirmed.map_err(|why| with_load(why, to, stages, true))?;
            let path = with_friction.then(|| Path {
                steps: per_stage,
                stages,
                halved: run.halved,
                start: run.start,
                changes: changes(&run.steps),
            });
            return Ok(run.solution(end, path));
        }
        point = Point::after(to, equilibrium);
    }
    unreachable!("a path has a last step")
}

/// Returns the number of steps in which a node that was closed has another status at the end.
fn changes(steps: &[Step]) -> usize {
    let own = |i: usize| steps[i].unilateral();
    let ends: Vec<_> = last_under_each_load(steps).into_iter().filter_map(own).collect();
    let changed = |pair: &&[&solution::Unilateral]| {
        let mut statuses = pair[0].statuses.iter().zip(&pair[1].statuses);
        statuses.any(|(before, after)| before.is_closed() && before != after)
    };
    ends.windows(2).filter(changed).count()
}

/// Adds to an error on the way to which load no equilibrium was found.
fn with_load(why: Error, to: f64, stages: usize, at_the_end: bool) -> Error {
    match why {
        Error::Equilibrium(NoEquilibrium { cause, what }) if !at_the_end || stages > 1 => {
            let what = format!("{what} (on the way to {})", part_of_load(to, stages));
            NoEquilibrium { cause, what }.into()
        }
        other => other,
    }
}

/// Names a part of the path, to three decimals: 1.5 of two stages is half of the second.
pub(super) fn part_of_load(part: f64, stages: usize) -> String {
    let stage = part.ceil().max(1.0);
    let of_stage = (1000.0 * (part - (stage - 1.0))).floor() / 1000.0;
    match stages {
        1 => format!("{of_stage} of the load"),
        _ if of_stage == 1.0 => format!("the end of stage {stage}"),
        _ => format!("{of_stage} of stage {stage}"),
    }
}

/// A search for the equilibrium of a setting.
type Search<'a> = fn(&Problem<'a>, &Setting, &mut Watch) -> Result<Equilibrium, Error>;

/// What was found along the path so far.
struct Run<'a> {
    problem: &'a Problem<'a>,
    watch: &'a mut dyn FnMut(&Step),
    /// The iterations on the path, without those of steps that were divided.
    steps: Vec<Step>,
    /// The number of all contact states that were solved.
    factored: usize,
    /// The number of steps that were halved.
    halved: usize,
    /// How often this step of the path may still be divided where nodes close.
    closings: usize,
    start: Start,
    /// Whether all steps are kept, or the last one alone.
    keeps_all: bool,
    taken: Vec<TakenStep>,
}

impl<'a> Run<'a> {
    /// Takes a step of the path from a point to the load `to`: on springs where no equilibrium is found
    /// without.
    fn step_of_path(&mut self, from: &Point, to: f64) -> Result<Equilibrium, Error> {
        let with_friction = self.problem.friction > 0.0;
        self.closings = if with_friction { CLOSINGS } else { 0 };
        match self.advance(from, to, if with_friction { HALVINGS } else { 0 }) {
            Err(Error::Equilibrium(why)) if why.cause == Cause::NotFound => {
                let found = self
                    .step(from, to, Problem::on_springs)
                    .map_err(|more| more.prefixed(&format!("{}; ", why.what)))?;
                self.take(from, to, &found);
                Ok(found)
            }
            found => found,
        }
    }

    /// Goes from a point to the load `to`: in two parts where a node closes in between, as friction
    /// counts its slip from there, and in two halves where one step finds no equilibrium.
    fn advance(&mut self, from: &Point, to: f64, halvings: usize) -> Result<Equilibrium, Error> {
        let (done, taken) = (self.steps.len(), self.taken.len());
        let found = self.step(from, to, Problem::equilibrium);
        let (middle, halvings) = match &found {
            Ok(Equilibrium { closing: Some(part), .. })
                if self.closings > 0 && (AT_THE_END..1.0 - AT_THE_END).contains(part) =>
            {
                self.closings -= 1;
                (from.load + part * (to - from.load), halvings)
            }
            Err(Error::Equilibrium(why)) if halvings > 0 && why.cause == Cause::NotFound => {
                self.halved += 1;
                ((from.load + to) / 2.0, halvings - 1)
            }
            _ => return found.inspect(|found| self.take(from, to, found)),
        };
        let whole = self.steps.split_off(done);
        match self.advance(from, middle, halvings) {
            Ok(equilibrium) => self.advance(&Point::after(middle, equilibrium), to, halvings),
            Err(why) => {
                self.steps.truncate(done);
                self.steps.extend(whole);
                self.taken.truncate(taken);
                found.or(Err(why)).inspect(|found| self.take(from, to, found))
            }
        }
    }

    /// Keeps that a step was taken.
    fn take(&mut self, from: &Point, to: f64, found: &Equilibrium) {
        if !self.keeps_all {
            self.taken.clear();
        }
        let Equilibrium { config, last, .. } = found;
        self.taken.push(TakenStep {
            to,
            is_first: from.statuses.is_none(),
            before: from.u.clone(),
            config: config.clone(),
            statuses: last.statuses.clone(),
            u: last.solution.u.clone(),
        });
    }

    /// Goes to the load `to` in one step by a search.
    fn step(&mut self, from: &Point, to: f64, search: Search<'a>) -> Result<Equilibrium, Error> {
        let load = self.problem.load(to);
        let setting = self.problem.setting(load.clone(), &from.u, from.statuses.as_deref());
        search(self.problem, &setting, &mut |config, iteration| {
            self.keep(to, &load, config, iteration);
        })
    }

    /// Solves the last contact state, at the load `to`, on the whole bodies.
    fn confirmed(&mut self, to: f64, found: Equilibrium) -> Result<Equilibrium, Error> {
        let load = self.problem.load(to);
        let mut last = self.taken.pop().expect("a path has a step");
        let setting = self.problem.setting(load.clone(), &last.before, None);
        let setting = Setting { whole: true, ..setting };
        let end = self.problem.confirmed(found, &setting, &mut |config, iteration| {
            self.keep(to, &load, config, iteration);
        })?;
        let k = self.steps.len();
        if let Some(last) = self.steps.last_mut() {
            *last = step(self.problem, (k, to), &load, &end.config, &end.last);
        }
        last.config = end.config.clone();
        last.statuses = end.last.statuses.clone();
        last.u = end.last.solution.u.clone();
        self.taken.push(last);
        Ok(end)
    }

    /// Adds an iteration to the steps.
    fn keep(
        &mut self,
        to: f64,
        load: &DVector<f64>,
        config: &Configuration,
        iteration: &Iteration,
    ) {
        self.factored += usize::from(!iteration.returned);
        let step = step(self.problem, (self.steps.len() + 1, to), load, config, iteration);
        (self.watch)(&step);
        self.steps.push(step);
    }

    /// Returns the solution, which is the end of the path.
    fn solution(self, end: Equilibrium, path: Option<Path>) -> Solution {
        let Run { problem, steps, factored, taken, .. } = self;
        let uniqueness = uniqueness(problem, &end, &taken);
        let nearest = nearest_decision(problem, &end, &taken);
        let Equilibrium { config, last, shape_change, springs, .. } = end;
        let facets = problem.coarse_facets();
        let [unseen, inside] = problem.deepest_nodes(&last.solution.u);
        Solution {
            request: problem.request.clone(),
            model: problem.model.clone(),
            contact: contact(problem, &config, &last),
            elements: problem.stiffness.states(&last.solution.u),
            factored,
            steps,
            digits: None,
            error_bound: None,
            equilibrium: Some(solution::Equilibrium {
                path,
                uniqueness,
                nearest,
                unseen,
                inside,
                facets,
                shape_change,
                springs,
            }),
            u: last.solution.u,
        }
    }
}

/// Returns an iteration, the `k`-th, at the part `to` of the path as a step of the solution.
fn step(
    problem: &Problem,
    (k, to): (usize, f64),
    load: &DVector<f64>,
    config: &Configuration,
    iteration: &Iteration,
) -> Step {
    let Iteration { statuses, constraints, cycle, solution, violation, .. } = iteration;
    let contact = load_of(&config.pairings, &solution.forces, solution.u.len());
    let at_supports = problem.supports.iter().copied();
    let reaction = problem.stiffness.times_of(at_supports, &solution.u) - load - contact;
    let support = support_force(problem.model, problem.model.restraints(), &reaction, load);
    let target_force = transmitted_force(problem.model, support);
    Step {
        k,
        shape: Arc::clone(&config.shape),
        constraints: constraints.clone(),
        in_contact: statuses.iter().filter(|status| status.is_closed()).count(),
        max_displacement: max_displacement(&solution.u),
        cycle: cycle.clone(),
        target_force,
        solve_residual: solution.residual,
        detail: Detail::Unilateral(solution::Unilateral {
            load: to,
            statuses: statuses.clone(),
            pairings: Arc::clone(&config.pairings),
            friction_needed: friction_needed(statuses, &solution.forces),
            friction: solution.friction.clone(),
            violation: *violation,
            springs: iteration.springs,
        }),
    }
}

/// Returns the largest shear over pressure of a node that is pressed by more than rounding.
fn friction_needed(statuses: &[Status], forces: &[ContactForce]) -> Option<f64> {
    let closed = statuses.iter().zip(forces).filter(|(status, _)| status.is_closed());
    let known = closed.map(|(_, force)| force).filter(|force| !force.undetermined);
    let least = ROUNDING_OF_A_FORCE * known.clone().fold(0.0, |most, f| f.normal.abs().max(most));
    let pressed = known.filter(|force| force.normal > least);
    pressed.map(|force| force.tangent.abs() / force.normal).reduce(f64::max)
}

/// Returns the contact surface at the end.
fn contact(problem: &Problem, config: &Configuration, last: &Iteration) -> Vec<ContactNode> {
    let measured = if problem.is_current() { &*config.shape } else { &problem.model.nodes };
    let open = problem.undetermined(config, last);
    let forces = last.solution.forces.iter().zip(&open);
    let forces =
        forces.map(|(force, open)| [force.normal, force.tangent].map(|x| (!open).then_some(x)));
    let traction = Traction {
        model: problem.model,
        surfaces: &problem.surfaces,
        measured_in: measured,
        pairings: &config.pairings,
        gaps: &last.gaps,
        in_contact: &last.statuses.iter().map(|status| status.is_closed()).collect::<Vec<_>>(),
        statuses: Some(&last.statuses),
        forces: &forces.collect::<Vec<_>>(),
    };
    traction.nodes()
}
