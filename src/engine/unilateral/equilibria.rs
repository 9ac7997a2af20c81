//! Other equilibria under the same load.

use nalgebra::DVector;

use super::condensed::Condensed;
use super::path::Point;
use super::problem::{Configuration, Equilibrium, Problem, Setting, StateSearch, StateSolution};
use super::rigid::BALANCED;
use crate::contact::{Sense, Status};
use crate::solution::{APART, OtherEquilibrium, Uniqueness};
use problem::model::NodeId;

/// The number of equations that may be factored in all to try the neighbours of a contact state.
const WORK: usize = 500_000;

/// The number of contact states up to which all of them are tried, on the contact nodes alone: those of ten
/// nodes under friction, in about a second.
const ALL: usize = 1 << 20;

/// Contact states that were tried.
struct States {
    number: usize,
    /// Those among which are all in equilibrium.
    worth: Vec<Vec<Status>>,
}

/// A step of the load that was taken.
pub(super) struct TakenStep {
    pub(super) from: Point,
    pub(super) to: Point,
    /// The place in which contact was measured at its end.
    pub(super) config: Configuration,
}

/// Returns what is known of equilibria beside those of the steps that were `taken`, of which the last led to
/// `found`: of small problems in every step, else in the last one alone.
pub(super) fn uniqueness(
    problem: &Problem,
    found: &Equilibrium,
    taken: &[TakenStep],
) -> Uniqueness {
    let last = taken.last().expect("a path has a step");
    if let Some(node) = indifferent(problem, found, &setting(problem, last)) {
        return Uniqueness::Indifferent { node };
    }
    if found.springs.is_some() {
        let setting = setting(problem, last);
        let free = problem.search(&found.config, &setting).unrestrained_node(&found.last.statuses);
        match (problem.is_current(), free) {
            (true, node) => return Uniqueness::Unknown { node },
            (false, Some(node)) => return Uniqueness::Indifferent { node },
            (false, None) => (),
        }
    }
    if problem.friction == 0.0 {
        // In the current geometry another shape may have an equilibrium too.
        let is_convex = !(problem.is_current() && problem.model.has_contact());
        return if is_convex { Uniqueness::Unique } else { Uniqueness::Unknown { node: None } };
    }
    let every = |steps: &[TakenStep]| -> Option<Vec<States>> {
        let of_step = |step: &TakenStep| {
            let number = problem.number_of_states(&step.config, steps.len())?;
            let setting = setting(problem, step);
            let search = problem.search(&step.config, &setting);
            Some(States { number, worth: Condensed::new(&search)?.equilibria() })
        };
        steps.iter().map(of_step).collect()
    };
    let last_alone = std::slice::from_ref(last);
    let (steps, all, states) = if let Some(states) = every(taken) {
        (taken, true, states)
    } else if let Some(states) = every(last_alone) {
        (last_alone, true, states)
    } else {
        (last_alone, false, vec![problem.neighbours(last)])
    };
    let number = states.iter().map(|states| states.number).sum();
    let others = steps.iter().zip(&states);
    let others = others.flat_map(|(step, states)| problem.others(step, &states.worth)).collect();
    let last_only = steps[0].from.statuses.is_some();
    Uniqueness::Tried { states: number, steps: steps.len(), all, last_only, others }
}

/// Returns the setting of a step that was taken.
pub(super) fn setting<'a>(problem: &Problem, step: &'a TakenStep) -> Setting<'a> {
    problem.setting(step.to.load, &step.from.u, None)
}

/// Returns a node that can move without work: with the contacts that carry nothing opened, nothing
/// restrains it.
fn indifferent(problem: &Problem, found: &Equilibrium, setting: &Setting) -> Option<NodeId> {
    let StateSolution { forces, .. } = &found.last.solution;
    let largest = forces.iter().map(|f| f.normal).fold(setting.load.amax(), f64::max);
    let mut statuses = found.last.statuses.clone();
    let carries_nothing = |i: usize| forces[i].normal <= BALANCED * largest;
    let weak: Vec<usize> =
        (0..statuses.len()).filter(|&i| statuses[i].is_closed() && carries_nothing(i)).collect();
    if weak.is_empty() {
        return None;
    }
    weak.into_iter().for_each(|i| statuses[i] = Status::Open);
    problem.search(&found.config, setting).unrestrained_node(&statuses)
}

