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
use super::refinement::{corrected, refine};
use super::stiffness::Stiffness;
use crate::linear::{DenseCholesky, EliminatedLoad, Factors, Schur, backward_error};
use problem::model::{Dof, Holds, Model, NodeId};

/// The number of nodes that are kept at most, or so much of the square root of the number of equations,
/// which is what a line across the mesh has.
const MOST: (usize, f64) = (400, 1.7);

/// The relative residual of a state that is enough.
const ENOUGH: f64 = 32.0 * f64::EPSILON;

/// The stiffness reduced to some nodes.
pub struct Reduction {
    /// The equations of the bodies.
    t: Elimination,
    schur: Schur,
    /// The kept nodes, ascending, and the degrees of freedom of those that are not restrained.
    nodes: Vec<NodeId>,
    kept: Vec<Dof>,
    /// S by the degrees of freedom of the kept nodes, x and y of each in turn, 0 at restrained ones.
    stiffness: DMatrix<f64>,
    /// What holds the kept nodes, by their places.
    holds: Holds,
    /// The largest row sum of |S|, force/length.
    norm: f64,
    /// That of K.
    whole_norm: f64,
}

/// A load from which all but the kept equations are eliminated.
pub struct ReducedLoad {
    all: EliminatedLoad,
    /// What restraints displace, by degree of freedom, length.
    shift: DVector<f64>,
    /// What is left of it, by the degrees of freedom of the kept nodes, force.
    kept: DVector<f64>,
}

/// A contact state on the kept nodes: Tᵀ S T, factored.
pub struct ReducedState<'a> {
    reduction: &'a Reduction,
    t: Elimination,
    factors: DenseCholesky,
}

impl Reduction {
    /// Reduces the stiffness of a model to the nodes of its surfaces, or those about the least gaps of
    /// `pairings`; None where these do not hold what is left, and without contact.
    pub fn new(stiffness: &Stiffness, model: &Model, pairings: &[Option<Pairing>]) -> Option<Self> {
        let nodes = nodes(model, pairings);
        let mut place = vec![None; model.nodes.len()];
        nodes.iter().enumerate().for_each(|(k, node)| place[node.index()] = Some(k));
        let t = Elimination::new(&model.holds, &[]);
        let is_kept = |e: &usize| place[t.dof(*e).node().index()].is_some();
        let last: Vec<usize> = (0..t.size()).filter(is_kept).collect();
        if last.is_empty() {
            return None;
        }
        let kept: Vec<Dof> = last.iter().map(|e| t.dof(*e)).collect();
        let matrix = stiffness.reduced(&t);
        let whole_norm = matrix.norm();
        let schur = Schur::new(matrix, last)?;
        let own = |dof: &Dof| {
            let node = place[dof.node().index()].expect("its node is kept");
            2 * node + dof.direction()
        };
        let own: Vec<usize> = kept.iter().map(own).collect();
        let size = 2 * nodes.len();
        let mut reduced = DMatrix::zeros(size, size);
        for (j, column) in own.iter().zip(schur.complement().column_iter()) {
            own.iter().zip(&column).for_each(|(i, s)| reduced[(*i, *j)] = *s);
        }
        let number = |node: NodeId| place[node.index()].map(NodeId::new);
        let holds = model.holds.renumbered(nodes.len(), number);
        let norm = reduced.column_iter().map(|c| c.lp_norm(1)).fold(0.0, f64::max);
        Some(Reduction { t, schur, nodes, kept, stiffness: reduced, holds, norm, whole_norm })
    }

    /// Eliminates all but the kept equations from a load by degree of freedom, force, where restraints displace
    /// nodes by a `part` of what they do at last.
    pub fn eliminated(&self, stiffness: &Stiffness, load: &DVector<f64>, part: f64) -> ReducedLoad {
        let shift = self.t.shift() * part;
        ReducedLoad { shift: shift.clone(), ..self.unshifted(&(load - stiffness.times(&shift))) }
    }

    /// Eliminates all but the kept equations from a load by degree of freedom, force, where nothing is displaced.
    fn unshifted(&self, load: &DVector<f64>) -> ReducedLoad {
        let all = self.schur.eliminate(&self.t.load(load));
        let kept = self.own(self.kept.iter().zip(&all.last).map(|(dof, f)| (*dof, *f)));
        ReducedLoad { all, shift: DVector::zeros(load.len()), kept }
    }

    /// Returns the displacements by degree of freedom under a load, length, from those of the kept nodes.
    fn expand(&self, load: &ReducedLoad, kept: &DVector<f64>) -> DVector<f64> {
        let last = self.kept.iter().map(|dof| kept[self.place(*dof)]);
        let last = DVector::from_iterator(self.kept.len(), last);
        self.t.motion(&self.schur.expand(&load.all, &last)) + &load.shift
    }

    /// Returns the part of a vector by degree of freedom on the kept nodes, 0 at restrained ones.
    fn part(&self, all: &DVector<f64>) -> DVector<f64> {
        self.own(self.kept.iter().map(|dof| (*dof, all[dof.index()])))
    }

