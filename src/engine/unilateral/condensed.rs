//! A step of the load on the contact nodes alone: their forces by their gaps g and slips s.
//!
//! ```text
//!   p = p0 + Snn g + Snt s      apart      g ≥ 0,  p = 0,  q = 0
//!   q = q0 + Stn g + Stt s      sticks     g = 0,  s = 0,  |q| ≤ μ p
//!                               slides     g = 0,  q = −μ p sign s
//! ```
//!
//! p and q are the forces along normal and tangent, p0 and q0 those with every node held to its place on the
//! target, and S is the stiffness of the bodies at the contact surface. With s = a − b these conditions are
//! a linear complementarity problem of g, a, b ≥ 0 and p, μ p + q, μ p − q ≥ 0 (A. Klarbring, Ing.-Arch. 56
//! (1986) 529-541); of few nodes all contact states are tried, one node eliminated after the other.

use nalgebra::{DMatrix, DVector};

use super::lemke::complementary;
use super::problem::StateSearch;
use crate::contact::{Pairing, Sense, Status, contact_forces};
use crate::elimination::{Constraint, Motion};
use problem::model::FREE;

/// The number of contact nodes up to which the step is condensed.
const MOST: usize = 150;

/// What of a force, a gap or a slip over the largest is rounding; what is found is checked on the bodies.
const ROUNDING: f64 = 1e-8;

/// The part of a prescribed gap or slip that the bodies may miss by rounding.
const REACHED: f64 = 1e-6;

/// The forces of a step on the nodes that face the target, stiffness over its largest, forces over theirs.
pub(super) struct Condensed<'a> {
    search: &'a StateSearch<'a>,
    /// The entries that face the target, and the status in which each one is held.
    entries: Vec<usize>,
    held: Vec<Status>,
    /// S by the gap, and the slip where friction acts, of each entry in turn.
    stiffness: DMatrix<f64>,
    /// p0, and q0 where friction acts, of each entry in turn.
    at_rest: DVector<f64>,
}

/// The status of a node that was eliminated: what it leads to, by the gaps and slips of the later ones and 1.
struct Eliminated {
    status: Status,
    /// The tangential over the normal force up to which it sticks.
    holding: f64,
    /// Its gap and its slip, or 0.
    apart: DMatrix<f64>,
    forces: DMatrix<f64>,
}

impl<'a> Condensed<'a> {
    /// Condenses the step of a search; None of more than [`MOST`] nodes, where nothing holds the bodies with
    /// every node in contact, where restraints share its forces, and where there are none.
    pub(super) fn new(search: &'a StateSearch<'a>) -> Option<Self> {
        let StateSearch { problem, config, .. } = search;
        let pairings = &config.pairings;
        let entries: Vec<usize> = (0..pairings.len()).filter(|i| pairings[*i].is_some()).collect();
        if entries.len() > MOST {
            return None;
        }
        let held: Vec<Status> = (0..pairings.len())
            .map(|i| if pairings[i].is_some() { problem.closing(config, i) } else { Status::Open })
            .collect();
        let facing = || entries.iter().filter_map(|i| Some((pairings[*i].as_ref()?, held[*i])));
        let constraints = search.constraints(&held);
        let forces = |reaction: &DVector<f64>| {
            let forces = contact_forces(problem.model, pairings, &held, reaction);
            let of_entry = |i: &usize| parts(held[*i], [forces[*i].normal, forces[*i].tangent]);
            let known = entries.iter().all(|i| !forces[*i].undetermined);
            known.then(|| DVector::from(entries.iter().flat_map(of_entry).collect::<Vec<f64>>()))
        };
        let (bodies, solved) = search.held(&held, &constraints).ok()?.ok()?;
        let at_rest = forces(&solved.reaction)?;
        let size = at_rest.len();
        let mut stiffness = DMatrix::zeros(size, size);
        for column in 0..size {
            let mut unit = (0..size).map(|row| if row == column { 1.0 } else { 0.0 });
            let mut next = |status| match status {
                Status::Stick => [unit.next(), unit.next()],
                Status::Open | Status::Slip(_) => [unit.next(), None],
            };
            let moved = constraints.iter().zip(facing()).map(|(constraint, (pairing, status))| {
                at_distance(constraint, pairing, next(status).map(Option::unwrap_or_default))
            });
            let [u, reaction] = bodies.moved(&moved.collect::<Vec<_>>())?;
            let reached = facing().flat_map(|(pairing, status)| {
                let (n, t) = (pairing.normal, pairing.tangent());
                let [ux, uy] = pairing.motion(|node| node.components(&u));
                parts(status, [n, t].map(|[dx, dy]| dx * ux + dy * uy))
            });
            let is_near = |(row, apart): (usize, f64)| {
                (apart - if row == column { 1.0 } else { 0.0 }).abs() <= REACHED
            };
            if !reached.enumerate().all(is_near) {
                return None;
            }
            stiffness.set_column(column, &forces(&reaction)?);
        }
        let (scale, unit) = (stiffness.diagonal().amax(), at_rest.amax());
        let (stiffness, at_rest) = (stiffness / scale, at_rest / unit);
        (unit > 0.0).then_some(Condensed { search, entries, held, stiffness, at_rest })
    }

