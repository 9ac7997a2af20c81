//! The statuses of contact nodes that `unilateral` goes through: the first ones, and what statuses
//! become.

use std::collections::{HashMap, HashSet};

use nalgebra::DVector;

use crate::contact::Pairing;
use crate::contact::Status;
use crate::solution::Cycle;

/// The closing motion of a gap, over the largest motion, below which the gap does not close.
const STANDING: f64 = 1e-9;

/// The statuses that were imposed under one load, each with its last iteration, and whether any
/// returned in the place in which contact is measured now.
#[derive(Default)]
pub(super) struct History {
    /// The number of iterations.
    pub(super) iterations: usize,
    visited: HashMap<Vec<Status>, usize>,
    tried_here: HashSet<Vec<Status>>,
    /// Whether one node changes at a time.
    pub(super) one_at_a_time: bool,
    /// The last return of statuses other than those before.
    last_cycle: Option<Cycle>,
}

impl History {
    /// Keeps that one more iteration imposed `statuses`; says where the same were imposed before.
    pub(super) fn keep(&mut self, statuses: &[Status]) -> Option<Cycle> {
        self.iterations += 1;
        let k = self.iterations;
        self.tried_here.insert(statuses.to_vec());
        let before = self.visited.insert(statuses.to_vec(), k)?;
        let cycle = Cycle { length: k - before, members: (before..k).collect() };
        if cycle.length > 1 {
            self.last_cycle = Some(cycle.clone());
        }
        Some(cycle)
    }

    /// The statuses that follow `tried` on the way to those that are `wanted`: these, until any come
    /// back; from then on one node changes at a time.
    pub(super) fn next(&mut self, tried: &[Status], wanted: Vec<Status>) -> Vec<Status> {
        self.one_at_a_time |= self.tried_here.contains(&wanted);
        let changes = |i: &usize| tried[*i] != wanted[*i];
        let last = (0..tried.len()).rfind(changes).filter(|_| self.one_at_a_time);
        let Some(i) = last else { return wanted };
        let mut next = tried.to_vec();
        next[i] = wanted[i];
        next
    }

    /// Says which iterations' statuses returned last; no text where none did.
    pub(super) fn returned(&self) -> String {
        match &self.last_cycle {
            Some(cycle) => {
                let last = cycle.members[0] + cycle.length - 1;
                format!("; the contact states of iterations {} to {last} return", cycle.members[0])
            }
            None => String::new(),
        }
    }

    /// Begins the search in another place.
    pub(super) fn move_on(&mut self) {
        self.tried_here.clear();
        self.one_at_a_time = false;
    }
}

/// Returns the open entry whose gap the motion `u` closes first.
pub(super) fn next_closed(
    statuses: &[Status],
    gaps: &[Option<f64>],
    pairings: &[Option<Pairing>],
    u: &DVector<f64>,
) -> Option<usize> {
    let time = |(i, p): (usize, &Option<Pairing>)| {
        let p = p.as_ref().filter(|_| statuses[i] == Status::Open)?;
        let closing = -p.opening(|n| n.components(u));
        (closing > STANDING * u.amax()).then(|| (gaps[i].unwrap_or(0.0).max(0.0) / closing, i))
    };
    let times = pairings.iter().enumerate().filter_map(time);
    times.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, i)| i)
}

/// Returns the open entries with the least gaps, as many as are closed.
pub(super) fn nearest_open(statuses: &[Status], gaps: &[Option<f64>]) -> Vec<usize> {
    let open = |(i, gap): (usize, &Option<f64>)| {
        gap.filter(|_| statuses[i] == Status::Open).map(|gap| (gap, i))
    };
    let mut others: Vec<(f64, usize)> = gaps.iter().enumerate().filter_map(open).collect();
    others.sort_by(|a, b| a.0.total_cmp(&b.0));
    let more = statuses.iter().filter(|status| status.is_closed()).count().max(1);
    others.iter().take(more).map(|(_, i)| *i).collect()
}
