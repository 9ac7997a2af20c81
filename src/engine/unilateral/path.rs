//! The path of the load: stage by stage, in equal steps, each of which starts from the one before.

use std::sync::Arc;

use nalgebra::DVector;

use super::equilibria::{TakenStep, setting, uniqueness};
use super::problem::{Configuration, Equilibrium, Iteration, Problem, Setting, Watch};
use super::unrestrained::part_of_load;
use crate::contact::{
    ContactForce, ContactNode, NodeEnd, ROUNDING_OF_A_FORCE, Status, Watched, load_of,
};
use crate::error::{Cause, Error, NoEquilibrium};
use crate::reactions::{reactions, support_force, transmitted_force};
use crate::request::Request;
use crate::solution::{
    self, Detail, Overlap, Path, Solution, Start, Step, last_under_each_load, max_displacement,
};

/// How often a step without an equilibrium is halved.
const HALVINGS: usize = 6;

/// How often a step of the path is divided where nodes close in it.
const CLOSINGS: usize = 16;

/// The part of a step, at either end, within which the first node closes that does not divide it; later
/// ones do not then either.
const AT_THE_END: f64 = 1e-3;

/// The part of the first stage that is a step of its own where friction alone holds bodies that overlap: so
/// small that hardly anything slips in it, and its forces are far above rounding.
const FIRST: f64 = 1e-3;

/// A point of the path: what the next step starts from.
#[derive(Clone)]
pub(super) struct Point {
    /// The part of the path that was applied; whole numbers end stages.
    pub(super) load: f64,
    /// The displacements, length.
    pub(super) u: DVector<f64>,
    /// The statuses; None at the beginning.
    pub(super) statuses: Option<Vec<Status>>,
}

impl Point {
    fn after(load: f64, Equilibrium { last, .. }: &Equilibrium) -> Self {
        Point { load, u: last.solution.u.clone(), statuses: Some(last.statuses.clone()) }
    }
}

/// Follows the path of the load to its end: under friction in equal steps of each stage, otherwise in one;
/// `watch` is called after each iteration.
///
/// # Errors
/// No equilibrium was found, or nothing restrains the bodies.
pub(crate) fn unilateral(
    request: &Request,
    watch: &mut dyn FnMut(&Step),
) -> Result<Solution, Error> {
    let model = request.model()?;
    let problem = &Problem::new(request, &model)?;
    problem.turns_nowhere()?;
    let with_friction = problem.friction > 0.0;
    let stages = problem.stages();
    let (steps, halvings) =
        if with_friction { (request.contact.load_steps, HALVINGS) } else { (1, 0) };
    let keeps_all =
        with_friction && problem.number_of_states(&problem.at_rest(), stages * steps).is_some();
    let (factored, halved) = (0, 0);
    let mut run = PathSoFar {
        problem,
        watch,
        steps: Vec::new(),
        factored,
        halved,
        keeps_all,
        taken: Vec::new(),
    };
    let (start, from) = run.start()?;
    let loads = (1..=stages * steps).map(|step| step as f64 / steps as f64);
    let end = run.follow(from, loads, halvings)?;
    let end = run.confirmed(stages as f64, end)?;
    let path = with_friction.then(|| Path {
        steps,
        stages,
        halved: run.halved,
        start,
        changes: changes(&run.steps),
    });
    Ok(run.solution(end, path))
}

/// Returns the number of steps in which a node that was closed has another status at the end.
fn changes(steps: &[Step]) -> usize {
    let ends: Vec<&Step> = last_under_each_load(steps).into_iter().map(|i| &steps[i]).collect();
    let changed = |pair: &&[&Step]| {
        let mut statuses = pair[0].statuses.iter().zip(&pair[1].statuses);
        statuses.any(|(before, after)| before.is_closed() && before != after)
    };
    ends.windows(2).filter(changed).count()
}

/// What was found along the path so far.
struct PathSoFar<'a> {
    problem: &'a Problem<'a>,
    watch: &'a mut dyn FnMut(&Step),
    /// The iterations on the path, without those of steps that were divided.
    steps: Vec<Step>,
    /// The number of all contact states that were solved.
    factored: usize,
    /// The number of steps that were halved.
    halved: usize,
    /// Whether all steps are kept, or the last one alone.
    keeps_all: bool,
    taken: Vec<TakenStep>,
}

