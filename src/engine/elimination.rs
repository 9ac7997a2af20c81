//! Contact by elimination: u = T q + s, and Tᵀ K T on the free equations q.
//!
//! ```text
//!   eq. (1): u_c = k1·u_a + k2·u_b         a row of T has
//!                                            one 1        a free equation
//!     a *-----o-----* b                      weights      an equation of a contact node in contact
//!             c                              no entry     a restrained equation
//! ```
//!
//! A constraint that closes a gap g along a normal n, n·(u_c − Σ w u_t) = −g, leaves the contact
//! node one free motion along the tangent, and displaces it by s = −g·n. Where restraints do not let
//! the contact node follow, the equation of a target node is eliminated in its place.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use smallvec::{SmallVec, smallvec};

use crate::linear::negligible;
use numbers::scalar::Scalar;
use paper::door::NodeToSegment;
use problem::model::{Dof, Hold, Holds, NodeId};

/// The constraint that binds the displacements of a contact node to the target.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint<T = f64> {
    /// The contact node of the constraint.
    pub node: NodeId,
    /// The master nodes, which are nodes of the target, and their weights.
    pub masters: Vec<(NodeId, T)>,
    /// The motions of the node that are bound, and the place to which they are bound.
    pub motion: Motion<T>,
}

/// The motions of a contact node that a constraint binds, in lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion<T = f64> {
    /// Both components are bound: u_c = Σ w u_t + shift, which is eq. (1) where the shift is 0.
    Both([T; 2]),
    /// The motion along a unit normal is bound: n·u_c = Σ w n·u_t + shift.
    Along([T; 2], T),
}

impl<T: Scalar> Constraint<T> {
    /// Returns the same constraint in other numbers.
    pub fn map<U: Scalar>(&self, to: impl Fn(T) -> U) -> Constraint<U> {
        Constraint {
            node: self.node,
            masters: self.masters.iter().map(|&(master, w)| (master, to(w))).collect(),
            motion: match self.motion {
                Motion::Both(shift) => Motion::Both(shift.map(&to)),
                Motion::Along(normal, shift) => Motion::Along(normal.map(&to), to(shift)),
            },
        }
    }

    /// Returns the constraint's equations: a direction d, the shift along it, and the constraint,
    /// for d·u_c − Σ w d·u_t = shift.
    pub(super) fn equations(&self) -> Vec<([T; 2], T, &Self)> {
        let (one, zero) = (T::one(), T::zero());
        match self.motion {
            Motion::Along(normal, shift) => vec![(normal, shift, self)],
            Motion::Both([x, y]) => vec![([one, zero], x, self), ([zero, one], y, self)],
        }
    }
}

impl From<&Hold> for Constraint {
    fn from(hold: &Hold) -> Self {
        let motion = Motion::Along(hold.direction, hold.displacement);
        Constraint { node: hold.node, masters: Vec::new(), motion }
    }
}

impl<T: Scalar> From<NodeToSegment<T>> for Constraint<T> {
    /// Binds the node by eq. (1): u_c = Σ w u_t.
    fn from(bound: NodeToSegment<T>) -> Self {
        let motion = Motion::Both([T::zero(), T::zero()]);
        Constraint { node: bound.node, masters: bound.masters.to_vec(), motion }
    }
}

/// Weights on the remaining equations: one of 1 in most rows.
type Row<T> = SmallVec<[(usize, T); 1]>;

/// The matrix T, as rows of weights on the remaining equations, and the shift s, length.
pub struct Elimination<T = f64> {
    rows: Vec<Row<T>>,
    shift: DVector<T>,
    /// The degree of freedom of each equation that remains.
    free: Vec<Dof>,
}

impl<T: Scalar> Elimination<T> {
    /// Builds T and s under `constraints`, among them eq. (1). A component of a contact node that is
    /// restrained stays so and is not constrained.
    pub fn new(holds: &Holds, constraints: &[Constraint<T>]) -> Self {
        let mut t = Elimination::unbound(holds, 1.0, constraints.iter());
        constraints.iter().for_each(|constraint| t.bind(constraint, holds));
        t
    }

