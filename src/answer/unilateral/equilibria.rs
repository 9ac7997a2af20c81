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
const WORK: usize = 2_000_000;

/// The number of contact states up to which all of them are tried.
const ALL: usize = 256;

/// Returns what is known of equilibria beside the one that was found in a step that started from
/// `before`.
pub(super) fn uniqueness(
    problem: &Problem,
    found: &Equilibrium,
    before: &DVector<f64>,
) -> Uniqueness {
    let load = problem.model.load.clone();
    let setting = Setting { load, before, statuses: None, whole: false };
    if let Some(node) = indifferent(problem, found, &setting) {
        return Uniqueness::Indifferent { node };
    }
    if problem.friction == 0.0 {
        return Uniqueness::Unique;
    }
    let place = &found.place;
    let choices: Vec<Vec<Status>> =
        (0..found.last.statuses.len()).map(|i| problem.choices(place, i)).collect();
    let number = choices.iter().try_fold(1_usize, |n, c| n.checked_mul(c.len()));
    let all = number.is_some_and(|n| n <= ALL);
    let mut states = if all { every(&choices) } else { neighbours(&found.last.statuses, &choices) };
    let all = all && states.len() <= most(problem);
    states.truncate(most(problem));
    let scale = found.last.moved.u.amax();
    let mut others: Vec<(DVector<f64>, Other)> = Vec::new();
    for statuses in &states {
        let Some(moved) = problem.try_statuses(place, statuses, &setting) else { continue };
        let apart = |u: &DVector<f64>| (&moved.u - u).amax();
        let is_new = apart(&found.last.moved.u) > DISTINCT * scale
            && others.iter().all(|(u, _)| apart(u) > DISTINCT * scale);
        if is_new {
            let change = apart(&found.last.moved.u);
            others.push((moved.u, other(problem, statuses, change)));
        }
    }
    let others = others.into_iter().map(|(_, other)| other).collect();
    Uniqueness::Tried { states: states.len(), all, others }
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

/// Returns every combination of choices.
fn every(choices: &[Vec<Status>]) -> Vec<Vec<Status>> {
    choices.iter().fold(vec![Vec::new()], |states, choices| {
        let longer = |state: &Vec<Status>| {
            choices.iter().map(|c| [&state[..], &[*c]].concat()).collect::<Vec<_>>()
        };
        states.iter().flat_map(longer).collect()
    })
}

/// Returns the states that differ from `found` in one entry, of those in contact or beside one.
fn neighbours(found: &[Status], choices: &[Vec<Status>]) -> Vec<Vec<Status>> {
    let closed = |i: usize| found.get(i).is_some_and(|status| status.is_closed());
    let near = |i: &usize| closed(*i) || closed(i + 1) || *i > 0 && closed(i - 1);
    let entries = (0..found.len()).filter(near);
    entries
        .flat_map(|i| {
            let other = choices[i].iter().filter(move |choice| **choice != found[i]);
            other.map(move |choice| {
                let mut state = found.to_vec();
                state[i] = *choice;
                state
            })
        })
        .collect()
}

fn other(problem: &Problem, statuses: &[Status], change: f64) -> Other {
    let nodes = |wanted: fn(&Status) -> bool| {
        let entries = statuses.iter().zip(problem.surfaces.nodes());
        entries.filter(|(status, _)| wanted(status)).map(|(_, node)| *node).collect()
    };
    Other {
        stick: nodes(|status| *status == Status::Stick),
        slip: nodes(|status| matches!(status, Status::Slip(_))),
        change,
    }
}

impl Problem<'_> {
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
