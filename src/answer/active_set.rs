//! The sets of closed gaps that `unilateral` goes through: the first one, and what a set becomes.

use std::collections::HashMap;

use nalgebra::DVector;

use super::contact::Pairing;
use super::solution::Cycle;

/// The closing motion of a gap, over the largest motion, below which the gap does not close.
const STANDING: f64 = 1e-9;

/// The sets that were closed, each with its last iteration, and whether a set returned.
#[derive(Default)]
pub(super) struct Memory {
    visited: HashMap<Vec<bool>, usize>,
    one_at_a_time: bool,
}

impl Memory {
    /// Keeps that iteration `k` closed `set`; says where the same set was closed before.
    pub(super) fn keep(&mut self, k: usize, set: &[bool]) -> Option<Cycle> {
        let before = self.visited.insert(set.to_vec(), k)?;
        Some(Cycle { length: k - before, members: (before..k).collect() })
    }

    /// The set that follows `closed` on the way to the set that is `wanted`: that one, until a set
    /// comes back; from then on one node changes at a time.
    pub(super) fn next(&mut self, closed: &[bool], wanted: Vec<bool>) -> Vec<bool> {
        self.one_at_a_time |= self.visited.contains_key(&wanted);
        if self.one_at_a_time { last_change(closed, &wanted) } else { wanted }
    }
}

/// Returns the set at the start: the nodes that touch or penetrate, else those with the least gap.
pub(super) fn first_set(pairings: &[Option<Pairing>], closed: f64) -> Vec<bool> {
    let gaps = pairings.iter().flatten().map(|p| p.gap);
    let least = gaps.fold(f64::INFINITY, f64::min).max(0.0);
    pairings.iter().map(|p| p.as_ref().is_some_and(|p| p.gap <= least + closed)).collect()
}

/// Returns `before` with the last of the changes that lead to `wanted`.
fn last_change(before: &[bool], wanted: &[bool]) -> Vec<bool> {
    let mut set = before.to_vec();
    if let Some(i) = (0..set.len()).rev().find(|&i| before[i] != wanted[i]) {
        set[i] = wanted[i];
    }
    set
}

/// Returns the node outside `set` whose gap the motion `u` closes first.
pub(super) fn first_closed(
    set: &[bool],
    pairings: &[Option<Pairing>],
    u: &DVector<f64>,
) -> Option<usize> {
    let time = |(i, p): (usize, &Option<Pairing>)| {
        let p = p.as_ref().filter(|_| !set[i])?;
        let closing = -p.opening(|n| n.of(u));
        (closing > STANDING * u.amax()).then(|| (p.gap.max(0.0) / closing, i))
    };
    let times = pairings.iter().enumerate().filter_map(time);
    times.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, i)| i)
}

/// Adds nodes to `set`, as many as it has, those with the least gaps; false where none is left.
pub(super) fn enlarge(set: &mut [bool], pairings: &[Option<Pairing>]) -> bool {
    let open = |(i, p): (usize, &Option<Pairing>)| Some((p.as_ref().filter(|_| !set[i])?.gap, i));
    let mut others: Vec<(f64, usize)> = pairings.iter().enumerate().filter_map(open).collect();
    others.sort_by(|a, b| a.0.total_cmp(&b.0));
    let more = set.iter().filter(|closed| **closed).count().max(1);
    others.iter().take(more).for_each(|(_, i)| set[*i] = true);
    !others.is_empty()
}