    /// Returns the contact state that complementary pivots end in, in equilibrium or not; None where they end
    /// in none, where no node slides, and where one rests in a corner.
    pub(super) fn by_pivots(&self) -> Option<Vec<Status>> {
        let mu = self.search.problem.friction;
        let in_corner = self.search.config.pairings.iter().flatten().any(|p| p.corner > 0.0);
        if mu.is_infinite() || in_corner {
            return None;
        }
        // Each node may open or slide to either side: p, μ p + q, μ p − q by p and q, and g, a, b by g and s.
        let moves = self.entries.iter().flat_map(|i| match self.held[*i] {
            Status::Stick => vec![
                (*i, Status::Open, [1.0, 0.0]),
                (*i, Status::Slip(Sense::Forward), [mu, 1.0]),
                (*i, Status::Slip(Sense::Backward), [mu, -1.0]),
            ],
            Status::Open | Status::Slip(_) => vec![(*i, Status::Open, [1.0, 0.0])],
        });
        let moves: Vec<(usize, Status, [f64; 2])> = moves.collect();
        let (count, size) = (moves.len(), self.at_rest.len());
        let (mut forces, mut apart) = (DMatrix::zeros(count, size), DMatrix::zeros(size, count));
        let mut gap = 0;
        for (k, (i, status, [normal, tangent])) in moves.iter().enumerate() {
            if k > 0 && moves[k - 1].0 != *i {
                gap += parts(self.held[moves[k - 1].0], [(); 2]).len();
            }
            forces[(k, gap)] = *normal;
            if *status == Status::Open {
                apart[(gap, k)] = 1.0;
            } else {
                (forces[(k, gap + 1)], apart[(gap + 1, k)]) = (*tangent, *tangent);
            }
        }
        let matrix = &forces * &self.stiffness * apart;
        // With more than μ for either side a node opens before it slides to both.
        let cover = |k: usize| if moves[k].1 == Status::Open { 1.0 } else { 1.0 + mu };
        let cover = DVector::from_fn(count, |k, _| cover(k));
        let moved = complementary(&matrix, &(forces * &self.at_rest), &cover)?;
        let mut statuses = self.held.clone();
        let changed = moves.iter().zip(moved).filter(|(_, moved)| *moved);
        changed.rev().for_each(|((i, status, _), _)| statuses[*i] = *status);
        Some(statuses)
    }

    /// Returns all contact states in equilibrium to rounding.
    pub(super) fn equilibria(&self) -> Vec<Vec<Status>> {
        let size = self.at_rest.len();
        let mut forces = self.stiffness.clone().insert_column(size, 0.0);
        forces.set_column(size, &self.at_rest);
        let mut found = Vec::new();
        self.eliminate(&forces, &mut Vec::new(), &mut found);
        found
    }

