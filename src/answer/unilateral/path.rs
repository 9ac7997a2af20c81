//! The path of the load: stage by stage, in equal steps, each of which starts from the one before.

use std::sync::Arc;

use nalgebra::DVector;

use super::equilibria::uniqueness;
use super::forces::load_of;
use super::problem::{Equilibrium, Iteration, Place, Problem, Setting};
use crate::answer::contact::{ContactNode, Status, Traction};
use crate::answer::error::{Error, NoEquilibrium};
use crate::answer::memory::{FEWER_STEPS, HELD, bytes_of_path};
use crate::answer::solution::{self, Detail, Path, Solution, Step, max_displacement};
use crate::answer::support::{held, passed_on};
use crate::error::InputError;
use crate::memory;

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

/// The end of a path.
struct End {
    /// The displacements before the last step, length.
    before: DVector<f64>,
    equilibrium: Equilibrium,
    /// The iterations on the path, without those of steps that were divided.
    steps: Vec<Step>,
    /// The number of all contact states that were solved.
    factored: usize,
    halved: usize,
}

/// Follows the path of the load to its end.
///
/// # Errors
/// No equilibrium was found, or nothing restrains the bodies.
pub(super) fn solve(problem: &Problem, watch: &mut dyn FnMut(&Step)) -> Result<Solution, Error> {
    let with_friction = problem.friction > 0.0;
    let per_stage = if with_friction { problem.request.contact.load_steps } else { 1 };
    let end = follow(problem, per_stage, watch)?;
    let path = with_friction.then(|| Path {
        steps: per_stage,
        stages: problem.model.stages.len(),
        halved: end.halved,
    });
    let uniqueness = uniqueness(problem, &end.equilibrium, &end.before);
    Ok(solution(problem, end, path, uniqueness))
}

/// Follows the path in `per_stage` steps a stage.
fn follow(problem: &Problem, per_stage: usize, watch: &mut dyn FnMut(&Step)) -> Result<End, Error> {
    let with_friction = problem.friction > 0.0;
    // Without friction only the whole load counts.
    let stages = if with_friction { problem.model.stages.len() } else { 1 };
    let zero = DVector::zeros(problem.model.dofs());
    let mut point = Point { load: 0.0, u: zero, statuses: None };
    let mut walk = Walk { problem, watch, steps: Vec::new(), factored: 0, halved: 0, closings: 0 };
    let total = stages * per_stage;
    for step in 1.. {
        let to = step as f64 / per_stage as f64;
        let placed = |why| placed(why, to, stages, step == total);
        walk.closings = if with_friction { CLOSINGS } else { 0 };
        let slides = |why| match why {
            Error::Equilibrium(_) if with_friction => {
                let slides = problem.slides(&point.u, [point.load, to]);
                slides.map_or_else(|| placed(why), Error::from)
            }
            other => placed(other),
        };
        let (before, equilibrium) = walk.advance(&point, to, HALVINGS).map_err(slides)?;
        walk.check_memory(step, total)?;
        if step == total {
            let equilibrium = walk.confirmed(&before, to, equilibrium).map_err(placed)?;
            let Walk { steps, factored, halved, .. } = walk;
            return Ok(End { before, equilibrium, steps, factored, halved });
        }
        let Equilibrium { last, .. } = equilibrium;
        point = Point { load: to, u: last.moved.u, statuses: Some(last.statuses) };
    }
    unreachable!("a path has a last step")
}

