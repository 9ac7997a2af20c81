//! The path of the load: stage by stage, in equal steps, each of which starts from the one before.

use std::sync::Arc;

use nalgebra::DVector;

use super::equilibria::{Taken, uniqueness};
use super::forces::load_of;
use super::problem::{Equilibrium, Iteration, Place, Problem, Setting, Watch};
use crate::contact::{ContactNode, Status, Traction};
use crate::error::{Cause, Error, NoEquilibrium};
use crate::memory::{FEWER_STEPS, HELD, bytes_of_path};
use crate::solution::{
    self, Detail, Path, Solution, Start, Step, last_under_each_load, max_displacement,
};
use crate::support::{held, passed_on};
use base::error::InputError;
use base::memory;

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
        Point { load, u: last.moved.u, statuses: Some(last.statuses) }
    }
}

/// The end of a path.
struct End {
    equilibrium: Equilibrium,
    /// The last step of the load, and of small problems all before it.
    taken: Vec<Taken>,
    /// The iterations on the path, without those of steps that were divided.
    steps: Vec<Step>,
    /// The number of all contact states that were solved.
    factored: usize,
    halved: usize,
    start: Start,
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
        start: end.start,
        changes: changes(&end.steps),
    });
    let uniqueness = uniqueness(problem, &end.equilibrium, &end.taken);
    Ok(solution(problem, end, path, uniqueness))
}

/// Follows the path in `per_stage` steps a stage. Under friction nodes that overlap at the start close in a
/// step of their own, before any load: they would slip with its first part otherwise.
fn follow(problem: &Problem, per_stage: usize, watch: &mut dyn FnMut(&Step)) -> Result<End, Error> {
    let with_friction = problem.friction > 0.0;
    // Without friction only the whole load counts.
    let stages = if with_friction { problem.model.stages.len() } else { 1 };
    let zero = DVector::zeros(problem.model.dofs());
    let mut point = Point { load: 0.0, u: zero, statuses: None };
    let total = stages * per_stage;
    let mut walk = Walk::new(problem, watch);
    if with_friction {
        let place = problem.place(&point.u);
        walk.keeps_all = problem.can_enumerate(&place, total);
        let closed = problem.overlaps(&place).then(|| walk.advance(&point, 0.0, 0));
        (walk.start, point) = match closed {
            Some(Ok(closed)) => (Start::Closed, Point::after(0.0, closed)),
            Some(Err(_)) => {
                walk.steps.clear();
                (Start::Overlapping, point)
            }
            None if problem.is_held(&place) => (Start::Held, point),
            None => (Start::Loose, point),
        };
    }
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
        let halvings = if with_friction { HALVINGS } else { 0 };
        let equilibrium = match walk.advance(&point, to, halvings) {
            Err(Error::Equilibrium(why)) if why.cause == Cause::NotFound => {
                let on_springs = walk.step(&point, to, Problem::on_springs);
                let found = on_springs.map_err(|more| more.told(&format!("{}; ", why.what)));
                found.inspect(|found| walk.take(&point, to, found))
            }
            found => found,
        };
        let equilibrium = equilibrium.map_err(slides)?;
        problem.in_range([&point.u, &equilibrium.last.moved.u], [point.load, to])?;
        walk.check_memory(step, total)?;
        if step == total {
            return walk.confirmed(to, equilibrium).map_err(placed);
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

/// Says on the way to which load no equilibrium was found.
fn placed(why: Error, to: f64, stages: usize, at_the_end: bool) -> Error {
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

/// The way along a path so far.
struct Walk<'a> {
    problem: &'a Problem<'a>,
    watch: &'a mut dyn FnMut(&Step),
    steps: Vec<Step>,
    factored: usize,
    halved: usize,
    /// How often this step of the path may still be divided where nodes close.
    closings: usize,
    start: Start,
    /// Whether all steps are kept, or the last one alone.
    keeps_all: bool,
    taken: Vec<Taken>,
}

impl<'a> Walk<'a> {
    fn new(problem: &'a Problem<'a>, watch: &'a mut dyn FnMut(&Step)) -> Self {
        Walk {
            problem,
            watch,
            steps: Vec::new(),
            factored: 0,
            halved: 0,
            closings: 0,
            start: Start::Held,
            keeps_all: false,
            taken: Vec::new(),
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
        let Equilibrium { place, last, .. } = found;
        self.taken.push(Taken {
            to,
            before: from.u.clone(),
            place: place.clone(),
            statuses: last.statuses.clone(),
            u: last.moved.u.clone(),
        });
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

    /// Goes to the load `to` in one step by a search.
    fn step(&mut self, from: &Point, to: f64, search: Search<'a>) -> Result<Equilibrium, Error> {
        let load = self.problem.load(to);
        let statuses = from.statuses.as_deref();
        let setting = Setting { load: load.clone(), before: &from.u, statuses, whole: false };
        let found = search(self.problem, &setting, &mut |place, iteration| {
            self.keep(to, &load, place, iteration);
        })?;
        self.complete(to, &load, &found);
        Ok(found)
    }

    /// Solves the last contact state, at the load `to`, on the whole bodies, and ends the path with it.
    fn confirmed(mut self, to: f64, found: Equilibrium) -> Result<End, Error> {
        let load = self.problem.load(to);
        let mut last = self.taken.pop().expect("a path has a step");
        let setting =
            Setting { load: load.clone(), before: &last.before, statuses: None, whole: true };
        let equilibrium = self.problem.confirmed(found, &setting, &mut |place, iteration| {
            self.keep(to, &load, place, iteration);
        })?;
        self.complete(to, &load, &equilibrium);
        last.place = equilibrium.place.clone();
        last.statuses = equilibrium.last.statuses.clone();
        last.u = equilibrium.last.moved.u.clone();
        self.taken.push(last);
        let Walk { steps, factored, halved, start, taken, .. } = self;
        Ok(End { equilibrium, taken, steps, factored, halved, start })
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
            springs: iteration.springs,
            choice: iteration.choice,
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
    let Equilibrium { place, last, shape_change, springs, .. } = end.equilibrium;
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
        kept: problem.bodies.kept(),
        equilibrium: Some(solution::Equilibrium {
            path,
            uniqueness,
            unseen,
            inside,
            shape_change,
            springs,
        }),
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
