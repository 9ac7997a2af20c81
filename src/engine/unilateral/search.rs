//! The search for the equilibrium under one load: statuses are imposed, and the next ones follow from
//! the forces, gaps and slips.

use std::collections::VecDeque;
use std::sync::Arc;

use super::problem::{
    CONE, Configuration, Equilibrium, Iteration, Problem, Setting, StateSearch, StateSolution,
    Watch, cause_first,
};
use super::status::{History, nearest_open, next_closed};
use crate::contact::{ContactForce, Pairing, ROUNDING_OF_A_FORCE, Sense, Status};
use crate::elimination::{Constraint, Elimination};
use crate::error::{Cause, Error, NoEquilibrium, too_large};
use crate::held::Unheld;
use crate::linear::largest;
use crate::solution::{Cycle, Margin, NearestDecision};

/// A first set of few nodes presses them far beyond the later contact: of the nodes outside it, the
/// second set takes those that penetrate by more than this part of the deepest penetration.
const FIRST_GROWTH: f64 = 0.9;

/// The number of iterations beyond one for each contact node after which the search ends.
const PATIENCE: usize = 100;

/// The number of iterations that are kept while one node changes at a time: a search without success
/// goes round a few contact states.
const RETURNING: usize = 8;

/// The change of the displacements, over the largest, below which a shape agrees with the one in
/// which its contact was measured.
pub(super) const SETTLED: f64 = 1e-12;

/// The same where rounding lets the change shrink no further.
pub(super) const STALLED: f64 = 1e-8;

/// The number of nodes in concave corners up to which all ways to rest on one edge or both are tried: eight.
const MOST_CORNERS: usize = 2;

/// The number of shapes in which contact is measured before the search ends.
const SHAPES: usize = 60;