impl<'a> PathSoFar<'a> {
    /// Returns where the path starts. Under friction nodes that overlap come to touch before any load, as
    /// they would slip with its first part otherwise: the bodies as rigid ones where nothing presses them
    /// together, else in a step of its own.
    ///
    /// # Errors
    /// They come to touch in several ways.
    fn start(&mut self) -> Result<(Start, Point), Error> {
        let problem = self.problem;
        let config = problem.at_rest();
        let rest = Point { load: 0.0, u: DVector::zeros(problem.model.dofs()), statuses: None };
        if problem.friction == 0.0 {
            return Ok((Start::Held, rest));
        }
        if !problem.overlaps() {
            let held = problem.is_held_initially(&config);
            return Ok((if held { Start::Held } else { Start::Loose }, rest));
        }
        match problem.released() {
            Ok(Some((start, u))) => Ok((start, Point { u, ..rest })),
            Ok(None) => match self.step(&rest, 0.0, Problem::equilibrium) {
                Ok(closed) => {
                    self.take(&rest, 0.0, &closed);
                    Ok((Start::Closed, Point::after(0.0, &closed)))
                }
                Err(Error::Equilibrium(_)) => {
                    self.steps.clear();
                    Ok((Start::Overlapping, rest))
                }
                Err(other) => Err(other),
            },
            Err(several) => {
                // Where nothing holds the load, the start does not matter.
                let no_end = (1..=problem.stages())
                    .find_map(|to| problem.slides(&rest.u, [to - 1, to].map(|stage| stage as f64)));
                if let Some(none) = no_end {
                    return Err(none.into());
                }
                // In the initial geometry all contact states of a first small step say whether there is one
                // way alone.
                match self.step(&rest, FIRST, Problem::equilibrium) {
                    Ok(held) if !problem.is_current() => {
                        self.take(&rest, FIRST, &held);
                        let is_only = uniqueness(problem, &held, &self.taken).is_proven();
                        let pressed = (Start::Pressed, Point::after(FIRST, &held));
                        is_only.then_some(pressed).ok_or(several.into())
                    }
                    Ok(_) | Err(Error::Equilibrium(_)) => Err(several.into()),
                    Err(other) => Err(other),
                }
            }
        }
    }

    /// Follows the path from a point to each load in turn, by a step that may be halved so often; returns the
    /// equilibrium at its end. Where no part of a step leads to its end, the whole of it is taken on springs.
    fn follow(
        &mut self,
        mut from: Point,
        loads: impl Iterator<Item = f64>,
        halvings: usize,
    ) -> Result<Equilibrium, Error> {
        let mut end = None;
        for to in loads {
            let found = match self.reach(&from, to, halvings, &mut { CLOSINGS }) {
                Ok(found) => found,
                Err(why) => {
                    let found = self.on_springs(&from, to, why)?;
                    self.take(&from, to, &found);
                    found
                }
            };
            self.problem.in_range([&from.u, &found.last.solution.u], [from.load, to])?;
            from = Point::after(to, &found);
            end = Some(found);
        }
        Ok(end.expect("a path has a step"))
    }

