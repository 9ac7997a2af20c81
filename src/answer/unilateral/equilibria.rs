//! Other equilibria under the same load.

use nalgebra::DVector;

use super::problem::{Equilibrium, Moved, Place, Problem, Setting};
use crate::answer::contact::{Sense, Status};
use crate::answer::solution::{Other, Uniqueness};
use crate::problem::model::NodeId;

/// The force of a node in contact, over the largest of the loads and of those of contact, below which
/// it may as well be open.
const WEAK: f64 = 1e-9;

/// The difference of displacements, over the largest, beyond which two equilibria differ.
const DISTINCT: f64 = 1e-6;

/// The number of equations that may be factored in all to try contact states.
const WORK: usize = 500_000;

/// The number of contact states of a step up to which all of them are tried: those of six nodes under
/// friction, or of twelve without.
const ALL: usize = 4096;

/// A step of the load that was taken.
pub(super) struct Taken {
    /// The part of the path at its end.
    pub(super) to: f64,
    /// The displacements before it, length.
    pub(super) before: DVector<f64>,
    pub(super) place: Place,
    pub(super) statuses: Vec<Status>,
    /// The displacements at its end, length.
    pub(super) u: DVector<f64>,
}

/// Returns what is known of equilibria beside those of the steps that were `taken`, of which the last led to
/// `found`: of small problems in every step, else in the last one alone.
pub(super) fn uniqueness(problem: &Problem, found: &Equilibrium, taken: &[Taken]) -> Uniqueness {
    let last = taken.last().expect("a path has a step");
    if let Some(node) = indifferent(problem, found, &setting(problem, last)) {
        return Uniqueness::Indifferent { node };
    }
    if found.springs.is_some() {
        let setting = setting(problem, last);
        let free = problem.unrestrained_node(&found.place, &found.last.statuses, &setting);
        match (problem.is_current(), free) {
            (true, node) => return Uniqueness::Unknown { node },
            (false, Some(node)) => return Uniqueness::Indifferent { node },
            (false, None) => (),
        }
    }
    if problem.friction == 0.0 {
        return Uniqueness::Unique;
    }
    let every: Option<Vec<Vec<Vec<Status>>>> =
        taken.iter().map(|step| problem.every(&step.place)).collect();
    let number = |every: &Vec<Vec<Vec<Status>>>| every.iter().map(Vec::len).sum::<usize>();
    let all = every.filter(|every| number(every) <= most(problem));
    let (steps, states) = match &all {
        Some(states) => (taken, states.clone()),
        None => {
            let mut states = problem.neighbours(last);
            states.truncate(most(problem));
            (std::slice::from_ref(last), vec![states])
        }
    };
    let others = steps.iter().zip(&states).flat_map(|(step, states)| others(problem, step, states));
    Uniqueness::Tried {
        others: others.collect(),
        states: number(&states),
        steps: steps.len(),
        all: all.is_some(),
        last_only: steps[0].before.amax() > 0.0,
    }
}

/// Returns whether all contact states of a path of so many steps can be tried.
pub(super) fn are_few(problem: &Problem, place: &Place, steps: usize) -> bool {
    problem.every(place).is_some_and(|all| all.len() * steps <= most(problem))
}

fn setting<'a>(problem: &Problem, step: &'a Taken) -> Setting<'a> {
    let load = problem.load(step.to);
    Setting { load, before: &step.before, statuses: None, whole: false }
}

/// Returns the equilibria of a step among some states, each once, other than the one that it led to.
fn others(problem: &Problem, step: &Taken, states: &[Vec<Status>]) -> Vec<Other> {
    let setting = setting(problem, step);
    let scale = step.u.amax();
    let mut others: Vec<(DVector<f64>, Other)> = Vec::new();
    for statuses in states {
        let Some(moved) = problem.try_statuses(&step.place, statuses, &setting) else { continue };
        let apart = |u: &DVector<f64>| (&moved.u - u).amax();
        let change = apart(&step.u);
        if change > DISTINCT * scale && others.iter().all(|(u, _)| apart(u) > DISTINCT * scale) {
            others.push((moved.u, other(problem, statuses, step.to, change)));
        }
    }
    others.into_iter().map(|(_, other)| other).collect()
}

