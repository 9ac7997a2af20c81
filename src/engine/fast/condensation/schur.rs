//! What is left of the bodies on the kept nodes: the Schur complement S.
//!
//! ```text
//!   K --Factored, sparse--> S on the surfaces --dense, quick--> S on the kept nodes
//! ```
//!
//! Bodies that are factored for the kept nodes alone need no second step.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::factored::{Factored, are_of};
use crate::elimination::{Constraint, Elimination};
use numbers::solve::{self, DenseCondensed, Factors, is_large, largest_motion};
use problem::model::{Dof, Model, NodeId};

/// The motion under loads of 1, both scaled to a unit diagonal, beyond which a state is left to the
/// factors of its whole matrix, which tell a singular one.
const LOOSE: f64 = 1e10;

/// Returns whether factors of a matrix with this diagonal are those of bodies that are held.
pub(super) fn holds(factors: &impl Factors<f64>, diagonal: &DVector<f64>) -> bool {
    largest_motion(factors, diagonal) < LOOSE
}

/// The stiffness condensed to some nodes.
pub struct Condensation {
    bodies: Arc<Factored>,
    /// None where the bodies are factored for the kept nodes.
    further: Option<Further>,
    /// The degrees of freedom that are kept.
    pub(super) kept: Vec<Dof>,
    /// Whether each degree of freedom is kept, or restrained at a kept node.
    pub(super) is_kept: Vec<bool>,
    among_kept: AmongKept,
    /// The largest row sum of |S|, force/length.
    pub(super) kept_norm: f64,
}

/// The kept nodes numbered among themselves.
struct AmongKept {
    /// In their order.
    nodes: Vec<NodeId>,
    /// Whether each of their degrees of freedom is restrained.
    restrained: Vec<bool>,
    /// Those that are kept.
    dofs: Vec<Dof>,
}

/// The elimination of the equations to which bodies are condensed, but for those that are kept.
struct Further {
    condensed: DenseCondensed,
    /// S on the kept equations.
    schur: DMatrix<f64>,
    /// The places of the eliminated equations among all to which the bodies are condensed.
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

impl Condensation {
    /// Condenses bodies to `nodes`, which are among those for which they are factored; None where they
    /// cannot be.
    pub fn new(bodies: &Arc<Factored>, nodes: &BTreeSet<NodeId>) -> Option<Self> {
        let model = &bodies.model;
        let is_kept = are_of(model, nodes);
        let (last, first): (Vec<usize>, Vec<usize>) =
            (0..bodies.kept.len()).partition(|k| is_kept[bodies.kept[*k].index()]);
        let kept = last.iter().map(|k| bodies.kept[*k]).collect();
        let further =
            if first.is_empty() { None } else { Some(Further::new(bodies, first, last)?) };
        let (among_kept, bodies) = (AmongKept::new(model, nodes), Arc::clone(bodies));
        let mut made = Condensation { bodies, further, kept, is_kept, among_kept, kept_norm: 0.0 };
        made.kept_norm = made.schur().column_iter().map(|c| c.lp_norm(1)).fold(0.0, f64::max);
        Some(made)
    }

    /// Returns the kept nodes, ascending.
    pub fn nodes(&self) -> &[NodeId] {
        &self.among_kept.nodes
    }

    /// Returns S on the kept equations, force/length.
    pub(super) fn schur(&self) -> &DMatrix<f64> {
        self.further.as_ref().map_or(self.bodies.schur(), |further| &further.schur)
    }

    /// Returns the largest row sum of |K|, force/length.
    pub(super) fn norm(&self) -> f64 {
        self.bodies.norm()
    }

    /// Returns the degree of freedom of each equation of the unconstrained bodies.
    pub(super) fn dofs(&self) -> &[Dof] {
        &self.bodies.dofs
    }

    /// Returns what is left of a load by degree of freedom on the kept equations.
    pub(super) fn eliminated(&self, load: &DVector<f64>) -> Eliminated {
        let inside = self.bodies.eliminated(load);
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
        let AmongKept { nodes, restrained, dofs } = &self.among_kept;
        let number = |node| NodeId::new(nodes.binary_search(&node).expect("its node is kept"));
        let constraint = |constraint: &Constraint| Constraint {
            node: number(constraint.node),
            masters: constraint.masters.iter().map(|(node, w)| (number(*node), *w)).collect(),
            motion: constraint.motion,
        };
        let constraints: Vec<Constraint> = constraints.iter().map(constraint).collect();
        (Elimination::closing(restrained, &constraints), dofs)
    }

    /// Returns the part on the kept equations of a vector by degree of freedom.
    pub(super) fn part(&self, all: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(self.kept.len(), self.kept.iter().map(|dof| all[dof.index()]))
    }

    /// Returns the vector by degree of freedom with a part on the kept equations, 0 elsewhere.
    pub(super) fn whole(&self, part: &DVector<f64>) -> DVector<f64> {
        by_dof(&self.bodies, &self.kept, part)
    }

    /// Returns the displacements by degree of freedom from those of the kept equations.
    pub(super) fn expand(&self, load: &Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        self.bodies.expand(&load.inside, &self.on_surfaces(load, kept))
    }

    /// Returns the same on the nodes for which the bodies are factored; 0 elsewhere.
    pub(super) fn expand_on_surfaces(
        &self,
        load: &Eliminated,
        kept: &DVector<f64>,
    ) -> DVector<f64> {
        by_dof(&self.bodies, &self.bodies.kept, &self.on_surfaces(load, kept))
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
        let mut nodes = constraints.iter().flat_map(Constraint::nodes);
        nodes.all(|node| self.keeps(node))
    }

    /// Returns whether it keeps a node.
    pub(super) fn keeps(&self, node: NodeId) -> bool {
        self.is_kept[node.dofs()[0].index()]
    }

    /// Returns whether the bodies are condensed to a node, kept or not.
    pub(super) fn is_on_surface(&self, node: NodeId) -> bool {
        self.bodies.keeps(node)
    }

    /// Returns whether they are to all nodes of both surfaces.
    pub(super) fn has_surfaces(&self) -> bool {
        self.bodies.has_surfaces
    }
}

impl AmongKept {
    fn new(model: &Model, nodes: &BTreeSet<NodeId>) -> Self {
        let nodes: Vec<NodeId> = nodes.iter().copied().collect();
        let restrained: Vec<bool> =
            nodes.iter().flat_map(|node| model.restraints_of(*node)).collect();
        let dofs = Dof::all(restrained.len()).filter(|dof| !restrained[dof.index()]).collect();
        AmongKept { nodes, restrained, dofs }
    }
}

impl Further {
    /// Eliminates the `first` of the equations to which bodies are condensed; None where that leaves no
    /// digits.
    fn new(bodies: &Factored, first: Vec<usize>, last: Vec<usize>) -> Option<Self> {
        let order = [&first[..], &last].concat();
        let all = bodies.schur();
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

/// Returns the vector by degree of freedom with a part on some, 0 elsewhere.
fn by_dof(bodies: &Factored, dofs: &[Dof], part: &DVector<f64>) -> DVector<f64> {
    let mut all = DVector::zeros(bodies.model.dofs());
    dofs.iter().zip(part).for_each(|(dof, x)| all[dof.index()] = *x);
    all
}
