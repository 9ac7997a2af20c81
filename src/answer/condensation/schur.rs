//! The bodies factored once, and what is left of them on the kept nodes: the Schur complement S.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::DVector;

use crate::answer::elimination::{Constraint, Elimination};
use crate::answer::stiffness::Stiffness;
use crate::numbers::solve::{Condensed, Eliminated, Factors, SparseSymmetric, largest_motion};
use crate::problem::model::{Dof, Model, NodeId};

/// The motion under loads of 1, both scaled to a unit diagonal, beyond which a state is left to the
/// factors of its whole matrix, which tell a singular one.
const LOOSE: f64 = 1e10;

/// Returns whether factors of a matrix with this diagonal are those of bodies that are held.
pub(super) fn holds(factors: &impl Factors<f64>, diagonal: &DVector<f64>) -> bool {
    largest_motion(factors, diagonal) < LOOSE
}

/// Returns whether the bodies of two models have the same stiffness and restraints.
pub(super) fn are_same_bodies(one: &Model, other: &Model) -> bool {
    one.plane == other.plane
        && one.thickness == other.thickness
        && one.restrained == other.restrained
        && one.nodes == other.nodes
        && one.triangles == other.triangles
}

/// The stiffness condensed to some nodes.
pub struct Condensation {
    model: Arc<Model>,
    /// The kept nodes.
    pub nodes: BTreeSet<NodeId>,
    pub(super) condensed: Condensed,
    /// The degree of freedom of each equation of the unconstrained bodies.
    pub(super) dofs: Vec<Dof>,
    /// The degrees of freedom that are kept.
    pub(super) kept: Vec<Dof>,
    /// Whether each degree of freedom is kept, or restrained at a kept node.
    pub(super) is_kept: Vec<bool>,
    /// Whether each degree of freedom is restrained or inside.
    pub(super) is_outside: Vec<bool>,
    /// The largest row sum of |K|, force/length.
    pub(super) norm: f64,
    /// The same of |S|.
    pub(super) kept_norm: f64,
}

impl Condensation {
    /// Condenses the bodies of `model` to `nodes`; None where they cannot be.
    pub fn new(stiffness: &Stiffness, model: &Arc<Model>, nodes: BTreeSet<NodeId>) -> Option<Self> {
        let free = Elimination::new(&model.restrained, &[]);
        let matrix: SparseSymmetric = stiffness.reduced(&free);
        let mut is_kept = vec![false; model.dofs()];
        nodes.iter().flat_map(|node| node.dofs()).for_each(|dof| is_kept[dof.index()] = true);
        let dofs: Vec<Dof> = (0..free.size()).map(|column| free.dof(column)).collect();
        let equations: Vec<usize> = (0..dofs.len()).filter(|e| is_kept[dofs[*e].index()]).collect();
        let kept = equations.iter().map(|e| dofs[*e]).collect();
        let norm = matrix.norm();
        let condensed = Condensed::new(matrix, &equations)?;
        let outside = |(restrained, kept): (&bool, &bool)| *restrained || !kept;
        let is_outside = model.restrained.iter().zip(&is_kept).map(outside).collect();
        let model = Arc::clone(model);
        let kept_norm = condensed.schur().column_iter().map(|c| c.lp_norm(1)).fold(0.0, f64::max);
        Some(Condensation {
            model,
            nodes,
            condensed,
            dofs,
            kept,
            is_kept,
            is_outside,
            norm,
            kept_norm,
        })
    }

    /// Returns what is left of a load by degree of freedom on the kept equations.
    pub(super) fn eliminated(&self, load: &DVector<f64>) -> Eliminated {
        let load = self.dofs.iter().map(|dof| load[dof.index()]);
        self.condensed.eliminate(&DVector::from_iterator(self.dofs.len(), load))
    }

    /// Returns the part on the kept equations of a vector by degree of freedom.
    pub(super) fn part(&self, all: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(self.kept.len(), self.kept.iter().map(|dof| all[dof.index()]))
    }

    /// Returns the vector by degree of freedom with a part on the kept equations, 0 elsewhere.
    pub(super) fn whole(&self, part: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.is_kept.len());
        self.kept.iter().zip(part).for_each(|(dof, x)| all[dof.index()] = *x);
        all
    }

    /// Returns the displacements by degree of freedom from those of the kept equations.
    pub(super) fn expand(&self, load: &Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        let mut u = DVector::zeros(self.is_kept.len());
        let all = self.condensed.expand(load, kept);
        self.dofs.iter().zip(&all).for_each(|(dof, x)| u[dof.index()] = *x);
        u
    }

    /// Returns whether it is that of the bodies of `model`.
    pub fn is_of(&self, model: &Model) -> bool {
        are_same_bodies(&self.model, model)
    }

    /// Returns whether it keeps every node that `constraints` name.
    pub fn has(&self, constraints: &[Constraint]) -> bool {
        let mut nodes = constraints.iter().flat_map(Constraint::nodes);
        nodes.all(|node| self.keeps(node))
    }

    /// Returns whether it keeps a node.
    pub(super) fn keeps(&self, node: NodeId) -> bool {
        self.is_kept[node.dofs()[0].index()]
    }
}