/// Returns the number of contact states that are tried at most: fewer of a large model.
fn most(problem: &Problem) -> usize {
    1 + WORK / problem.model.dofs()
}

/// Returns a node that can move without work: with the contacts that carry nothing opened, nothing
/// restrains it.
fn indifferent(problem: &Problem, found: &Equilibrium, setting: &Setting) -> Option<NodeId> {
    let Moved { forces, .. } = &found.last.moved;
    let largest = forces.iter().map(|f| f.normal).fold(setting.load.amax(), f64::max);
    let mut statuses = found.last.statuses.clone();
    let carries_nothing = |i: usize| forces[i].normal <= WEAK * largest;
    let weak: Vec<usize> =
        (0..statuses.len()).filter(|&i| statuses[i].is_closed() && carries_nothing(i)).collect();
    if weak.is_empty() {
        return None;
    }
    weak.into_iter().for_each(|i| statuses[i] = Status::Open);
    problem.unrestrained_node(&found.place, &statuses, setting)
}

fn other(problem: &Problem, statuses: &[Status], load: f64, change: f64) -> Other {
    let nodes = |wanted: fn(&Status) -> bool| {
        let entries = statuses.iter().zip(problem.surfaces.nodes());
        entries.filter(|(status, _)| wanted(status)).map(|(_, node)| *node).collect()
    };
    Other {
        load,
        stick: nodes(|status| *status == Status::Stick),
        slip: nodes(|status| matches!(status, Status::Slip(_))),
        change,
    }
}

impl Problem<'_> {
    /// Looks for statuses in equilibrium among all that there are; None where there is none, and where
    /// there are too many to be tried.
    pub(super) fn enumerated(&self, place: &Place, setting: &Setting) -> Option<Vec<Status>> {
        let all = self.every(place).filter(|all| all.len() <= most(self))?;
        all.into_iter().find(|statuses| self.try_statuses(place, statuses, setting).is_some())
    }

    /// Returns every contact state in a place; None of more than [`ALL`].
    fn every(&self, place: &Place) -> Option<Vec<Vec<Status>>> {
        let entries = 0..place.pairings.len();
        let choices: Vec<Vec<Status>> = entries.map(|i| self.choices(place, i)).collect();
        let number = choices.iter().try_fold(1_usize, |n, c| n.checked_mul(c.len()));
        number.filter(|n| *n <= ALL)?;
        let longer = |states: Vec<Vec<Status>>, choices: &Vec<Status>| {
            let with = |state: &Vec<Status>| {
                choices.iter().map(|c| [&state[..], &[*c]].concat()).collect::<Vec<_>>()
            };
            states.iter().flat_map(with).collect()
        };
        Some(choices.iter().fold(vec![Vec::new()], longer))
    }

    /// Returns the states that differ from that of a step in one entry, of those in contact or beside one.
    fn neighbours(&self, step: &Taken) -> Vec<Vec<Status>> {
        let Taken { place, statuses, .. } = step;
        let closed = |i: usize| statuses.get(i).is_some_and(|status| status.is_closed());
        let near = |i: &usize| closed(*i) || closed(i + 1) || *i > 0 && closed(i - 1);
        let with = |i: usize| {
            let other =
                self.choices(place, i).into_iter().filter(move |other| *other != statuses[i]);
            other.map(move |other| {
                let mut state = statuses.clone();
                state[i] = other;
                state
            })
        };
        (0..statuses.len()).filter(near).flat_map(with).collect()
    }

    /// Returns the statuses that an entry can have.
    fn choices(&self, place: &Place, i: usize) -> Vec<Status> {
        let slips = [Status::Slip(Sense::Forward), Status::Slip(Sense::Backward)];
        match (&place.pairings[i], self.closing(place, i)) {
            (None, _) => vec![Status::Open],
            (_, Status::Stick) if self.friction.is_finite() => {
                [&[Status::Open, Status::Stick][..], &slips].concat()
            }
            (_, closed) => vec![Status::Open, closed],
        }
    }
}