    /// Returns the vector by degree of freedom with a part on the kept nodes, 0 elsewhere.
    fn whole(&self, part: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.t.shift().len());
        self.kept.iter().for_each(|dof| all[dof.index()] = part[self.place(*dof)]);
        all
    }

    fn own(&self, values: impl Iterator<Item = (Dof, f64)>) -> DVector<f64> {
        let mut own = DVector::zeros(self.stiffness.nrows());
        values.for_each(|(dof, value)| own[self.place(dof)] = value);
        own
    }

    /// Returns where a degree of freedom of a kept node stands among theirs.
    fn place(&self, dof: Dof) -> usize {
        let node = self.nodes.binary_search(&dof.node()).expect("its node is kept");
        2 * node + dof.direction()
    }

    /// Returns a constraint by the places of the kept nodes; None where it binds another one.
    fn renumbered(&self, constraint: &Constraint) -> Option<Constraint> {
        let number = |node| self.nodes.binary_search(&node).ok().map(NodeId::new);
        let masters = constraint.masters.iter().map(|(node, w)| Some((number(*node)?, *w)));
        Some(Constraint {
            node: number(constraint.node)?,
            masters: masters.collect::<Option<_>>()?,
            motion: constraint.motion,
        })
    }
}

impl<'a> ReducedState<'a> {
    /// Factors the state that constraints impose; None where it is singular or nearly so, and where a
    /// constraint binds a node that is not kept.
    pub fn new(reduction: &'a Reduction, constraints: &[Constraint]) -> Option<Self> {
        let own = constraints.iter().map(|constraint| reduction.renumbered(constraint));
        let t = Elimination::closing(&reduction.holds, 1.0, &own.collect::<Option<Vec<_>>>()?);
        let factors = DenseCholesky::new(&t.matrix(&reduction.stiffness))?;
        Some(ReducedState { reduction, t, factors })
    }

    /// Returns the displacements by degree of freedom, length, under a load and `more` on kept nodes, by
    /// degree of freedom, force; and the relative residual of the kept equations. None where the factors
    /// are too far from the matrix.
    pub fn displacements(
        &self,
        load: &ReducedLoad,
        more: &DVector<f64>,
    ) -> Option<(DVector<f64>, f64)> {
        let Reduction { stiffness, norm, .. } = self.reduction;
        let kept = &load.kept + self.reduction.part(more);
        let f = self.t.load(&(kept - stiffness * self.t.shift()));
        let times = |q: &DVector<f64>| self.t.load(&(stiffness * self.t.motion(q)));
        let (q, residual) = refine(&self.factors, times, *norm, &f);
        let u = self.reduction.expand(load, &self.t.expand(&q));
        (residual <= ENOUGH).then_some((u, residual))
    }

    /// Returns the same refined until they solve the whole equations, under a `load` by degree of freedom,
    /// force; and the relative residual of these. None where they do not come there.
    pub fn refined(
        &self,
        stiffness: &Stiffness,
        load: &DVector<f64>,
        (reduced, more): (&ReducedLoad, &DVector<f64>),
    ) -> Option<(DVector<f64>, f64)> {
        let reduction = self.reduction;
        let (u, _) = self.displacements(reduced, more)?;
        let given = reduction.t.load(load);
        let rest = |u: &DVector<f64>| {
            let rest = load - stiffness.times(u);
            // The forces that keep constraints do no work.
            let left = self.t.load(&reduction.part(&rest));
            let mut inside = rest.clone();
            reduction.kept.iter().for_each(|dof| inside[dof.index()] = 0.0);
            let left = DVector::from_vec(vec![left.amax(), reduction.t.load(&inside).amax()]);
            (rest, backward_error(&left, reduction.whole_norm, u, &given))
        };
        let correction = |rest: &DVector<f64>| {
            let rest = reduction.unshifted(rest);
            let q = self.factors.solve(&self.t.load(&rest.kept));
            reduction.expand(&rest, &self.t.motion(&q))
        };
        let (u, error) = corrected(u, rest, correction);
        (error <= ENOUGH).then_some((u, error))
    }

    /// Returns K u − f under a load by degree of freedom, force; 0 but on the kept nodes.
    pub fn reaction(&self, u: &DVector<f64>, load: &ReducedLoad) -> DVector<f64> {
        let own = self.reduction.part(u);
        self.reduction.whole(&(&self.reduction.stiffness * own - &load.kept))
    }

    /// Returns for each of some loads on kept nodes, by degree of freedom, K u − f of the displacements under
    /// it without the shift of the constraints, force; 0 but on the kept nodes.
    pub fn responses(&self, loads: &[DVector<f64>]) -> Vec<DVector<f64>> {
        let own: Vec<DVector<f64>> = loads.iter().map(|load| self.reduction.part(load)).collect();
        let f: Vec<DVector<f64>> = own.iter().map(|f| self.t.load(f)).collect();
        let q = self.factors.solve_all(&DMatrix::from_columns(&f));
        let u: Vec<_> = q.column_iter().map(|q| self.t.motion(&q.into_owned())).collect();
        let force = &self.reduction.stiffness * DMatrix::from_columns(&u);
        let response = |(force, f): (_, &DVector<f64>)| self.reduction.whole(&(force - f));
        force.column_iter().zip(&own).map(response).collect()
    }
}

/// Returns the nodes of both surfaces, ascending, or of large ones the contact nodes with the least gaps and
/// what they face.
fn nodes(model: &Model, pairings: &[Option<Pairing>]) -> Vec<NodeId> {
    let (fewest, part) = MOST;
    let most = fewest.max((part * (model.free_dofs() as f64).sqrt()) as usize);
    let target = model.target_edges().flat_map(|edge| edge.nodes);
    let mut nodes: Vec<NodeId> = model.contact.nodes.iter().copied().chain(target).collect();
    nodes.sort_unstable();
    nodes.dedup();
    if nodes.len() <= most {
        return nodes;
    }
    let mut nearest: Vec<&Pairing> = pairings.iter().flatten().collect();
    nearest.sort_by(|a, b| a.gap.total_cmp(&b.gap));
    nodes = nearest.into_iter().take(most / 2).flat_map(Pairing::nodes).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