    /// Goes to a load: in two parts where a node closes in between, as friction counts its slip from there,
    /// and in two halves where no equilibrium is found. Whatever stops the first part, the whole way counts
    /// if it was found; the second one does not go back behind the first.
    ///
    /// Source: backward Euler with steps at events, as of E. Hairer, G. Wanner, *Solving Ordinary
    /// Differential Equations II* (1996).
    fn reach(
        &mut self,
        from: &Point,
        to: f64,
        mut halvings: usize,
        closings: &mut usize,
    ) -> Result<Equilibrium, Error> {
        let mut at = from.clone();
        loop {
            let before = [self.steps.len(), self.taken.len()];
            let found = self.step(&at, to, Problem::equilibrium);
            let part = match &found {
                Ok(Equilibrium { closing, .. }) => closing.filter(|part| {
                    let is_inside = (AT_THE_END..1.0 - AT_THE_END).contains(part);
                    self.problem.friction > 0.0 && *closings > 0 && is_inside
                }),
                Err(Error::Equilibrium(why)) if why.cause == Cause::NotFound && halvings > 0 => {
                    Some(0.5)
                }
                Err(_) => None,
            };
            let Some(part) = part else {
                return found.inspect(|found| self.take(&at, to, found));
            };
            match found {
                Ok(_) => *closings -= 1,
                Err(_) => (self.halved, halvings) = (self.halved + 1, halvings - 1),
            }
            let iterations = self.steps.split_off(before[0]);
            let middle = at.load + part * (to - at.load);
            match self.reach(&at, middle, halvings, closings) {
                Ok(first) => at = Point::after(middle, &first),
                Err(why) => {
                    self.steps.truncate(before[0]);
                    self.steps.extend(iterations);
                    self.taken.truncate(before[1]);
                    return found.map_err(|_| why).inspect(|found| self.take(&at, to, found));
                }
            }
        }
    }

    /// Takes a step of the path on springs, as no equilibrium was found without.
    ///
    /// # Errors
    /// None was found either, or it is known that there is none: under friction, whether the bodies slide.
    fn on_springs(&mut self, from: &Point, to: f64, why: Error) -> Result<Equilibrium, Error> {
        self.taken.retain(|part| part.to.load <= from.load);
        let why = match why {
            Error::Equilibrium(why) if why.cause == Cause::NotFound => {
                match self.step(from, to, |problem, setting, watch| {
                    problem.on_springs(setting, &why.what, watch)
                }) {
                    Ok(found) => return Ok(found),
                    Err(more) => more,
                }
            }
            why => why,
        };
        let may_slide = self.problem.friction > 0.0 && matches!(why, Error::Equilibrium(_));
        let slides = may_slide.then(|| self.problem.slides(&from.u, [from.load, to])).flatten();
        Err(slides.map_or_else(|| self.with_load(why, to), Error::from))
    }

    /// Adds to an error on the way to which load no equilibrium was found.
    fn with_load(&self, why: Error, to: f64) -> Error {
        let stages = self.problem.stages();
        match why {
            Error::Equilibrium(NoEquilibrium { cause, what }) if stages > 1 || to < 1.0 => {
                let what = format!("{what} (on the way to {})", part_of_load(to, stages));
                NoEquilibrium { cause, what }.into()
            }
            why => why,
        }
    }

    /// Keeps that a step was taken.
    fn take(&mut self, from: &Point, to: f64, found: &Equilibrium) {
        if !self.keeps_all {
            self.taken.clear();
        }
        let (to, config) = (Point::after(to, found), found.config.clone());
        self.taken.push(TakenStep { from: from.clone(), to, config });
    }

