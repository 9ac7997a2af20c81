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
//!
//! The search for a contact state goes on with S alone ([`OnKept`]); where every digit counts, the
//! factors of Tᵀ S T serve to refine the solution of the whole equations ([`Bound`]).

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::fmt;
use std::rc::Rc;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{DMatrix, DVector};

use super::contact::Pairing;
use super::elimination::{Constraint, Elimination};
use super::stiffness::Stiffness;
use crate::numbers::solve::{
    Condensed, DenseCholesky, Eliminated, Factors, SparseSymmetric, backward_error, largest_motion,
};
use crate::problem::model::{Dof, Model, NodeId};

/// The number of nodes of both surfaces up to which all are kept.
const SMALL: usize = 64;

/// The number of kept nodes beyond which a dense matrix of them takes longer, and more memory, than
/// the whole sparse matrix of a state: this many, or on fine meshes so much of the square root of the
/// number of equations, which is what a line across the mesh has.
const MOST: (f64, f64) = (600.0, 2.0);

/// The number of contact nodes of larger surfaces that are expected to come into contact, over the
/// square root of the number of equations; of fewer equations than these, those that the first contact
/// state binds.
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
    /// The load that was eliminated last.
    loaded: RefCell<Option<Loaded>>,
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
    /// Whether each degree of freedom is restrained or inside.
    is_outside: Vec<bool>,
    /// The largest row sum of |K|, force/length.
    norm: f64,
    /// The same of |S|.
    kept_norm: f64,
}

/// A load by degree of freedom, force, and what is left of it on the kept equations.
struct Loaded {
    condensation: Arc<Condensation>,
    load: DVector<f64>,
    eliminated: Rc<Eliminated>,
}

/// Tᵀ S T under one contact state, factored.
struct Small {
    /// The equation of the state for each column of `t`.
    columns: Vec<usize>,
    /// The rows of T of the kept degrees of freedom.
    t: Rows,
    factors: DenseCholesky<f64>,
}

/// The factors of Tᵀ K T under one contact state.
pub(super) struct Bound {
    condensation: Arc<Condensation>,
    /// The equation of the bodies and that of the state for each degree of freedom inside.
    inside: Vec<(usize, usize)>,
    small: Small,
}

