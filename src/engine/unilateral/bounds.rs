//! The fixed point on the bounds of friction. Where the tangential forces have given bounds s, a step of
//! the load is a convex problem on the contact surface:
//!
//! ```text
//!   least ½ xᵀ S x + p0·g + q0·(a − b) + s·(a + b)     x = (g, a − b),  g ≥ 0,  a ≥ 0,  b ≥ 0
//!   p = p0 + Snn g + Snt (a − b)                       s = μ p  of the solution before
//! ```
//!
//! g are the gaps, a − b the slips of the step, p and q the forces along normal and tangent, p0 and q0
//! those with every node held to its place on the target, and S the stiffness of the bodies at the contact
//! surface. The first bounds are those of the normal forces with which nothing slides.
//!
//! Source: J. Nečas, J. Jarušek, J. Haslinger, Boll. Un. Mat. Ital. B 17 (1980) 796-811; J. Haslinger,
//! Math. Methods Appl. Sci. 5 (1983) 422-437.

use nalgebra::{DMatrix, DVector};

use super::forces::tangent;
use super::nonnegative::least;
use super::problem::Outcome;
use super::search::StateSearch;
use crate::contact::{Pairing, Sense, Status};
use crate::elimination::{Constraint, Motion};

/// The number of contact nodes up to which the problem is set up.
const MOST: usize = 150;

/// The number of bounds that are tried. Where the last half goes back and forth, each is the mean of two.
const BOUNDS: usize = 100;

/// A gap, slip or force in the units of [`StateSearch::scaled`] up to which it is 0: rounding.
const STILL: f64 = 1e-10;

/// The convex problem of one step on the contact surface.
struct Convex {
    /// S, without slips where there is no friction.
    stiffness: DMatrix<f64>,
    /// p0, then q0.
    at_rest: DVector<f64>,
    /// The matrix of the gaps, the slips forward and the slips backward.
    matrix: DMatrix<f64>,
    /// The number of contact nodes, and that of those that slide.
    nodes: usize,
    slips: usize,
}

/// Its solution under some bounds.
struct ConvexSolution {
    /// The gaps, the slips forward and the slips backward.
    x: DVector<f64>,
    /// The gaps, then the slips.
    apart: DVector<f64>,
    /// The normal forces.
    normal: DVector<f64>,
}

impl Convex {
    fn new(stiffness: DMatrix<f64>, at_rest: DVector<f64>, nodes: usize) -> Self {
        let slips = stiffness.nrows() - nodes;
        let of = |k: usize| if k < nodes + slips { (k, 1.0) } else { (k - slips, -1.0) };
        let size = nodes + 2 * slips;
        let matrix = DMatrix::from_fn(size, size, |row, column| {
            let ((row, a), (column, b)) = (of(row), of(column));
            a * b * stiffness[(row, column)]
        });
        Convex { stiffness, at_rest, matrix, nodes, slips }
    }

    /// Returns the solution under bounds, from `start`; None where nothing holds the bodies under them.
    fn under(&self, bounds: &DVector<f64>, start: DVector<f64>) -> Option<ConvexSolution> {
        let Convex { nodes, slips, at_rest, .. } = self;
        let right = DVector::from_fn(nodes + 2 * slips, |row, _| match row {
            _ if row < *nodes => at_rest[row],
            _ if row < nodes + slips => bounds[row - nodes] + at_rest[row],
            _ => bounds[row - nodes - slips] - at_rest[row - slips],
        });
        Some(self.solution(least(&self.matrix, &right, start)?))
    }

    /// Returns the solution in which nothing slides; None where nothing holds the bodies.
    fn stuck(&self) -> Option<ConvexSolution> {
        let (n, size) = (self.nodes, self.matrix.nrows());
        let (normal, at_rest) = (self.stiffness.view((0, 0), (n, n)), self.at_rest.rows(0, n));
        let gaps = least(&normal.into(), &at_rest.into(), DVector::zeros(n))?;
        Some(self.solution(gaps.resize_vertically(size, 0.0)))
    }

    fn solution(&self, x: DVector<f64>) -> ConvexSolution {
        let Convex { nodes, slips, .. } = self;
        let apart = DVector::from_fn(nodes + slips, |row, _| match row {
            _ if row < *nodes => x[row],
            _ => x[row] - x[row + slips],
        });
        let forces = &self.stiffness * &apart + &self.at_rest;
        ConvexSolution { x, apart, normal: forces.rows(0, *nodes).map(|p| p.max(0.0)) }
    }
}

