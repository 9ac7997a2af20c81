//! The stiffness reduced to the nodes of both contact surfaces: the bodies are factored once, contact states
//! are looked for on these nodes alone.
//!
//! ```text
//!   K of all free equations --once--> S on the surfaces --each state--> Tᵀ S T, dense
//! ```
//!
//! Made at the start of a run. Of large surfaces the nodes about the contact nodes with the least gaps are
//! kept; a state that binds others, and one that these hardly hold, is left to its whole matrix.

use nalgebra::{DMatrix, DVector};

use super::contact::Pairing;
use super::elimination::{Constraint, Elimination};
use super::stiffness::Stiffness;
use crate::linear::{EliminatedLoad, Schur};
use problem::model::{Dof, Holds, Model, NodeId};

/// The number of nodes that are kept at most, or so much of the square root of the number of equations,
/// which is what a line across the mesh has.
const MOST: (usize, f64) = (400, 1.7);

/// The stiffness reduced to some nodes.
pub struct Reduction {
    /// The degree of freedom of each free equation of the bodies.
    free: Vec<Dof>,
    schur: Schur,
    /// The kept nodes, ascending.
    nodes: Vec<NodeId>,
    /// Their degrees of freedom that are not restrained, and where each stands among x and y of each in turn.
    kept: Vec<(Dof, usize)>,
    /// What holds the kept nodes, by their places.
    pub(super) holds: Holds,
    /// S by the same, 0 at restrained ones.
    pub(super) stiffness: DMatrix<f64>,
    /// The largest row sum of |S|, force/length.
    pub(super) norm: f64,
    /// That of K.
    pub(super) whole_norm: f64,
    /// The number of all degrees of freedom.
    dofs: usize,
}

impl Reduction {
    /// Reduces the stiffness of a model to the nodes of its surfaces, or those about the least gaps of
    /// `pairings`; None where these do not hold what is left, without contact, and where a restraint follows
    /// no axis or displaces its node, as inner nodes that are held stay where they are here.
    pub fn new(stiffness: &Stiffness, model: &Model, pairings: &[Option<Pairing>]) -> Option<Self> {
        if model.holds.iter().any(|hold| hold.dof().is_none()) {
            return None;
        }
        let nodes = nodes(model, pairings);
        let t = Elimination::new(&model.holds, &[]);
        let free: Vec<Dof> = (0..t.size()).map(|equation| t.dof(equation)).collect();
        let kept = free.iter().enumerate().filter_map(|(e, dof)| {
            let node = nodes.binary_search(&dof.node()).ok()?;
            Some((e, (*dof, 2 * node + dof.direction())))
        });
        let (last, kept): (Vec<usize>, Vec<(Dof, usize)>) = kept.unzip();
        if last.is_empty() {
            return None;
        }
        let matrix = stiffness.reduced(&t);
        let whole_norm = matrix.norm();
        let schur = Schur::new(matrix, last)?;
        let size = 2 * nodes.len();
        let mut s = DMatrix::zeros(size, size);
        for ((_, j), column) in kept.iter().zip(schur.complement().column_iter()) {
            kept.iter().zip(&column).for_each(|((_, i), value)| s[(*i, *j)] = *value);
        }
        let norm = s.column_iter().map(|column| column.lp_norm(1)).fold(0.0, f64::max);
        let place = |node| nodes.binary_search(&node).ok().map(NodeId::new);
        let holds = model.holds.renumbered(nodes.len(), place);
        let (stiffness, dofs) = (s, model.dofs());
        Some(Reduction { free, schur, nodes, kept, holds, stiffness, norm, whole_norm, dofs })
    }

    /// Eliminates all but the kept equations from a load by degree of freedom, force.
    pub fn eliminated(&self, load: &DVector<f64>) -> EliminatedLoad {
        let of_free = self.free.iter().map(|dof| load[dof.index()]);
        self.schur.eliminate(&DVector::from_iterator(self.free.len(), of_free))
    }

    /// Returns what is left of a load on the kept nodes, force.
    pub(super) fn left(&self, load: &EliminatedLoad) -> DVector<f64> {
        self.of_kept(load.last.iter().copied())
    }

    /// Returns the displacements by degree of freedom under a load, length, from those of the kept nodes.
    pub(super) fn expand(&self, load: &EliminatedLoad, kept: &DVector<f64>) -> DVector<f64> {
        let last = self.kept.iter().map(|(_, place)| kept[*place]);
        let all = self.schur.expand(load, &DVector::from_iterator(self.kept.len(), last));
        let mut u = DVector::zeros(self.dofs);
        self.free.iter().zip(&all).for_each(|(dof, x)| u[dof.index()] = *x);
        u
    }

    /// Returns the part of a vector by degree of freedom on the kept nodes, 0 at restrained ones.
    pub(super) fn part(&self, all: &DVector<f64>) -> DVector<f64> {
        self.of_kept(self.kept.iter().map(|(dof, _)| all[dof.index()]))
    }

    /// Returns the vector by degree of freedom with a part on the kept nodes, 0 elsewhere.
    pub(super) fn spread(&self, part: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.dofs);
        self.kept.iter().for_each(|(dof, place)| all[dof.index()] = part[*place]);
        all
    }

    /// Returns values of the kept equations by the places of the kept nodes.
    fn of_kept(&self, values: impl Iterator<Item = f64>) -> DVector<f64> {
        let mut own = DVector::zeros(self.stiffness.nrows());
        self.kept.iter().zip(values).for_each(|((_, place), value)| own[*place] = value);
        own
    }

    /// Returns the equations of the kept nodes under constraints; None where these bind another node.
    pub(super) fn closing(&self, constraints: &[Constraint]) -> Option<Elimination> {
        let number = |node| self.nodes.binary_search(&node).ok().map(NodeId::new);
        let own = constraints.iter().map(|constraint| {
            let masters = constraint.masters.iter().map(|(node, w)| Some((number(*node)?, *w)));
            Some(Constraint {
                node: number(constraint.node)?,
                masters: masters.collect::<Option<_>>()?,
                motion: constraint.motion,
            })
        });
        Some(Elimination::closing(&self.holds, 1.0, &own.collect::<Option<Vec<_>>>()?))
    }
}

/// Returns the nodes of both surfaces, ascending, or of large ones the contact nodes with the least gaps and
/// what they face.
fn nodes(model: &Model, pairings: &[Option<Pairing>]) -> Vec<NodeId> {
    let (fewest, part) = MOST;
    let most = fewest.max((part * (model.free_dofs() as f64).sqrt()) as usize);
    let mut nodes: Vec<NodeId> = model.surface_nodes().into_iter().collect();
    if nodes.len() > most {
        let mut nearest: Vec<&Pairing> = pairings.iter().flatten().collect();
        nearest.sort_by(|a, b| a.gap.total_cmp(&b.gap));
        nodes = nearest.into_iter().take(most / 2).flat_map(Pairing::nodes).collect();
    }
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