/// The bodies under one contact state, in terms of what is kept of them.
pub(super) struct OnKept {
    condensation: Arc<Condensation>,
    /// s on the kept equations, length.
    shift: DVector<f64>,
    small: Small,
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
            loaded: RefCell::default(),
            expected: Vec::new(),
            begun: Cell::new(false),
            impossible: Cell::new(!model.has_contact()),
        }
    }

    /// Expects that the entries of the contact surface with the least gaps come into contact; of few
    /// equations, those that the first state binds.
    pub(super) fn expecting(mut self, pairings: &[Option<Pairing>]) -> Self {
        let (part, least) = EXPECTED;
        let equations = self.model.free_dofs();
        if equations < least {
            self.begun.set(true);
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

    /// Returns the bodies condensed to the nodes of `constraints` and others; None where the whole
    /// matrix is to be factored. On large surfaces of which nothing is expected the first state only
    /// shows which nodes are bound.
    pub(super) fn condensed(
        &self,
        stiffness: &Stiffness,
        constraints: &[Constraint],
    ) -> Option<Arc<Condensation>> {
        let first = !self.begun.replace(true);
        let unforeseen = first && !self.is_small() && self.expected.is_empty();
        if self.impossible.get() || unforeseen {
            return None;
        }
        let current = self.current.borrow().clone().filter(|c| c.has(constraints));
        if current.is_some() {
            return current;
        }
        let expected: &[NodeId] = if first { &self.expected } else { &[] };
        let nodes = self.nodes(constraints, expected);
        if nodes.len() > self.most() {
            return None;
        }
        let made = self.shared.condensed(stiffness, &self.model, nodes);
        self.impossible.set(made.is_none());
        self.current.replace(made.clone());
        made
    }

    /// Returns what is left of a load by degree of freedom on the kept equations of a state.
    pub(super) fn eliminated(&self, state: &OnKept, load: &DVector<f64>) -> Rc<Eliminated> {
        let condensation = &state.condensation;
        let mut last = self.loaded.borrow_mut();
        let known = last
            .take()
            .filter(|last| Arc::ptr_eq(&last.condensation, condensation) && last.load == *load);
        let loaded = known.unwrap_or_else(|| Loaded {
            condensation: Arc::clone(condensation),
            load: load.clone(),
            eliminated: Rc::new(condensation.eliminated(load)),
        });
        Rc::clone(&last.insert(loaded).eliminated)
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
        let outside = |(restrained, kept): (&bool, &bool)| *restrained || !kept;
        let is_outside = model.restrained.iter().zip(&is_kept).map(outside).collect();
        let (model, norm) = (Arc::clone(model), matrix.norm());
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
    fn eliminated(&self, load: &DVector<f64>) -> Eliminated {
        let load = self.dofs.iter().map(|dof| load[dof.index()]);
        self.condensed.eliminate(&DVector::from_iterator(self.dofs.len(), load))
    }

    /// Returns the part on the kept equations of a vector by degree of freedom.
    fn part(&self, all: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(self.kept.len(), self.kept.iter().map(|dof| all[dof.index()]))
    }

    /// Returns the vector by degree of freedom with a part on the kept equations, 0 elsewhere.
    fn whole(&self, part: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.is_kept.len());
        self.kept.iter().zip(part).for_each(|(dof, x)| all[dof.index()] = *x);
        all
    }

    /// Returns the displacements by degree of freedom from those of the kept equations.
    fn expand(&self, load: &Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        let mut u = DVector::zeros(self.is_kept.len());
        let all = self.condensed.expand(load, kept);
        self.dofs.iter().zip(&all).for_each(|(dof, x)| u[dof.index()] = *x);
        u
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

impl Small {
    /// Factors Tᵀ S T; None where that is singular or nearly so.
    fn new(condensation: &Condensation, all: &Elimination) -> Option<Self> {
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
        let matrix = t.reduced(condensation.condensed.schur());
        let factors = DenseCholesky::new(&matrix).ok()?;
        let motion = largest_motion(&factors, &matrix.diagonal());
        (motion < LOOSE).then_some(Small { columns, t, factors })
    }

    /// Returns the displacements of the kept equations under a load on them, without shift.
    fn under(&self, load: &DVector<f64>) -> DVector<f64> {
        self.t.expand(&self.factors.solve(&self.t.load(load)))
    }
}

impl OnKept {
    /// Factors a contact state on the kept equations; None where it is singular or nearly so.
    pub(super) fn new(condensation: Arc<Condensation>, constraints: &[Constraint]) -> Option<Self> {
        let t = Elimination::closing(&condensation.is_outside, constraints);
        let (shift, small) = (condensation.part(t.shift()), Small::new(&condensation, &t)?);
        Some(OnKept { condensation, shift, small })
    }

    /// Returns the displacements by degree of freedom under a load, length, and the relative residual
    /// of the kept equations; None where their factors are too far from the matrix.
    pub(super) fn displacements(&self, load: &Eliminated) -> Option<(DVector<f64>, f64)> {
        let (condensation, Small { t, factors, .. }) = (&self.condensation, &self.small);
        let schur = condensation.condensed.schur();
        let f = t.load(&(&load.kept - schur * &self.shift));
        let times = |q: &DVector<f64>| t.load(&(schur * t.expand(q)));
        let (q, residual) = refine(factors, times, condensation.kept_norm, &f).ok()?;
        Some((condensation.expand(load, &(t.expand(&q) + &self.shift)), residual))
    }

    /// Returns K u − f by degree of freedom, force; 0 but on the kept equations.
    pub(super) fn reaction(&self, u: &DVector<f64>, load: &Eliminated) -> DVector<f64> {
        let force = self.condensation.condensed.schur() * self.condensation.part(u);
        self.condensation.whole(&(force - &load.kept))
    }

    /// Returns the same of the displacements without the shift of the constraints, under a load `f`
    /// on kept nodes alone.
    pub(super) fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        let f = self.condensation.part(load);
        let force = self.condensation.condensed.schur() * self.small.under(&f);
        self.condensation.whole(&(force - f))
    }

    /// Returns those displacements by degree of freedom, length, and the forces K u that keep them on
    /// the kept equations.
    pub(super) fn under(&self, load: &DVector<f64>) -> [DVector<f64>; 2] {
        let condensation = &self.condensation;
        let f = condensation.part(load);
        let u = self.small.under(&f);
        let force = condensation.whole(&(condensation.condensed.schur() * &u));
        [condensation.expand(&condensation.condensed.on_kept(f), &u), force]
    }
}

impl Bound {
    /// Factors Tᵀ S T; None where that is singular or nearly so.
    pub(super) fn new(condensation: Arc<Condensation>, all: &Elimination) -> Option<Self> {
        let mut inside = Vec::with_capacity(condensation.dofs.len());
        for (e, dof) in condensation.dofs.iter().enumerate() {
            if !condensation.is_kept[dof.index()] {
                let &[(column, _)] = all.row(*dof) else { return None };
                inside.push((e, column));
            }
        }
        let small = Small::new(&condensation, all)?;
        Some(Bound { condensation, inside, small })
    }

    /// Returns K u − f under a load `f` by degree of freedom on kept nodes alone, force, where u are
    /// the displacements without the shift of the constraints.
    pub(super) fn reaction(&self, load: &DVector<f64>) -> DVector<f64> {
        let u = self.small.under(&self.condensation.part(load));
        self.condensation.whole(&(self.condensation.condensed.schur() * u)) - load
    }

    /// Returns the largest row sum of |K| without constraints, force/length.
    pub(super) fn norm(&self) -> f64 {
        self.condensation.norm
    }
}

impl Factors<f64> for Bound {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let (condensed, Small { columns, t, factors }) =
            (&self.condensation.condensed, &self.small);
        let mut load = DVector::zeros(self.condensation.dofs.len());
        self.inside.iter().for_each(|(e, column)| load[*e] = b[*column]);
        let eliminated = condensed.eliminate(&load);
        let own = DVector::from_iterator(columns.len(), columns.iter().map(|c| b[*c]));
        let q = factors.solve(&(own + t.load(&eliminated.kept)));
        let u = condensed.expand(&eliminated, &t.expand(&q));
        let mut x = DVector::zeros(b.len());
        self.inside.iter().for_each(|(e, column)| x[*column] = u[*e]);
        columns.iter().zip(&q).for_each(|(column, q)| x[*column] = *q);
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
    refine(factors, times, norm, f)
}

/// Solves A q = `f`, where `times` multiplies by A, whose norm is `norm`.
fn refine(
    factors: &dyn Factors<f64>,
    times: impl Fn(&DVector<f64>) -> DVector<f64>,
    norm: f64,
    f: &DVector<f64>,
) -> Result<(DVector<f64>, f64), (DVector<f64>, f64)> {
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
