//! The bodies factored once, and condensed to some nodes.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::elimination::Elimination;
use crate::stiffness::Stiffness;
use numbers::solve::{Condensed, Eliminated};
use problem::model::{Body, Dof, Model, NodeId};

/// The number of equations, and that of nodes of both surfaces, up to which bodies are factored for all of
/// these, whatever is kept of them: beyond that the factor would grow by more than factoring anew takes.
const FOR_ALL: (usize, usize) = (20_000, 224);

/// The bodies of a model factored, and their stiffness condensed to some nodes.
pub struct Factored {
    pub(super) model: Arc<Model>,
    condensed: Condensed,
    /// The degree of freedom of each equation of the unconstrained bodies.
    pub(super) dofs: Vec<Dof>,
    /// The degrees of freedom to which they are condensed.
    pub(super) kept: Vec<Dof>,
    /// Whether each degree of freedom is one of those nodes'.
    is_kept: Vec<bool>,
    /// Whether those are all nodes of both surfaces, and maybe others.
    pub(super) has_surfaces: bool,
}

/// Returns the nodes of the contact surface and those of the target surface, each in its order.
pub(super) fn surfaces(model: &Model) -> [Vec<NodeId>; 2] {
    let mut target: Vec<NodeId> = model.target_edges().flat_map(|edge| edge.nodes).collect();
    target.dedup();
    [model.contact.nodes.clone(), target]
}

/// Returns the nodes of both surfaces of a model whose bodies are factored for all of them; None of others.
pub fn few_surfaces(model: &Model) -> Option<BTreeSet<NodeId>> {
    let (equations, most) = FOR_ALL;
    let surfaces: BTreeSet<NodeId> = surfaces(model).into_iter().flatten().collect();
    (model.free_dofs() <= equations && surfaces.len() <= most).then_some(surfaces)
}

impl Factored {
    /// Condenses the bodies of `model` to `nodes`; None where they cannot be.
    pub fn new(
        stiffness: &Stiffness,
        model: &Arc<Model>,
        nodes: &BTreeSet<NodeId>,
    ) -> Option<Self> {
        let is_kept = are_of(model, nodes);
        let dofs: Vec<Dof> = model.all_dofs().filter(|dof| !model.is_restrained(*dof)).collect();
        let mut equation = vec![None; model.dofs()];
        dofs.iter().enumerate().for_each(|(e, dof)| equation[dof.index()] = Some(e));
        let of_body = |body: &Body| {
            let dofs = body.nodes.iter().flat_map(|node| node.dofs());
            dofs.filter_map(|dof| equation[dof.index()]).collect()
        };
        let kept: Vec<usize> = (0..dofs.len()).filter(|e| is_kept[dofs[*e].index()]).collect();
        // To those of a part all others are restrained.
        let matrix = |equations: &[usize]| {
            let mut restrained = vec![true; model.dofs()];
            equations.iter().for_each(|e| restrained[dofs[*e].index()] = false);
            stiffness.reduced(&Elimination::new(&restrained, &[]))
        };
        let parts: Vec<Vec<usize>> = model.bodies.iter().map(of_body).collect();
        let condensed = Condensed::new(&parts, matrix, &kept)?;
        let kept = kept.iter().map(|e| dofs[*e]).collect();
        let has_surfaces = surfaces(model).concat().iter().all(|node| nodes.contains(node));
        let model = Arc::clone(model);
        Some(Factored { model, condensed, dofs, kept, is_kept, has_surfaces })
    }

    /// Returns whether they are condensed to a node, among others.
    pub(super) fn keeps(&self, node: NodeId) -> bool {
        self.is_kept[node.dofs()[0].index()]
    }

    /// Returns the largest row sum of |K|, force/length.
    pub(super) fn norm(&self) -> f64 {
        self.condensed.norm()
    }

    /// Returns S on these, force/length.
    pub(crate) fn schur(&self) -> &DMatrix<f64> {
        self.condensed.schur()
    }

    /// Eliminates the equations inside from a load by degree of freedom.
    pub(crate) fn eliminated(&self, load: &DVector<f64>) -> Eliminated {
        let load = self.dofs.iter().map(|dof| load[dof.index()]);
        self.condensed.eliminate(&DVector::from_iterator(self.dofs.len(), load))
    }

    /// Returns the displacements by degree of freedom from those of the kept equations.
    pub(crate) fn expand(&self, load: &Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        let mut u = DVector::zeros(self.model.dofs());
        let all = self.condensed.expand(load, kept);
        self.dofs.iter().zip(&all).for_each(|(dof, x)| u[dof.index()] = *x);
        u
    }
}

/// Returns whether each degree of freedom is one of some nodes'.
pub(super) fn are_of(model: &Model, nodes: &BTreeSet<NodeId>) -> Vec<bool> {
    let mut are_of = vec![false; model.dofs()];
    nodes.iter().flat_map(|node| node.dofs()).for_each(|dof| are_of[dof.index()] = true);
    are_of
}