impl StateSearch<'_> {
    /// Looks for statuses in equilibrium by a fixed point on the bounds of friction. None where it finds
    /// none, and where the problem is not of its kind: with nodes that never slide, of more than 150
    /// nodes, or with a contact node that is restrained.
    pub(super) fn by_bounds(&self) -> Option<Vec<Status>> {
        let pairings = &self.config.pairings;
        let entries: Vec<usize> = (0..pairings.len()).filter(|i| pairings[*i].is_some()).collect();
        let restrained =
            |pairing: &Pairing| self.problem.model.restraints_of(pairing.node).contains(&true);
        let (mu, n) = (self.problem.friction, entries.len());
        if mu.is_infinite() || n > MOST || pairings.iter().flatten().any(restrained) {
            return None;
        }
        let (stiffness, at_rest) = self.scaled(&entries, if mu == 0.0 { n } else { 2 * n })?;
        let convex = Convex::new(stiffness, at_rest, n);
        let mut solution = convex.stuck()?;
        let mut bounds = mu * &solution.normal;
        let mut statuses = Vec::new();
        for k in 0..BOUNDS {
            solution = convex.under(&bounds, solution.x)?;
            let last = std::mem::replace(&mut statuses, self.statuses(&entries, &solution));
            if statuses == last && self.try_statuses(&statuses).is_some() {
                return Some(statuses);
            }
            let next = mu * &solution.normal;
            if (&next - &bounds).amax() <= STILL {
                return Some(statuses);
            }
            bounds = if k < BOUNDS / 2 { next } else { (next + bounds) / 2.0 };
        }
        None
    }

    /// Returns the statuses of a solution.
    fn statuses(&self, entries: &[usize], solution: &ConvexSolution) -> Vec<Status> {
        let n = entries.len();
        let mut statuses = vec![Status::Open; self.config.pairings.len()];
        for (k, i) in entries.iter().enumerate() {
            let slip = solution.apart.get(n + k).copied().unwrap_or(0.0);
            statuses[*i] = if solution.apart[k] > STILL || solution.normal[k] == 0.0 {
                Status::Open
            } else if slip.abs() > STILL {
                Status::Slip(if slip > 0.0 { Sense::Forward } else { Sense::Backward })
            } else {
                self.problem.closing(self.config, *i)
            };
        }
        statuses
    }

    /// Returns the stiffness of the first `size` gaps and slips, and the forces with every node held to
    /// the target: gaps and slips in the unit in which stiffness is 1, forces in that of the largest.
    /// None where there are no forces.
    fn scaled(&self, entries: &[usize], size: usize) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let mut statuses = vec![Status::Open; self.config.pairings.len()];
        let held =
            if self.problem.friction == 0.0 { Status::Slip(Sense::Free) } else { Status::Stick };
        entries.iter().for_each(|i| statuses[*i] = held);
        let constraints = self.constraints(&statuses);
        let n = entries.len();
        let forces = |reaction: &DVector<f64>| {
            let forces = self.problem.forces(self.config, &statuses, reaction);
            DVector::from_fn(size, |row, _| {
                let force = forces[entries[row % n]];
                if row < n { force.normal } else { force.tangent }
            })
        };
        let Ok(Outcome::Solved(solution)) = self.solve(&statuses, &constraints) else {
            return None;
        };
        let at_rest = forces(&solution.reaction);
        let unloaded = self.problem.setting(0.0 * &self.setting.load, self.setting.before, None);
        let search = StateSearch { setting: &unloaded, ..*self };
        let mut stiffness = DMatrix::zeros(size, size);
        for column in 0..size {
            let apart = |row: usize| if row == column { 1.0 } else { 0.0 };
            let moved = constraints.iter().zip(entries).enumerate().map(|(k, (constraint, i))| {
                let pairing = self.config.pairings[*i].as_ref()?;
                Some(at_distance(constraint, pairing, [apart(k), apart(n + k)]))
            });
            let moved: Vec<Constraint> = moved.collect::<Option<_>>()?;
            let Ok(Outcome::Solved(solution)) = search.solve(&statuses, &moved) else {
                return None;
            };
            stiffness.set_column(column, &forces(&solution.reaction));
        }
        let (scale, unit) = (stiffness.diagonal().amax(), at_rest.amax());
        (unit > 0.0).then(|| (stiffness / scale, at_rest / unit))
    }
}

/// Binds a node to the place that is a gap and a slip apart from its own on the target.
fn at_distance(constraint: &Constraint, pairing: &Pairing, [gap, slip]: [f64; 2]) -> Constraint {
    let (n, t) = (pairing.normal, tangent(pairing));
    let motion = match constraint.motion {
        Motion::Both(_) => Motion::Both([0, 1].map(|d| gap * n[d] + slip * t[d])),
        Motion::Along(normal, _) => Motion::Along(normal, gap),
    };
    Constraint { motion, ..constraint.clone() }
}