    /// Goes to the load `to` in one step by a search.
    fn step(
        &mut self,
        from: &Point,
        to: f64,
        search: impl Fn(&Problem<'a>, &Setting, &mut Watch) -> Result<Equilibrium, Error>,
    ) -> Result<Equilibrium, Error> {
        let setting = self.problem.setting(to, &from.u, from.statuses.as_deref());
        search(self.problem, &setting, &mut |config, iteration| self.keep(to, config, iteration))
    }

    /// Solves the last contact state, at the load `to`, on the whole bodies.
    fn confirmed(&mut self, to: f64, found: Equilibrium) -> Result<Equilibrium, Error> {
        let last = self.taken.pop().expect("a path has a step");
        let setting = Setting { whole: true, ..setting(self.problem, &last) };
        let end = self.problem.confirmed(found, &setting, &mut |config, iteration| {
            self.keep(to, config, iteration);
        });
        let end = end.map_err(|why| self.with_load(why, to))?;
        let k = self.steps.len();
        if let Some(last) = self.steps.last_mut() {
            *last = step(self.problem, (k, to), &end.config, &end.last);
        }
        self.take(&last.from, to, &end);
        Ok(end)
    }

    /// Adds an iteration to the steps.
    fn keep(&mut self, to: f64, config: &Configuration, iteration: &Iteration) {
        self.factored += usize::from(!iteration.returned);
        let step = step(self.problem, (self.steps.len() + 1, to), config, iteration);
        (self.watch)(&step);
        self.steps.push(step);
    }

    /// Returns the solution, which is the end of the path.
    fn solution(self, end: Equilibrium, path: Option<Path>) -> Solution {
        let PathSoFar { problem, steps, factored, taken, .. } = self;
        let uniqueness = uniqueness(problem, &end, &taken);
        let setting = setting(problem, taken.last().expect("a path has a step"));
        let nearest = problem.search(&end.config, &setting).nearest_decision(&end.last);
        let Equilibrium { config, last, shape_change, springs, .. } = end;
        let elements = problem.stiffness.states(&last.solution.u);
        let strain = elements.iter().map(|state| state.von_mises_strain).fold(0.0, f64::max);
        let facets = problem.coarse_facets(&last, strain);
        let found = problem.inside(&config, &last);
        let deepest = |watched: Watched| {
            let deepest = found.iter().find(|inside| inside.watched == watched)?;
            Some((deepest.node, deepest.depth))
        };
        let [unseen, inside] = [Watched::Target, Watched::Contact].map(deepest);
        let of_contact = load_of(&config.pairings, &last.solution.forces, last.solution.u.len());
        let force = problem.stiffness.times(&last.solution.u) - &setting.load - of_contact;
        Solution {
            request: problem.request.clone(),
            model: problem.model.clone(),
            contact: contact(problem, &config, &last),
            reactions: reactions(problem.model, force),
            elements,
            factored,
            steps,
            digits: None,
            overlap: Overlap::of(&found),
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
    config: &Configuration,
    iteration: &Iteration,
) -> Step {
    let Iteration { statuses, constraints, cycle, solution, violation, .. } = iteration;
    let load = problem.load(to);
    let contact = load_of(&config.pairings, &solution.forces, solution.u.len());
    let at_supports = problem.supports.iter().copied();
    let reaction = problem.stiffness.times_of(at_supports, &solution.u) - &load - contact;
    let support = support_force(problem.model, &reaction, &load);
    let target_force = transmitted_force(problem.model, support);
    Step {
        k,
        shape: Arc::clone(&config.shape),
        statuses: statuses.clone(),
        constraints: constraints.clone(),
        in_contact: statuses.iter().filter(|status| status.is_closed()).count(),
        max_displacement: max_displacement(&solution.u),
        cycle: cycle.clone(),
        target_force,
        solve_residual: solution.residual,
        contact_residual: *violation,
        contact_residual_step: *violation,
        detail: Detail::Unilateral(solution::Unilateral {
            load: to,
            pairings: Arc::clone(&config.pairings),
            friction_needed: friction_needed(&solution.forces),
            friction: solution.friction.clone(),
            springs: iteration.springs,
        }),
    }
}

/// Returns the largest shear over pressure of a node that is pressed by more than rounding.
fn friction_needed(forces: &[ContactForce]) -> Option<f64> {
    let known = forces.iter().filter(|force| !force.undetermined);
    let least = ROUNDING_OF_A_FORCE * known.clone().fold(0.0, |most, f| f.normal.abs().max(most));
    let pressed = known.filter(|force| force.normal > least);
    pressed.map(|force| force.tangent.abs() / force.normal).reduce(f64::max)
}

/// Returns the contact surface at the end.
fn contact(problem: &Problem, config: &Configuration, last: &Iteration) -> Vec<ContactNode> {
    let measured = if problem.is_current() { &*config.shape } else { &problem.model.nodes };
    let open = problem.undetermined(config, last);
    let u = &last.solution.u;
    problem.surfaces.nodes_at_end((problem.model, u), (measured, &config.pairings), |i, pairing| {
        let force = ContactForce { undetermined: open[i], ..last.solution.forces[i] };
        let status = last.statuses[i];
        NodeEnd {
            gap: last.gaps[i].unwrap_or(pairing.gap),
            in_contact: status.is_closed(),
            status: Some(status),
            force: force.known(),
        }
    })
}
