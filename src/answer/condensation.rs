//! The stiffness condensed to the nodes that contact can bind. The bodies are factored once; each
//! contact state Tᵀ K T is solved on these nodes alone.
//!
//! ```text
//!   K --Condensed--> S on the kept nodes --T of a state--> Tᵀ S T, dense, factored for each state
//! ```
//!
//! Kept are all nodes of small surfaces, else those that a state binds and their neighbours; when a
//! state binds others, the bodies are condensed anew. Where that cannot be done or trusted, a state
//! has no such factors: its whole matrix is to be factored.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{DMatrix, DVector};

use super::contact::Pairing;
use super::elimination::{Constraint, Elimination};
use super::stiffness::Stiffness;
use crate::numbers::solve::{
    Condensed, DenseCholesky, Factors, SparseSymmetric, backward_error, largest_motion,
};
use crate::problem::model::{Dof, Model, NodeId};

/// The number of nodes of both surfaces up to which all are kept.
const SMALL: usize = 64;

/// The number of kept nodes beyond which a dense matrix of them takes longer, and more memory, than
/// the whole sparse matrix of a state: this many, or on fine meshes so much of the square root of the
/// number of equations, which is what a line across the mesh has.
const MOST: (f64, f64) = (600.0, 2.0);

/// The number of contact nodes of larger surfaces that are expected to come into contact, over the
/// square root of the number of equations; of fewer equations than these, nothing is expected, as the
/// first contact state costs little.
const EXPECTED: (f64, usize) = (0.85, 10_000);

/// The number of neighbours that are kept on either side of a bound node of a larger surface, and
/// the part of the number of bound nodes that comes on top.
const MARGIN: (usize, f64) = (8, 0.1);

/// The motion under loads of 1, both scaled to a unit diagonal, beyond which a state is left to the
/// factors of its whole matrix, which tell a singular one.
const LOOSE: f64 = 1e10;

/// The relative residual at which refinement ends.
const REFINED: f64 = 4.0 * f64::EPSILON;

/// The relative residual that is enough where refinement brings no more.
const ENOUGH: f64 = 32.0 * f64::EPSILON;

/// The part of its residual to which a step of refinement must bring the next one.
const CONTRACTION: f64 = 0.2;

/// The condensed bodies of a scene, shared by all that is asked of it: each is factored once.
#[derive(Clone, Default)]
pub struct Shared(Arc<Mutex<Vec<Arc<Condensation>>>>);

impl fmt::Debug for Shared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the condensed bodies")
    }
}

impl Shared {
    /// Returns the bodies of `model` condensed to `nodes`; None where they cannot be.
    fn condensed(
        &self,
        stiffness: &Stiffness,
        model: &Arc<Model>,
        nodes: BTreeSet<NodeId>,
    ) -> Option<Arc<Condensation>> {
        let mut made = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = made.iter().find(|known| known.nodes == nodes && known.is_of(model)) {
            return Some(Arc::clone(known));
        }
        let condensation = Arc::new(Condensation::new(stiffness, model, nodes)?);
        // Those of large bodies take much memory: of each model the last ones are kept.
        made.retain(|known| !known.is_of(model));
        made.push(Arc::clone(&condensation));
        Some(condensation)
    }
}

/// The bodies of a run, condensed when a contact state first needs it.
pub(super) struct Bodies {
    model: Arc<Model>,
    shared: Shared,
    /// The contact surface and the nodes of the target surface, each in its order.
    surfaces: [Vec<NodeId>; 2],
    current: RefCell<Option<Arc<Condensation>>>,
    /// The nodes to keep for the first contact state of large surfaces; none where only that state
    /// shows which are bound.
    expected: Vec<NodeId>,
    /// Whether a contact state was asked for.
    begun: Cell<bool>,
    /// Whether they cannot be, or need not, as there is no contact.
    impossible: Cell<bool>,
}

/// The stiffness condensed to some nodes.
pub struct Condensation {
    model: Arc<Model>,
    nodes: BTreeSet<NodeId>,
    condensed: Condensed,
    /// The degree of freedom of each equation of the unconstrained bodies.
    dofs: Vec<Dof>,
    /// The degrees of freedom that are kept.
    kept: Vec<Dof>,
    /// Whether each degree of freedom is kept, or restrained at a kept node.
    is_kept: Vec<bool>,
    /// The largest row sum of |K|, force/length.
    norm: f64,
}