impl Problem<'_> {
    /// Finds the equilibrium of a setting in the shape that it leads to.
    pub(super) fn equilibrium(
        &self,
        setting: &Setting,
        watch: &mut Watch,
    ) -> Result<Equilibrium, Error> {
        let mut gaps = Vec::new();
        let mut first: Option<Iteration> = None;
        let mut keep_first = |config: &Configuration, iteration: &Iteration| {
            first.get_or_insert_with(|| iteration.clone());
            watch(config, iteration);
        };
        let mut before: Option<(Configuration, Iteration, f64)> = None;
        let mut history = History::default();
        for _ in 0..SHAPES {
            history.move_on();
            let (u, start) = match &before {
                Some((_, last, _)) => (&last.solution.u, Some(&*last.statuses)),
                None => (setting.before, setting.statuses),
            };
            let mut config = self.configuration(u);
            if before.is_none() {
                gaps = self.gaps(&config.pairings, u);
            }
            let mut last =
                self.settle(&mut config, setting, start, &mut history, &mut keep_first)?;
            let shape_change = match &before {
                _ if !self.is_current() => 0.0,
                Some(_) => largest((&last.solution.u - u).as_slice()),
                None => f64::INFINITY,
            };
            let stalled = before.as_ref().is_some_and(|(.., old)| shape_change > old / 2.0);
            let scale = largest(last.solution.u.as_slice());
            // Distances in such a shape overflow.
            if self.is_current() && !(scale * scale).is_finite() {
                return Err(too_large().into());
            }
            if shape_change <= SETTLED * scale || (stalled && shape_change <= STALLED * scale) {
                let closing = first.and_then(|first| self.first_closing(&gaps, &first, &last));
                self.along_forces(&mut config, &mut last);
                return Ok(Equilibrium { config, last, closing, shape_change, springs: None });
            }
            before = Some((config, last, shape_change));
        }
        let (config, last, _) = before.expect("a shape was measured in");
        let u = &last.solution.u;
        let why = self.strained(u) + &self.torn(&config, &self.configuration(u));
        let what = format!("the geometry updates did not converge in {SHAPES} times");
        let what = cause_first(&why, what);
        Err(NoEquilibrium { cause: Cause::NotFound, what }.into())
    }

    /// Finds the statuses of a place. Where there are none while nodes rest on both edges of a concave
    /// corner, each of them rests on one edge in turn, and stays on its side of the other.
    ///
    /// # Errors
    /// No statuses were found.
    fn settle(
        &self,
        config: &mut Configuration,
        setting: &Setting,
        start: Option<&[Status]>,
        history: &mut History,
        watch: &mut Watch,
    ) -> Result<Iteration, Error> {
        let found = self.search(config, setting).settle(start, history, watch);
        let in_corner = |i: &usize| config.pairings[*i].as_ref().is_some_and(|p| p.corner > 0.0);
        let corners: Vec<usize> = (0..config.pairings.len()).filter(in_corner).collect();
        let Err(Error::Equilibrium(why)) = found else { return found };
        if corners.is_empty() || corners.len() > MOST_CORNERS {
            return Err(why.into());
        }
        for choice in 1..3_usize.pow(corners.len() as u32) {
            let mut other = config.clone();
            let mut beyond: Vec<Pairing> = Vec::new();
            for (k, i) in corners.iter().enumerate() {
                const EDGES: [Option<[f64; 2]>; 3] = [None, Some([1.0, -1.0]), Some([-1.0, 1.0])];
                let Some(sides) = EDGES[choice / 3_usize.pow(k as u32) % 3] else { continue };
                let both = config.pairings[*i].as_ref().expect("it is in a corner");
                let [on, off] = sides.map(|side| both.on_edge(side));
                Arc::make_mut(&mut other.pairings)[*i] = Some(on);
                beyond.push(off);
            }
            history.move_on();
            let Ok(last) = self.search(&other, setting).settle(start, history, watch) else {
                continue;
            };
            let gap = |off: &Pairing| off.gap_after(self.model, &last.solution.u);
            if beyond.iter().all(|off| gap(off) >= -self.closed) {
                *config = other;
                return Ok(last);
            }
        }
        Err(why.into())
    }

    /// Solves the last contact state of an equilibrium again, on the whole bodies, unless it was found on
    /// them; where that asks for other statuses, searches on from it there.
    pub(super) fn confirmed(
        &self,
        found: Equilibrium,
        setting: &Setting,
        watch: &mut Watch,
    ) -> Result<Equilibrium, Error> {
        if self.reduction.is_none() || found.springs.is_some() {
            return Ok(found);
        }
        let search = self.search(&found.config, setting);
        let Iteration { statuses, constraints, cycle, .. } = found.last.clone();
        if let Ok((_, solution)) = search.held(&statuses, &constraints)? {
            let last = search.completed_iteration((statuses, constraints), cycle, solution);
            if search.wanted(&last, false) == last.statuses {
                return Ok(Equilibrium { last, ..found });
            }
        }
        let again = self.setting(setting.part, setting.before, Some(&found.last.statuses));
        self.equilibrium(&Setting { whole: true, ..again }, watch)
    }

    /// Returns the part of a step after which the first node closes that closed in it, from its gaps
    /// before the step and those that the statuses before the step, those of the `first` iteration, led
    /// to.
    fn first_closing(
        &self,
        before: &[Option<f64>],
        first: &Iteration,
        last: &Iteration,
    ) -> Option<f64> {
        let closes =
            |i: &usize| first.statuses[*i] == Status::Open && last.statuses[*i].is_closed();
        let part = |i: usize| {
            let (from, to) = (before[i]?, first.gaps[i]?);
            (from > self.closed && to < -self.closed).then(|| from / (from - to))
        };
        (0..before.len()).filter(closes).filter_map(part).reduce(f64::min)
    }

    /// Says why an iteration asks for other statuses, of the first node that is to change.
    fn against(&self, iteration: &Iteration, wanted: &[Status]) -> String {
        let change = (0..wanted.len()).find(|&i| wanted[i] != iteration.statuses[i]);
        let Some(i) = change else { return String::new() };
        let why = match (iteration.statuses[i], wanted[i]) {
            (Status::Open, _) => "is open inside the target",
            (Status::Stick | Status::Slip(_), Status::Open) => "is closed and pulls",
            (Status::Stick | Status::Slip(_), Status::Stick | Status::Slip(_)) => {
                "slides or sticks against its friction"
            }
        };
        format!("; in the last, node {} {why}", self.model.contact.nodes[i])
    }
}

