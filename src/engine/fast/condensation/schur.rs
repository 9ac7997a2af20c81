//! The bodies factored once, and what is left of them on the kept nodes: the Schur complement S.
//!
//! ```text
//!   K --Factored, sparse--> S on the surfaces --Condensation, dense, quick--> S on the kept nodes
//! ```
//!
//! Bodies that are factored for the kept nodes alone need no second step.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::elimination::{Constraint, Elimination};
use crate::stiffness::Stiffness;
use numbers::solve::{self, Condensed, DenseCondensed, Factors, is_large, largest_motion};
use problem::model::{Body, Dof, Model, NodeId};

/// The number of equations, and that of nodes of both surfaces, up to which bodies are factored for all of
/// these, whatever is kept of them: beyond that the factor would grow by more than factoring anew takes.
const FOR_ALL: (usize, usize) = (20_000, 224);

/// The motion under loads of 1, both scaled to a unit diagonal, beyond which a state is left to the
/// factors of its whole matrix, which tell a singular one.
const LOOSE: f64 = 1e10;

/// The bodies of a model factored, and their stiffness condensed to some nodes.
pub struct Factored {
    pub(super) model: Arc<Model>,
    pub(super) condensed: Condensed,
    /// The degree of freedom of each equation of the unconstrained bodies.
    pub(super) dofs: Vec<Dof>,
    /// The degrees of freedom to which they are condensed.
    kept: Vec<Dof>,
    /// Whether each degree of freedom is one of those nodes'.
    pub(super) is_kept: Vec<bool>,
    /// Whether those are all nodes of both surfaces, and maybe others.
    pub(super) has_surfaces: bool,
}

/// The stiffness condensed to some nodes.
pub struct Condensation {
    pub(super) bodies: Arc<Factored>,
    /// None where the bodies are factored for the kept nodes.
    further: Option<Further>,
    /// The degrees of freedom that are kept.
    pub(super) kept: Vec<Dof>,
    /// Whether each degree of freedom is kept, or restrained at a kept node.
    pub(super) is_kept: Vec<bool>,
    /// The kept nodes, ascending; whether each of their degrees of freedom is restrained; and the number
    /// among these of those that are not.
    nodes: Vec<NodeId>,
    restrained: Vec<bool>,
    free: Vec<Dof>,
    /// The largest row sum of |S|, force/length.
    pub(super) kept_norm: f64,
}

/// The elimination of the equations to which bodies are condensed, but for those that are kept.
struct Further {
    condensed: DenseCondensed,
    /// S on the kept equations.
    schur: DMatrix<f64>,
    /// The indices of the eliminated equations among all to which the bodies are condensed.
    first: Vec<usize>,
    /// Those of the kept ones.
    last: Vec<usize>,
}

/// A load on the kept equations, from which the others were eliminated.
pub struct Eliminated {
    inside: solve::Eliminated,
    /// What the further elimination keeps of it; empty where there is none.
    first: DVector<f64>,
    /// What is left of it on the kept equations, force.
    pub(super) kept: DVector<f64>,
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

/// Returns whether factors of a matrix with this diagonal are those of bodies that are held.
pub(super) fn holds(factors: &impl Factors<f64>, diagonal: &DVector<f64>) -> bool {
    largest_motion(factors, diagonal) < LOOSE
}

impl Factored {
    /// Condenses the bodies of `model` to `nodes`; None where they cannot be.
    pub fn new(
        stiffness: &Stiffness,
        model: &Arc<Model>,
        nodes: &BTreeSet<NodeId>,
    ) -> Option<Self> {
        let is_kept = are_dofs_of(model, nodes);
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

    /// Returns the displacements by degree of freedom, length, from those of the equations to which the
    /// bodies are condensed, under a load from which the others were eliminated.
    fn expand(&self, load: &solve::Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        self.by_dof(&self.dofs, &self.condensed.expand(load, kept))
    }

    /// Returns the vector by degree of freedom with a part on some, 0 elsewhere.
    fn by_dof(&self, dofs: &[Dof], part: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.model.dofs());
        dofs.iter().zip(part).for_each(|(dof, x)| all[dof.index()] = *x);
        all
    }
}

impl Condensation {
    /// Condenses bodies to `nodes`, which are among those for which they are factored; None where they
    /// cannot be.
    pub fn new(bodies: &Arc<Factored>, nodes: &BTreeSet<NodeId>) -> Option<Self> {
        let model = &bodies.model;
        let is_kept = are_dofs_of(model, nodes);
        let (last, first): (Vec<usize>, Vec<usize>) =
            (0..bodies.kept.len()).partition(|k| is_kept[bodies.kept[*k].index()]);
        let kept = last.iter().map(|k| bodies.kept[*k]).collect();
        let further =
            if first.is_empty() { None } else { Some(Further::new(bodies, first, last)?) };
        let schur = further.as_ref().map_or(bodies.condensed.schur(), |further| &further.schur);
        let kept_norm = schur.column_iter().map(|c| c.lp_norm(1)).fold(0.0, f64::max);
        let nodes: Vec<NodeId> = nodes.iter().copied().collect();
        let restrained: Vec<bool> =
            nodes.iter().flat_map(|node| model.restraints_of(*node)).collect();
        let free = Dof::all(restrained.len()).filter(|dof| !restrained[dof.index()]).collect();
        let bodies = Arc::clone(bodies);
        Some(Condensation { bodies, further, kept, is_kept, nodes, restrained, free, kept_norm })
    }