/// The factors of Tᵀ K T under one contact state.
pub(super) struct Bound {
    condensation: Arc<Condensation>,
    /// The equation of the bodies and that of the state for each degree of freedom inside.
    inside: Vec<(usize, usize)>,
    /// The equation of the state for each column of `t`.
    columns: Vec<usize>,
    /// The rows of T of the kept degrees of freedom.
    t: Rows,
    factors: DenseCholesky<f64>,
}

/// Returns the nodes of the contact surface and those of the target surface, each in its order.
fn surfaces(model: &Model) -> [Vec<NodeId>; 2] {
    let mut target: Vec<NodeId> = model.target_edges().flat_map(|edge| edge.nodes).collect();
    target.dedup();
    [model.contact.nodes.clone(), target]
}

/// Returns the number of equations to which the bodies are condensed where `near` contact nodes come
/// to the target: an estimate where the surfaces are large.
pub fn kept_equations(model: &Model, near: usize) -> usize {
    let surfaces = surfaces(model).concat();
    let nodes: BTreeSet<NodeId> = surfaces.iter().copied().collect();
    let free = |node: &NodeId| model.restraints_of(*node).iter().filter(|held| !**held).count();
    let all = nodes.iter().map(free).sum();
    let (neighbours, part) = MARGIN;
    let bound = (near as f64 * (1.0 + part)) as usize + 2 * neighbours;
    if surfaces.len() <= SMALL { all } else { all.min(4 * bound) }
}

impl Bodies {
    pub(super) fn new(model: &Arc<Model>, shared: &Shared) -> Self {
        Bodies {
            model: Arc::clone(model),
            shared: shared.clone(),
            surfaces: surfaces(model),
            current: RefCell::default(),
            expected: Vec::new(),
            begun: Cell::new(false),
            impossible: Cell::new(!model.has_contact()),
        }
    }

    /// Expects that the entries of the contact surface with the least gaps come into contact.
    pub(super) fn expecting(mut self, pairings: &[Option<Pairing>]) -> Self {
        let (part, least) = EXPECTED;
        let equations = self.model.free_dofs();
        if equations < least {
            return self;
        }
        let mut nearest: Vec<&Pairing> = pairings.iter().flatten().collect();
        nearest.sort_by(|a, b| a.gap.total_cmp(&b.gap));
        let most = part * (equations as f64).sqrt();
        let nodes = |p: &&Pairing| {
            let masters = p.masters.iter().map(|(master, _)| *master);
            std::iter::once(p.node).chain(masters).collect::<Vec<_>>()
        };
        self.expected = nearest.iter().take(most as usize).flat_map(nodes).collect();
        self
    }

    /// Returns the factors of Tᵀ K T under `constraints`; None where the whole matrix is to be
    /// factored. On large surfaces of which nothing is expected the first state only shows which nodes
    /// are bound.
    pub(super) fn factors(
        &self,
        stiffness: &Stiffness,
        t: &Elimination,
        constraints: &[Constraint],
    ) -> Option<Bound> {
        let first = !self.begun.replace(true);
        let unforeseen = first && !self.is_small() && self.expected.is_empty();
        if self.impossible.get() || unforeseen {
            return None;
        }
        let current = self.current.borrow().clone().filter(|c| c.has(constraints));
        let condensation = match current {
            Some(condensation) => condensation,
            None => {
                let expected: &[NodeId] = if first { &self.expected } else { &[] };
                let nodes = self.nodes(constraints, expected);
                if nodes.len() > self.most() {
                    return None;
                }
                let made = self.shared.condensed(stiffness, &self.model, nodes);
                self.impossible.set(made.is_none());
                self.current.replace(made.clone());
                made?
            }
        };
        Bound::new(condensation, t)
    }

    /// Returns the condensed bodies that served last; None where there are none.
    pub(super) fn last(&self) -> Option<Arc<Condensation>> {
        self.current.borrow().clone()
    }

    fn is_small(&self) -> bool {
        self.surfaces.iter().map(Vec::len).sum::<usize>() <= SMALL
    }