/// Says on the way to which load no equilibrium was found.
fn placed(why: Error, to: f64, stages: usize, at_the_end: bool) -> Error {
    match why {
        Error::Equilibrium(NoEquilibrium { what }) if !at_the_end || stages > 1 => {
            let what = format!("{what} (on the way to {})", part_of_load(to, stages));
            NoEquilibrium { what }.into()
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

/// The way along a path so far.
struct Walk<'a> {
    problem: &'a Problem<'a>,
    watch: &'a mut dyn FnMut(&Step),
    steps: Vec<Step>,
    factored: usize,
    halved: usize,
    /// How often this step of the path may still be divided where nodes close.
    closings: usize,
}

impl Walk<'_> {
    /// Goes from a point to the load `to`: in two parts where a node closes in between, as friction
    /// counts its slip from there, and in two halves where one step finds no equilibrium. Returns the
    /// displacements before the last step too.
    fn advance(
        &mut self,
        from: &Point,
        to: f64,
        halvings: usize,
    ) -> Result<(DVector<f64>, Equilibrium), Error> {
        let done = self.steps.len();
        let found = self.step(from, to);
        let (middle, halvings) = match &found {
            Ok(Equilibrium { closing: Some(part), .. })
                if self.closings > 0 && (AT_THE_END..1.0 - AT_THE_END).contains(part) =>
            {
                self.closings -= 1;
                (from.load + part * (to - from.load), halvings)
            }
            Err(Error::Equilibrium(_)) if halvings > 0 => {
                self.halved += 1;
                ((from.load + to) / 2.0, halvings - 1)
            }
            _ => return found.map(|equilibrium| (from.u.clone(), equilibrium)),
        };
        let whole = self.steps.split_off(done);
        match self.advance(from, middle, halvings) {
            Ok((_, Equilibrium { last, .. })) => {
                let statuses = Some(last.statuses);
                let point = Point { load: middle, u: last.moved.u, statuses };
                self.advance(&point, to, halvings)
            }
            Err(why) => {
                self.steps.truncate(done);
                self.steps.extend(whole);
                found.or(Err(why)).map(|equilibrium| (from.u.clone(), equilibrium))
            }
        }
    }

    /// Checks now and then that the whole path will fit in memory if it goes on as so far.
    ///
    /// # Errors
    /// Says how much it needs where that is not free.
    fn check_memory(&self, step: usize, total: usize) -> Result<(), InputError> {
        /// How often a long path is checked.
        const TIMES: usize = 64;
        let every = total / TIMES;
        if every < TIMES || !step.is_multiple_of(every) {
            return Ok(());
        }
        let bytes = |steps: usize, iterations: usize| {
            bytes_of_path(self.problem.model, steps as f64, iterations as f64)
        };
        let iterations = self.steps.len();
        let held = HELD * bytes(step, iterations);
        let needed = bytes(total, iterations * total / step) - held;
        let whose = format!("{total} steps of the load with {} iterations each", iterations / step);
        memory::check_bytes(needed, "contact.load_steps", &whose, FEWER_STEPS)
    }

    /// Returns the load at a part of the path, restrained degrees of freedom included, force.
    fn load(&self, part: f64) -> DVector<f64> {
        let model = self.problem.model;
        // Without friction the path is the whole load.
        if self.problem.friction > 0.0 { model.load_after(part) } else { &model.load * part }
    }

    /// Goes to the load `to` in one step.
    fn step(&mut self, from: &Point, to: f64) -> Result<Equilibrium, Error> {
        let load = self.load(to);
        let statuses = from.statuses.as_deref();
        let setting = Setting { load: load.clone(), before: &from.u, statuses, whole: false };
        let found = self.problem.equilibrium(&setting, &mut |place, iteration| {
            self.keep(to, &load, place, iteration);
        })?;
        self.complete(to, &load, &found);
        Ok(found)
    }

    /// Solves the last contact state at the load `to` on the whole bodies.
    fn confirmed(
        &mut self,
        before: &DVector<f64>,
        to: f64,
        found: Equilibrium,
    ) -> Result<Equilibrium, Error> {
        let load = self.load(to);
        let setting = Setting { load: load.clone(), before, statuses: None, whole: true };
        let confirmed = self.problem.confirmed(found, &setting, &mut |place, iteration| {
            self.keep(to, &load, place, iteration);
        })?;
        self.complete(to, &load, &confirmed);
        Ok(confirmed)
    }

    /// Says of the last step what is known of the whole bodies in the equilibrium that it led to.
    fn complete(&mut self, to: f64, load: &DVector<f64>, found: &Equilibrium) {
        let k = self.steps.len();
        if let Some(last) = self.steps.last_mut() {
            let Equilibrium { place, last: iteration, .. } = found;
            *last = step(self.problem, (k, to), load, place, iteration);
        }
    }

    /// Adds an iteration to the steps.
    fn keep(&mut self, to: f64, load: &DVector<f64>, place: &Place, iteration: &Iteration) {
        self.factored += usize::from(!iteration.returned);
        let step = step(self.problem, (self.steps.len() + 1, to), load, place, iteration);
        (self.watch)(&step);
        self.steps.push(step);
    }
}

/// Returns an iteration, the `k`-th, at the part `to` of the path as a step of the solution.
fn step(
    problem: &Problem,
    (k, to): (usize, f64),
    load: &DVector<f64>,
    place: &Place,
    iteration: &Iteration,
) -> Step {
    let Iteration { statuses, constraints, cycle, moved, violation, .. } = iteration;
    let target_force = || {
        let contact = load_of(&place.pairings, &moved.forces, moved.u.len());
        let at_supports = problem.supports.iter().copied();
        let reaction = problem.stiffness.times_of(at_supports, &moved.u) - load - contact;
        passed_on(problem.model, held(problem.model, &problem.model.restrained, &reaction, load))
    };
    let is_known = moved.inside.is_none();
    Step {
        k,
        shape: Arc::clone(&place.shape),
        constraints: constraints.clone(),
        in_contact: statuses.iter().filter(|status| status.is_closed()).count(),
        max_displacement: is_known.then(|| max_displacement(&moved.u)),
        cycle: cycle.clone(),
        target_force: is_known.then(target_force),
        solve_residual: moved.residual,
        detail: Detail::Unilateral(solution::Unilateral {
            load: to,
            statuses: statuses.clone(),
            pairings: Arc::clone(&place.pairings),
            friction: moved.friction.clone(),
            feedback: moved.feedback,
            margin: problem.margin(iteration),
            undetermined: moved.forces.iter().map(|force| force.undetermined).collect(),
            violation: *violation,
        }),
    }
}

/// Returns the solution, which is the end of the path.
fn solution(
    problem: &Problem,
    end: End,
    path: Option<Path>,
    uniqueness: solution::Uniqueness,
) -> Solution {
    let Equilibrium { place, last, shape_change, .. } = end.equilibrium;
    let unseen = problem.unseen(&last);
    let inside = problem.inside(&last);
    Solution {
        request: problem.request.clone(),
        model: problem.model.clone(),
        contact: contact(problem, &place, &last),
        elements: problem.stiffness.states(&last.moved.u),
        factored: end.factored,
        steps: end.steps,
        u: last.moved.u,
        digits: None,
        error_bound: None,
        factors: problem.last_factors().into(),
        equilibrium: Some(solution::Equilibrium { path, uniqueness, unseen, inside, shape_change }),
    }
}

/// Returns the contact surface at the end.
fn contact(problem: &Problem, place: &Place, last: &Iteration) -> Vec<ContactNode> {
    let measured = if problem.is_current() { &*place.shape } else { &problem.model.nodes };
    let open = problem.undetermined(place, last);
    let forces = last
        .moved
        .forces
        .iter()
        .zip(&open)
        .map(|(force, open)| [force.normal, force.tangent].map(|x| (!open).then_some(x)));
    let traction = Traction {
        model: problem.model,
        surfaces: &problem.surfaces,
        measured_in: measured,
        pairings: &place.pairings,
        gaps: &last.gaps,
        in_contact: &last.statuses.iter().map(|status| status.is_closed()).collect::<Vec<_>>(),
        statuses: Some(&last.statuses),
        forces: &forces.collect::<Vec<_>>(),
    };
    traction.nodes()
}