    /// Returns the kept nodes, ascending.
    pub fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    /// Returns S on the kept equations, force/length.
    pub(super) fn schur(&self) -> &DMatrix<f64> {
        self.further.as_ref().map_or(self.bodies.condensed.schur(), |further| &further.schur)
    }

    /// Returns what is left of a load by degree of freedom on the kept equations.
    pub(super) fn eliminated(&self, load: &DVector<f64>) -> Eliminated {
        let Factored { condensed, dofs, .. } = &*self.bodies;
        let load = dofs.iter().map(|dof| load[dof.index()]);
        let inside = condensed.eliminate(&DVector::from_iterator(dofs.len(), load));
        let [first, kept] = match &self.further {
            Some(Further { condensed, first, last, .. }) => {
                let [first, last] = [first, last].map(|places| inside.kept.select_rows(places));
                condensed.eliminate(first, last)
            }
            None => [DVector::zeros(0), inside.kept.clone()],
        };
        Eliminated { inside, first, kept }
    }

    /// Builds T and s under `constraints` on kept nodes, of these alone; returns them with the number of
    /// each kept equation's degree of freedom among theirs.
    pub(super) fn closing(&self, constraints: &[Constraint]) -> (Elimination, &[Dof]) {
        let number = |node| NodeId::new(self.nodes.binary_search(&node).expect("its node is kept"));
        let constraint = |constraint: &Constraint| Constraint {
            node: number(constraint.node),
            masters: constraint.masters.iter().map(|(node, w)| (number(*node), *w)).collect(),
            motion: constraint.motion,
        };
        let constraints: Vec<Constraint> = constraints.iter().map(constraint).collect();
        (Elimination::closing(&self.restrained, &constraints), &self.free)
    }

    /// Returns the part on the kept equations of a vector by degree of freedom.
    pub(super) fn part(&self, all: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(self.kept.len(), self.kept.iter().map(|dof| all[dof.index()]))
    }

    /// Returns the vector by degree of freedom with a part on the kept equations, 0 elsewhere.
    pub(super) fn whole(&self, part: &DVector<f64>) -> DVector<f64> {
        self.bodies.by_dof(&self.kept, part)
    }

    /// Returns the displacements by degree of freedom, length, from those of the kept equations under a load.
    pub(super) fn expand(&self, load: &Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        self.bodies.expand(&load.inside, &self.on_surfaces(load, kept))
    }

    /// Returns the same on the nodes for which the bodies are factored; 0 elsewhere.
    pub(super) fn expand_on_surfaces(
        &self,
        load: &Eliminated,
        kept: &DVector<f64>,
    ) -> DVector<f64> {
        self.bodies.by_dof(&self.bodies.kept, &self.on_surfaces(load, kept))
    }

    /// Returns the same by equation to which the bodies are condensed.
    fn on_surfaces(&self, load: &Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        let Some(Further { condensed, first, last, .. }) = &self.further else {
            return kept.clone();
        };
        let mut all = DVector::zeros(self.bodies.kept.len());
        let eliminated = condensed.expand(load.first.clone(), kept);
        for (places, part) in [(first, &eliminated), (last, kept)] {
            places.iter().zip(part).for_each(|(k, x)| all[*k] = *x);
        }
        all
    }

    /// Returns whether it is that of the bodies of `model`.
    pub fn is_of(&self, model: &Model) -> bool {
        self.bodies.model.has_bodies_of(model)
    }

    /// Returns whether it keeps every node that `constraints` name.
    pub fn has(&self, constraints: &[Constraint]) -> bool {
        constraints.iter().flat_map(Constraint::nodes).all(|node| self.keeps(node))
    }

    /// Returns whether it keeps a node.
    pub(super) fn keeps(&self, node: NodeId) -> bool {
        self.is_kept[node.dofs()[0].index()]
    }
}

impl Further {
    /// Eliminates the `first` of the equations to which bodies are condensed; None where that leaves no
    /// digits.
    fn new(bodies: &Factored, first: Vec<usize>, last: Vec<usize>) -> Option<Self> {
        let order = [&first[..], &last].concat();
        let all = bodies.condensed.schur();
        let matrix = DMatrix::from_fn(order.len(), order.len(), |i, j| all[(order[i], order[j])]);
        let condensed = DenseCondensed::new(&matrix, first.len())?;
        let diagonal = matrix.diagonal();
        let is_held = holds(condensed.first(), &diagonal.rows(0, first.len()).into_owned());
        let mut schur = condensed.schur().clone();
        schur.fill_upper_triangle_with_lower_triangle();
        let before = diagonal.iter().skip(first.len());
        let has_digits = schur.diagonal().iter().zip(before).all(|(s, a)| is_large(*s, *a));
        (is_held && has_digits).then_some(Further { condensed, schur, first, last })
    }
}

/// Returns whether each degree of freedom is one of some nodes'.
fn are_dofs_of(model: &Model, nodes: &BTreeSet<NodeId>) -> Vec<bool> {
    let mut are = vec![false; model.dofs()];
    nodes.iter().flat_map(|node| node.dofs()).for_each(|dof| are[dof.index()] = true);
    are
}