    fn most(&self) -> usize {
        MOST.0.max(MOST.1 * (self.model.free_dofs() as f64).sqrt()) as usize
    }

    /// Returns the nodes to be kept for `constraints` and for what is expected.
    fn nodes(&self, constraints: &[Constraint], expected: &[NodeId]) -> BTreeSet<NodeId> {
        let all = self.surfaces.iter().flatten().copied();
        if self.is_small() {
            return all.collect();
        }
        let bound: BTreeSet<NodeId> = constraints
            .iter()
            .flat_map(Constraint::nodes)
            .chain(expected.iter().copied())
            .collect();
        let mut nodes = bound.clone();
        for surface in &self.surfaces {
            let at: Vec<usize> =
                (0..surface.len()).filter(|i| bound.contains(&surface[*i])).collect();
            let margin = MARGIN.0 + (MARGIN.1 * at.len() as f64) as usize;
            let mut from = 0;
            for i in at {
                let last = (i + margin).min(surface.len() - 1);
                nodes.extend(surface.get(from.max(i.saturating_sub(margin))..=last).unwrap_or(&[]));
                from = last + 1;
            }
        }
        nodes
    }
}

impl Condensation {
    fn new(stiffness: &Stiffness, model: &Arc<Model>, nodes: BTreeSet<NodeId>) -> Option<Self> {
        let free = Elimination::new(&model.restrained, &[]);
        let matrix: SparseSymmetric = stiffness.reduced(&free);
        let mut is_kept = vec![false; model.dofs()];
        nodes.iter().flat_map(|node| node.dofs()).for_each(|dof| is_kept[dof.index()] = true);
        let dofs: Vec<Dof> = (0..free.size()).map(|column| free.dof(column)).collect();
        let equations: Vec<usize> = (0..dofs.len()).filter(|e| is_kept[dofs[*e].index()]).collect();
        let kept = equations.iter().map(|e| dofs[*e]).collect();
        let condensed = Condensed::new(&matrix, &equations)?;
        let (model, norm) = (Arc::clone(model), matrix.norm());
        Some(Condensation { model, nodes, condensed, dofs, kept, is_kept, norm })
    }

    /// Returns whether it is that of the bodies of `model`.
    fn is_of(&self, model: &Model) -> bool {
        let (own, other) = (&*self.model, model);
        own.plane == other.plane
            && own.thickness == other.thickness
            && own.restrained == other.restrained
            && own.nodes == other.nodes
            && own.triangles == other.triangles
    }

    /// Returns whether it keeps every node that `constraints` name.
    pub(super) fn has(&self, constraints: &[Constraint]) -> bool {
        let mut nodes = constraints.iter().flat_map(Constraint::nodes);
        nodes.all(|node| self.is_kept[node.dofs()[0].index()])
    }
}

impl Bound {
    /// Factors Tᵀ S T; None where that is singular or nearly so.
    pub(super) fn new(condensation: Arc<Condensation>, all: &Elimination) -> Option<Self> {
        let mut column_of = vec![usize::MAX; all.size()];
        let mut columns = Vec::new();
        for (column, _) in condensation.kept.iter().flat_map(|dof| all.row(*dof)) {
            if column_of[*column] == usize::MAX {
                column_of[*column] = columns.len();
                columns.push(*column);
            }
        }
        let local = |(column, weight): &(usize, f64)| (column_of[*column], *weight);
        let rows = condensation.kept.iter().map(|dof| all.row(*dof).iter().map(local).collect());
        let t = Rows { rows: rows.collect(), columns: columns.len() };
        let mut inside = Vec::with_capacity(condensation.dofs.len());
        for (e, dof) in condensation.dofs.iter().enumerate() {
            if !condensation.is_kept[dof.index()] {
                let &[(column, _)] = all.row(*dof) else { return None };
                inside.push((e, column));
            }
        }
        let matrix = t.reduced(condensation.condensed.schur());
        let factors = DenseCholesky::new(&matrix).ok()?;
        let motion = largest_motion(&factors, &matrix.diagonal());
        (motion < LOOSE).then_some(Bound { condensation, inside, columns, t, factors })
    }
}