impl StateSearch<'_> {
    /// Looks for statuses in equilibrium on the contact nodes alone: by pivots, then among all that there
    /// are; None where there are none, and where there are too many to be tried.
    pub(super) fn condensed(&self) -> Option<Vec<Status>> {
        let holds = |statuses: &Vec<Status>| self.try_statuses(statuses).is_some();
        let condensed = Condensed::new(self)?;
        condensed.by_pivots().filter(holds).or_else(|| {
            self.problem.number_of_states(self.config, 1)?;
            condensed.equilibria().into_iter().find(holds)
        })
    }
}

impl Problem<'_> {
    /// Returns the number of all contact states in a place; None where those of so many steps are too many to
    /// be tried.
    pub(super) fn number_of_states(&self, config: &Configuration, steps: usize) -> Option<usize> {
        let mut choices = (0..config.pairings.len()).map(|i| self.choices(config, i).len());
        choices.try_fold(1_usize, usize::checked_mul).filter(|number| *number <= ALL / steps)
    }

    /// Returns the equilibria of a step among some states, each once, other than the one that it led to.
    fn others(&self, step: &TakenStep, states: &[Vec<Status>]) -> Vec<OtherEquilibrium> {
        let setting = setting(self, step);
        let TakenStep { config, to, .. } = step;
        let scale = to.u.amax();
        let mut others: Vec<(DVector<f64>, OtherEquilibrium)> = Vec::new();
        for statuses in states {
            let Some(solution) = self.search(config, &setting).try_statuses(statuses) else {
                continue;
            };
            let apart = |u: &DVector<f64>| (&solution.u - u).amax();
            let change = apart(&to.u);
            if change > APART * scale && others.iter().all(|(u, _)| apart(u) > APART * scale) {
                let nodes = |wanted: fn(&Status) -> bool| {
                    let entries = statuses.iter().zip(&self.model.contact.nodes);
                    entries.filter(|(status, _)| wanted(status)).map(|(_, node)| *node).collect()
                };
                let stick = nodes(|status| *status == Status::Stick);
                let slip = nodes(|status| matches!(status, Status::Slip(_)));
                others.push((solution.u, OtherEquilibrium { load: to.load, stick, slip, change }));
            }
        }
        others.into_iter().map(|(_, other)| other).collect()
    }

    /// Returns the states that differ from that of a step in one entry, of those in contact or beside one, as
    /// many as are tried.
    fn neighbours(&self, step: &TakenStep) -> States {
        let (config, statuses) = (&step.config, step.to.statuses.as_deref().unwrap_or_default());
        let closed = |i: usize| statuses.get(i).is_some_and(|status| status.is_closed());
        let near = |i: &usize| closed(*i) || closed(i + 1) || *i > 0 && closed(i - 1);
        let with = |i: usize| {
            let other =
                self.choices(config, i).into_iter().filter(move |other| *other != statuses[i]);
            other.map(move |other| {
                let mut state = statuses.to_vec();
                state[i] = other;
                state
            })
        };
        let near = (0..statuses.len()).filter(near).flat_map(with);
        let worth: Vec<_> = near.take(1 + WORK / self.model.dofs()).collect();
        States { number: worth.len(), worth }
    }

    /// Returns the statuses that an entry can have.
    pub(super) fn choices(&self, config: &Configuration, i: usize) -> Vec<Status> {
        let slips = [Status::Slip(Sense::Forward), Status::Slip(Sense::Backward)];
        match (&config.pairings[i], self.closing(config, i)) {
            (None, _) => vec![Status::Open],
            (Some(pairing), closed) if pairing.corner > 0.0 => vec![Status::Open, closed],
            (_, Status::Stick) if self.friction.is_finite() => {
                [&[Status::Open, Status::Stick][..], &slips].concat()
            }
            (_, closed) => vec![Status::Open, closed],
        }
    }
}