    /// Eliminates the next node, in each of its statuses, from the forces by gaps, slips and 1 that are
    /// `left`; keeps the contact states in equilibrium.
    fn eliminate(
        &self,
        left: &DMatrix<f64>,
        done: &mut Vec<Eliminated>,
        found: &mut Vec<Vec<Status>>,
    ) {
        let StateSearch { problem, config, .. } = self.search;
        let Some(i) = self.entries.get(done.len()) else {
            if self.is_equilibrium(done) {
                let mut statuses = self.held.clone();
                self.entries.iter().zip(done).for_each(|(i, node)| statuses[*i] = node.status);
                found.push(statuses);
            }
            return;
        };
        let size = parts(self.held[*i], [(); 2]).len();
        let later = left.ncols() - size;
        for status in problem.choices(config, *i) {
            // The forces that vanish. As many of its gap and its slip, the last ones, are free.
            let vanish = match status {
                Status::Open => DMatrix::identity(size, size),
                Status::Slip(sense) if sense.sign() != 0.0 => {
                    DMatrix::from_row_slice(1, 2, &[sense.sign() * problem.friction, 1.0])
                }
                Status::Stick | Status::Slip(_) => DMatrix::zeros(0, size),
            };
            let (free, held) = (vanish.nrows(), size - vanish.nrows());
            let equations = vanish * left.rows(0, size);
            let inverse = equations.columns(held, free).into_owned().try_inverse();
            let Some(inverse) = inverse.filter(|inverse| inverse.amax() * FREE <= 1.0) else {
                continue;
            };
            let moved = -inverse * equations.columns(size, later);
            let forces = left.columns(size, later) + left.columns(held, free) * &moved;
            let mut apart = DMatrix::zeros(size, later);
            apart.rows_mut(held, free).copy_from(&moved);
            let holding = config.pairings[*i].as_ref().map_or(0.0, |p| problem.holding(p));
            done.push(Eliminated {
                status,
                holding,
                apart,
                forces: forces.rows(0, size).into_owned(),
            });
            self.eliminate(&forces.rows(size, left.nrows() - size).into_owned(), done, found);
            done.pop();
        }
    }

    /// Returns whether the gaps, slips and forces of all nodes agree with their statuses, the last one first.
    fn is_equilibrium(&self, done: &[Eliminated]) -> bool {
        let size = self.at_rest.len();
        let mut all = DVector::zeros(size + 1);
        all[size] = 1.0;
        let mut first = size;
        done.iter().rev().all(|Eliminated { status, holding, apart, forces }| {
            let later = all.rows(first, size + 1 - first).into_owned();
            let (apart, forces) = (apart * &later, forces * later);
            first -= apart.len();
            all.rows_mut(first, apart.len()).copy_from(&apart);
            let room = ROUNDING * all.amax();
            let presses = forces[0] >= -ROUNDING;
            match status {
                Status::Open => apart[0] >= -room,
                Status::Stick if holding.is_infinite() => presses,
                Status::Stick => presses && forces[1].abs() <= holding * forces[0] + ROUNDING,
                Status::Slip(sense) if sense.sign() != 0.0 => {
                    presses && sense.sign() * apart[1] >= -room
                }
                Status::Slip(_) => presses,
            }
        })
    }
}

/// Returns the parts of a node's gap and slip, or of its forces, that the step leaves open: without friction
/// the first one.
fn parts<T>(held: Status, [normal, tangent]: [T; 2]) -> Vec<T> {
    match held {
        Status::Stick => vec![normal, tangent],
        Status::Open | Status::Slip(_) => vec![normal],
    }
}

/// Binds a node to the place that is a gap and a slip apart from its own on the target.
fn at_distance(constraint: &Constraint, pairing: &Pairing, [gap, slip]: [f64; 2]) -> Constraint {
    let (n, t) = (pairing.normal, pairing.tangent());
    let motion = match constraint.motion {
        Motion::Both(_) => Motion::Both([0, 1].map(|d| gap * n[d] + slip * t[d])),
        Motion::Along(normal, _) => Motion::Along(normal, gap),
    };
    Constraint { motion, ..constraint.clone() }
}