impl Bound {
    /// Returns K u − f under a load `f` by degree of freedom on kept nodes alone, force, where u are
    /// the displacements without the shift of the constraints.
    pub(super) fn reaction(&self, load: &DVector<f64>) -> DVector<f64> {
        let Condensation { kept, condensed, .. } = &*self.condensation;
        let f = DVector::from_iterator(kept.len(), kept.iter().map(|dof| load[dof.index()]));
        let u = self.t.expand(&self.factors.solve(&self.t.load(&f)));
        let force = condensed.schur() * u;
        let mut reaction = -load;
        kept.iter().zip(&force).for_each(|(dof, force)| reaction[dof.index()] += force);
        reaction
    }

    /// Returns the largest row sum of |K| without constraints, force/length.
    pub(super) fn norm(&self) -> f64 {
        self.condensation.norm
    }
}

impl Factors<f64> for Bound {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let condensed = &self.condensation.condensed;
        let mut load = DVector::zeros(self.condensation.dofs.len());
        self.inside.iter().for_each(|(e, column)| load[*e] = b[*column]);
        let eliminated = condensed.eliminate(&load);
        let own = DVector::from_iterator(self.columns.len(), self.columns.iter().map(|c| b[*c]));
        let q = self.factors.solve(&(own + self.t.load(&eliminated.kept)));
        let u = condensed.expand(&eliminated, &self.t.expand(&q));
        let mut x = DVector::zeros(b.len());
        self.inside.iter().for_each(|(e, column)| x[*column] = u[*e]);
        self.columns.iter().zip(&q).for_each(|(column, q)| x[*column] = *q);
        x
    }
}

/// Rows of few entries: column and weight.
struct Rows {
    rows: Vec<Vec<(usize, f64)>>,
    columns: usize,
}

impl Rows {
    /// Returns Tᵀ S T of a dense S.
    fn reduced(&self, s: &DMatrix<f64>) -> DMatrix<f64> {
        let mut product = DMatrix::zeros(s.nrows(), self.columns);
        for (l, row) in self.rows.iter().enumerate() {
            for (column, weight) in row {
                product.column_mut(*column).axpy(*weight, &s.column(l), 1.0);
            }
        }
        let mut reduced = DMatrix::zeros(self.columns, self.columns);
        for (mut column, product) in reduced.column_iter_mut().zip(product.column_iter()) {
            for (row, value) in self.rows.iter().zip(product.iter()) {
                row.iter().for_each(|(r, weight)| column[*r] += weight * value);
            }
        }
        reduced
    }

    /// Returns Tᵀ f.
    fn load(&self, f: &DVector<f64>) -> DVector<f64> {
        let mut load = DVector::zeros(self.columns);
        for (row, f) in self.rows.iter().zip(f) {
            row.iter().for_each(|(column, weight)| load[*column] += weight * f);
        }
        load
    }

    /// Returns T q.
    fn expand(&self, q: &DVector<f64>) -> DVector<f64> {
        let of_row = |row: &Vec<(usize, f64)>| row.iter().map(|(column, w)| w * q[*column]).sum();
        DVector::from_iterator(self.rows.len(), self.rows.iter().map(of_row))
    }
}

/// Solves Tᵀ K T q = `f` by `factors` of nearly that matrix, whose norm is `norm`, and refines;
/// returns q and its relative residual.
///
/// # Errors
/// The factors are too far from the matrix; returns q so far.
pub(super) fn refined(
    stiffness: &Stiffness,
    t: &Elimination,
    (factors, norm): (&dyn Factors<f64>, f64),
    f: &DVector<f64>,
) -> Result<(DVector<f64>, f64), (DVector<f64>, f64)> {
    let times = |q: &DVector<f64>| t.load(&stiffness.times(&(t.expand(q) - t.shift())));
    let mut q = factors.solve(f);
    let mut before = f64::INFINITY;
    loop {
        let rest = f - times(&q);
        let error = backward_error(&rest, norm, &q, f);
        if error <= REFINED || (error <= ENOUGH && error > CONTRACTION * before) {
            return Ok((q, error));
        }
        if error.is_nan() || error > CONTRACTION * before {
            return Err((q, error));
        }
        before = error;
        q += factors.solve(&rest);
    }
}