impl StateSearch<'_> {
    /// Finds the statuses that agree with their own forces, gaps and slips in one place: by the active set,
    /// by pivots on the contact nodes alone, or among all statuses that there are.
    ///
    /// # Errors
    /// Not even the bodies as rigid ones are in equilibrium, or no statuses were found.
    pub(super) fn settle(
        &self,
        start: Option<&[Status]>,
        history: &mut History,
        watch: &mut Watch,
    ) -> Result<Iteration, Error> {
        let start = start.map_or_else(|| self.first_statuses(), <[Status]>::to_vec);
        let found = self.active_set(start, history, watch);
        let Err(Error::Equilibrium(why)) = found else { return found };
        let problem = self.problem;
        if !problem.is_current()
            && problem.stiffness.springs == 0.0
            && let Some(dof) = problem.escape(self.config, &self.setting.load, problem.friction)
        {
            return Err(problem.escapes(dof).into());
        }
        let Some(start) = self.condensed() else { return Err(why.into()) };
        history.move_on();
        self.active_set(start, history, watch)
    }

    /// Goes from statuses to those that they ask for, until they ask for themselves.
    fn active_set(
        &self,
        mut statuses: Vec<Status>,
        history: &mut History,
        watch: &mut Watch,
    ) -> Result<Iteration, Error> {
        let limit = PATIENCE + self.problem.model.contact.nodes.len();
        let (mut against, mut strained) = (String::new(), String::new());
        let mut recent: VecDeque<Iteration> = VecDeque::new();
        for k in 1..=limit {
            let iteration = match recent.iter().find(|known| known.statuses == statuses) {
                Some(known) => known.repeated(history),
                None => self.iteration(statuses, history)?,
            };
            let wanted = self.wanted(&iteration, history.iterations == 1);
            watch(self.config, &iteration);
            if wanted == iteration.statuses {
                return Ok(iteration);
            }
            if k == limit {
                against = self.problem.against(&iteration, &wanted);
                strained = self.problem.strained(&iteration.solution.u);
            }
            statuses = history.next(&iteration.statuses, wanted);
            if history.one_at_a_time {
                recent.push_front(iteration);
                recent.truncate(RETURNING);
            }
        }
        let never_slides = if self.problem.friction.is_infinite() {
            "; where no node may slide there may be none: give a finite coefficient"
        } else {
            ""
        };
        let what = format!(
            "none of the contact states of {limit} iterations is in equilibrium{}{against}{never_slides}",
            history.returned()
        );
        let what = cause_first(&strained, what);
        Err(NoEquilibrium { cause: Cause::NotFound, what }.into())
    }

    /// Closes the nodes that touch or penetrate, else those with the least gap.
    fn first_statuses(&self) -> Vec<Status> {
        let gaps = self.problem.gaps(&self.config.pairings, self.setting.before);
        let least = gaps.iter().flatten().copied().fold(f64::INFINITY, f64::min).max(0.0);
        self.problem.closed_within(self.config, &gaps, least + self.problem.closed)
    }

    /// Returns the statuses that the forces, gaps and slips of an iteration ask for.
    pub(super) fn wanted(&self, iteration: &Iteration, first: bool) -> Vec<Status> {
        let growth = first && self.setting.statuses.is_none();
        let deep =
            if growth { FIRST_GROWTH * iteration.violation } else { 0.0 }.max(self.problem.closed);
        let rounding = CONE * largest(iteration.solution.u.as_slice());
        let forces = iteration.solution.forces.iter().map(|f| f.normal);
        let most = forces.fold(largest(self.setting.load.as_slice()), f64::max);
        let status = |i: usize| {
            let (Some(pairing), Some(gap)) = (&self.config.pairings[i], iteration.gaps[i]) else {
                return Status::Open;
            };
            let ContactForce { normal, tangent, undetermined } = iteration.solution.forces[i];
            let pulls = normal < -ROUNDING_OF_A_FORCE * most;
            match iteration.statuses[i] {
                Status::Open if gap < -deep => self.problem.closing(self.config, i),
                Status::Open => Status::Open,
                Status::Stick | Status::Slip(_) if pulls => Status::Open,
                Status::Stick | Status::Slip(_) if undetermined && gap > self.problem.closed => {
                    Status::Open
                }
                // A normal force may be less than nothing by rounding.
                Status::Stick
                    if tangent.abs()
                        > self.problem.holding(pairing) * normal.abs() * (1.0 + CONE) =>
                {
                    Status::Slip(match self.problem.transmits_shear(pairing) {
                        false => Sense::Free,
                        true if tangent > 0.0 => Sense::Backward,
                        true => Sense::Forward,
                    })
                }
                Status::Slip(sense) if sense.sign() * self.slip(pairing, iteration) < -rounding => {
                    Status::Stick
                }
                kept @ (Status::Stick | Status::Slip(_)) => kept,
            }
        };
        (0..iteration.statuses.len()).map(status).collect()
    }

    /// Returns the decision of an iteration that is nearest to another one: the gap of an open node, the
    /// force of one in contact, what one that sticks has left of its friction, and the slip of one that
    /// slides. None where none is known.
    pub(super) fn nearest_decision(&self, iteration: &Iteration) -> Option<NearestDecision> {
        let moved = largest(iteration.solution.u.as_slice());
        let force = iteration.solution.forces.iter().map(|force| force.normal.abs());
        let force = force.fold(0.0, f64::max);
        let margins = |i: usize| {
            let ContactForce { normal, tangent, undetermined } = iteration.solution.forces[i];
            let pressed = (Margin::Force, normal.abs() / force);
            let left = self.problem.friction * normal.abs() - tangent.abs();
            match (iteration.statuses[i], &self.config.pairings[i]) {
                (_, None) => Vec::new(),
                (Status::Open, Some(_)) => iteration.gaps[i]
                    .map(|gap| (Margin::Gap, gap.abs() / moved))
                    .into_iter()
                    .collect(),
                (Status::Stick | Status::Slip(_), Some(_)) if undetermined => Vec::new(),
                (Status::Stick, Some(pairing)) if pairing.corner > 0.0 => vec![pressed],
                (Status::Stick, Some(_)) => vec![pressed, (Margin::Friction, left.abs() / force)],
                (Status::Slip(sense), Some(pairing)) if sense.sign() != 0.0 => {
                    vec![pressed, (Margin::Slip, self.slip(pairing, iteration).abs() / moved)]
                }
                (Status::Slip(_), Some(_)) => vec![pressed],
            }
        };
        let all = (0..iteration.statuses.len()).flat_map(|i| {
            let node = self.problem.model.contact.nodes[i];
            margins(i).into_iter().map(move |(of, relative)| NearestDecision { node, of, relative })
        });
        all.filter(|near| near.relative.is_finite())
            .min_by(|a, b| a.relative.total_cmp(&b.relative))
    }

    /// Returns how far a node slipped along the tangent in a step of the load, length.
    fn slip(&self, pairing: &Pairing, iteration: &Iteration) -> f64 {
        let [ux, uy] = pairing.motion(|n| n.components(&iteration.solution.u));
        let [bx, by] = pairing.motion(|n| n.components(self.setting.before));
        let [tx, ty] = pairing.tangent();
        tx * (ux - bx) + ty * (uy - by)
    }

    /// Imposes `statuses`, or more closed nodes where they do not restrain the bodies.
    fn iteration(
        &self,
        mut statuses: Vec<Status>,
        history: &mut History,
    ) -> Result<Iteration, Error> {
        for (status, pairing) in statuses.iter_mut().zip(&*self.config.pairings) {
            if pairing.is_none() {
                *status = Status::Open;
            }
        }
        let (constraints, solution) = loop {
            let constraints = self.constraints(&statuses);
            match self.held(&statuses, &constraints)? {
                Ok((_, solution)) => break (constraints, solution),
                Err(Unheld { t, dof }) => {
                    if !self.restrain_more(&mut statuses, &t) {
                        let pairings = &self.config.pairings;
                        return Err(self.problem.unrestrained(pairings, &constraints, dof).into());
                    }
                }
            }
        };
        let cycle = history.keep(&statuses);
        Ok(self.completed_iteration((statuses, constraints), cycle, solution))
    }

    /// Returns the iteration that imposed statuses by constraints and led to `solution`.
    pub(super) fn completed_iteration(
        &self,
        (statuses, constraints): (Vec<Status>, Vec<Constraint>),
        cycle: Option<Cycle>,
        solution: StateSolution,
    ) -> Iteration {
        let gaps = self.problem.gaps(&self.config.pairings, &solution.u);
        let missed = gaps.iter().zip(&statuses).map(|(gap, status)| match gap {
            Some(gap) if status.is_closed() => gap.abs(),
            Some(gap) => (-gap).max(0.0),
            None => 0.0,
        });
        let violation = missed.fold(0.0, f64::max);
        let springs = self.problem.stiffness.springs;
        Iteration {
            statuses,
            constraints,
            cycle,
            solution,
            gaps,
            violation,
            returned: false,
            springs,
        }
    }

    /// Closes more nodes, or lets one stick; false where there is none.
    fn restrain_more(&self, statuses: &mut [Status], t: &Elimination) -> bool {
        let gaps = self.problem.gaps(&self.config.pairings, self.setting.before);
        let first =
            self.motion(t).and_then(|u| next_closed(statuses, &gaps, &self.config.pairings, &u));
        let more = first.map_or_else(|| nearest_open(statuses, &gaps), |i| vec![i]);
        more.iter().for_each(|&i| statuses[i] = self.problem.closing(self.config, i));
        if !more.is_empty() {
            return true;
        }
        let slides = |status: &&mut Status| matches!(status, Status::Slip(s) if s.sign() != 0.0);
        statuses.iter_mut().find(slides).map(|status| *status = Status::Stick).is_some()
    }

    /// Imposes statuses once, to see whether they are in equilibrium too; None where they are not.
    pub(super) fn try_statuses(&self, statuses: &[Status]) -> Option<StateSolution> {
        let constraints = self.constraints(statuses);
        let (_, solution) = self.held(statuses, &constraints).ok()?.ok()?;
        let iteration = self.completed_iteration((statuses.to_vec(), constraints), None, solution);
        let wanted = self.wanted(&iteration, false);
        (wanted == iteration.statuses).then_some(iteration.solution)
    }
}