    /// Builds T and s such that every constraint holds, also on restrained contact nodes, if need be by the
    /// motion of target nodes. Where nothing can move, the constraint is left out. Restraints displace nodes
    /// by a `part` of what they do at last.
    pub fn closing(holds: &Holds, part: f64, constraints: &[Constraint<T>]) -> Self {
        let is_held = |c: &&Constraint<T>| !holds.of(c.node).is_empty();
        let (fixed, free): (Vec<_>, Vec<_>) = constraints.iter().partition(is_held);
        let mut t = Elimination::unbound(holds, part, free.iter().copied());
        let mut eliminated = Vec::new();
        for (direction, shift, constraint) in fixed.iter().flat_map(|c| c.equations()) {
            eliminated.extend(t.eliminate(constraint, direction, shift));
        }
        t.remove(&eliminated);
        free.iter().for_each(|constraint| t.bind(constraint, holds));
        t
    }

    /// Builds T without constraints; the equations of the nodes of `bound` are left out.
    fn unbound<'a>(
        holds: &Holds,
        part: f64,
        bound: impl Iterator<Item = &'a Constraint<T>>,
    ) -> Self {
        let size = 2 * holds.nodes();
        let mut constrained = vec![false; holds.nodes()];
        for Constraint { node, .. } in bound {
            // Bound twice, it would leave an empty column: a false singular matrix.
            let before = std::mem::replace(&mut constrained[node.index()], true);
            assert!(!before, "node {node} is bound once");
        }
        let mut t = Elimination {
            rows: std::iter::repeat_with(Row::new).take(size).collect(),
            shift: DVector::from_element(size, T::zero()),
            free: Vec::new(),
        };
        for node in NodeId::all(holds.nodes()).filter(|node| !constrained[node.index()]) {
            if let Some(hold) = holds.oblique(node) {
                let hold = Hold { displacement: part * hold.displacement, ..*hold };
                t.bind(&Constraint::from(&hold).map(T::from_f64), holds);
                continue;
            }
            for dof in node.dofs() {
                match holds.given(dof) {
                    None => t.rows[dof.index()] = smallvec![(t.add(dof), T::one())],
                    Some(given) => t.shift[dof.index()] = T::from_f64(part * given),
                }
            }
        }
        t
    }

    /// Eliminates the equation that moves most under direction·u_c − Σ w direction·u_t = shift, and
    /// returns its column; None where nothing can move.
    fn eliminate(&mut self, c: &Constraint<T>, direction: [T; 2], shift: T) -> Option<usize> {
        let (mut row, mut rest) = (BTreeMap::new(), shift);
        let own = std::iter::once((c.node, T::one()));
        for (node, weight) in own.chain(c.masters.iter().map(|&(master, w)| (master, -w))) {
            for dof in node.dofs() {
                let factor = weight * direction[dof.direction()];
                rest -= factor * self.shift[dof.index()];
                for &(p, w) in &self.rows[dof.index()] {
                    *row.entry(p).or_insert(T::zero()) += factor * w;
                }
            }
        }
        let size = |factor: &T| Scalar::abs(*factor).to_f64();
        let (&pivot, &factor) = row.iter().max_by(|a, b| size(a.1).total_cmp(&size(b.1)))?;
        if size(&factor) <= negligible(T::EPSILON) {
            return None;
        }
        row.remove(&pivot);
        for (dof, terms) in self.rows.iter_mut().enumerate() {
            let Some(at) = terms.iter().position(|(p, _)| *p == pivot) else { continue };
            let share = terms.swap_remove(at).1 / factor;
            self.shift[dof] += share * rest;
            for (&p, &w) in &row {
                match terms.iter_mut().find(|(q, _)| *q == p) {
                    Some(term) => term.1 -= share * w,
                    None => terms.push((p, -(share * w))),
                }
            }
        }
        Some(pivot)
    }

    /// Removes eliminated columns.
    fn remove(&mut self, eliminated: &[usize]) {
        if eliminated.is_empty() {
            return;
        }
        let kept: Vec<usize> =
            (0..self.free.len()).filter(|column| !eliminated.contains(column)).collect();
        let mut number = vec![0; self.free.len()];
        kept.iter().enumerate().for_each(|(new, old)| number[*old] = new);
        self.free = kept.iter().map(|old| self.free[*old]).collect();
        self.rows.iter_mut().flatten().for_each(|(column, _)| *column = number[*column]);
    }

    /// Binds a node whose own equations are left out.
    fn bind(&mut self, constraint: &Constraint<T>, holds: &Holds) {
        let [x, y] = constraint.node.dofs();
        match constraint.motion {
            Motion::Both(shift) => {
                for dof in [x, y].into_iter().filter(|dof| holds.given(*dof).is_none()) {
                    let mut normal = [T::zero(), T::zero()];
                    normal[dof.direction()] = T::one();
                    self.rows[dof.index()] = self.target_motion(constraint, normal, T::one());
                    self.shift[dof.index()] =
                        shift[dof.direction()] + self.target_shift(constraint, normal);
                }
            }
            Motion::Along([nx, ny], shift) => {
                let target = self.target_shift(constraint, [nx, ny]);
                for (dof, factor) in [(x, nx), (y, ny)] {
                    self.rows[dof.index()] = self.target_motion(constraint, [nx, ny], factor);
                    self.shift[dof.index()] = (shift + target) * factor;
                }
                let slide = self.add(if Scalar::abs(nx) > Scalar::abs(ny) { y } else { x });
                self.rows[x.index()].push((slide, -ny));
                self.rows[y.index()].push((slide, nx));
            }
        }
    }

    /// Adds an equation that remains, and returns its index.
    fn add(&mut self, dof: Dof) -> usize {
        self.free.push(dof);
        self.free.len() - 1
    }

    /// Returns `factor` · Σ w n·u_t as weights on the equations that remain.
    fn target_motion(&self, constraint: &Constraint<T>, normal: [T; 2], factor: T) -> Row<T> {
        let mut row = Row::new();
        for &(master, weight) in &constraint.masters {
            for dof in master.dofs() {
                let along = normal[dof.direction()];
                if !along.is_zero() {
                    let motion = &self.rows[dof.index()];
                    row.extend(motion.iter().map(|&(p, w)| (p, factor * along * weight * w)));
                }
            }
        }
        row
    }

    /// Returns Σ w n·s_t, the target's part of the shift, length.
    fn target_shift(&self, constraint: &Constraint<T>, normal: [T; 2]) -> T {
        let part = |&(master, weight): &(NodeId, T)| {
            let along = master.dofs().map(|dof| normal[dof.direction()] * self.shift[dof.index()]);
            weight * (along[0] + along[1])
        };
        constraint.masters.iter().fold(T::zero(), |total, term| total + part(term))
    }

    /// Returns the number of equations that remain.
    pub fn size(&self) -> usize {
        self.free.len()
    }

    /// Returns a row of T: the equations that remain, from 0, and their weights.
    pub fn row(&self, dof: Dof) -> &[(usize, T)] {
        &self.rows[dof.index()]
    }

    /// Returns Tᵀ K T of a dense K, in the unit of K.
    pub fn matrix(&self, k: &DMatrix<T>) -> DMatrix<T> {
        let n = self.size();
        // Zeros that the system has are not written.
        let mut reduced = DMatrix::from_vec(n, n, vec![T::zero(); n * n]);
        for (j, column) in self.rows.iter().enumerate().filter(|(_, row)| !row.is_empty()) {
            for (i, row) in self.rows.iter().enumerate() {
                let value = k[(i, j)];
                if value.is_zero() {
                    continue;
                }
                for &(p, wp) in row {
                    for &(q, wq) in column {
                        reduced[(p, q)] += wp * value * wq;
                    }
                }
            }
        }
        reduced
    }

    /// Returns Tᵀ f on the equations that remain, in the unit of f.
    pub fn load(&self, f: &DVector<T>) -> DVector<T> {
        let mut reduced = DVector::from_element(self.size(), T::zero());
        for (row, value) in self.rows.iter().zip(f.iter()) {
            for &(p, w) in row {
                reduced[p] += w * *value;
            }
        }
        reduced
    }

    /// Returns T q + s, the displacements of all degrees of freedom, length.
    pub fn expand(&self, q: &DVector<T>) -> DVector<T> {
        self.motion(q) + &self.shift
    }

    /// Returns T q, the motion of all degrees of freedom that one of the equations that remain is, length.
    pub fn motion(&self, q: &DVector<T>) -> DVector<T> {
        let of_row = |row: &Row<T>| sum(row.iter().map(|&(p, w)| w * q[p]));
        DVector::from_iterator(self.rows.len(), self.rows.iter().map(of_row))
    }

    /// Returns s, the displacements where all equations that remain are 0, length.
    pub fn shift(&self) -> &DVector<T> {
        &self.shift
    }

    /// Returns the degree of freedom that became column `column` of the reduced matrix.
    pub fn dof(&self, column: usize) -> Dof {
        self.free[column]
    }
}

/// Returns the sum of `terms`, begun with the first as a sum of floats is; 0 for none.
pub(super) fn sum<T: Scalar>(terms: impl Iterator<Item = T>) -> T {
    terms.reduce(|sum, term| sum + term).unwrap_or(T::zero())
}
