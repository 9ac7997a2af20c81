//! A contact state on the kept nodes: Tᵀ S T, factored; and solutions by factors of nearly the right matrix,
//! refined until they are those of the right one.

use std::rc::Rc;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use smallvec::SmallVec;

use super::gaps::FactoredGaps;
use super::schur::{Condensation, Eliminated, holds};
use crate::elimination::{Constraint, Elimination};
use crate::stiffness::Stiffness;
use numbers::solve::{DenseCholesky, Factors, Normed, backward_error};
use problem::model::{Dof, NodeId};

/// The relative residual at which refinement ends.
const REFINED: f64 = 4.0 * f64::EPSILON;

/// The relative residual that is enough where refinement brings no more.
const ENOUGH: f64 = 32.0 * f64::EPSILON;

/// The part of its residual to which a step of refinement must bring the next one.
const CONTRACTION: f64 = 0.2;

/// The bodies under one contact state, in terms of what is kept of them: Tᵀ S T, factored.
pub struct KeptState {
    pub(super) condensation: Arc<Condensation>,
    /// The rows of T of the kept degrees of freedom.
    t: Rows,
    factors: Box<dyn Factors<f64> + Send + Sync>,
    /// s on the kept equations, length.
    shift: DVector<f64>,
}

/// The factors of Tᵀ K T under one contact state, by those of Tᵀ S T.
pub struct WholeFactors {
    /// Its shift is 0.
    kept: KeptState,
    /// The equation of the state for each column of T.
    columns: Vec<usize>,
    /// The index of each degree of freedom inside, and its equation of the state.
    inside: Vec<(usize, usize)>,
}

/// Displacements of the kept equations, from which those inside the bodies follow.
#[derive(Clone)]
pub struct Interior {
    condensation: Arc<Condensation>,
    load: Rc<Eliminated>,
    /// Those of the kept equations, length.
    kept: DVector<f64>,
}

impl KeptState {
    /// Factors Tᵀ S T with a shift s on the kept equations; None where that is singular or nearly so.
    fn factored(condensation: Arc<Condensation>, t: Rows, shift: DVector<f64>) -> Option<Self> {
        let matrix = t.reduced(condensation.schur());
        let factors = DenseCholesky::new(&matrix).ok()?;
        let is_held = holds(&factors, &matrix.diagonal());
        is_held.then(|| KeptState { condensation, t, factors: Box::new(factors), shift })
    }

    /// Factors the state that constraints impose; None where it is singular or nearly so.
    pub(super) fn new(condensation: Arc<Condensation>, constraints: &[Constraint]) -> Option<Self> {
        let (t, dofs) = condensation.closing(constraints);
        let shift = DVector::from_iterator(dofs.len(), dofs.iter().map(|d| t.shift()[d.index()]));
        let (t, _) = rows(&t, dofs);
        KeptState::factored(condensation, t, shift)
    }

    /// Takes a state that holds gaps and slips.
    pub(super) fn holding(condensation: Arc<Condensation>, held: FactoredGaps) -> Self {
        let FactoredGaps { t, shift, factors } = held;
        KeptState { condensation, t, factors: Box::new(factors), shift }
    }

    /// Returns the displacements of the kept equations under a load, length, and their relative residual;
    /// None where the factors are too far from the matrix.
    pub fn displacements(&self, load: &Eliminated) -> Option<(DVector<f64>, f64)> {
        let schur = self.condensation.schur();
        let f = self.t.load(&(&load.kept - schur * &self.shift));
        let times = |q: &DVector<f64>| self.t.load(&(schur * self.t.expand(q)));
        let norm = self.condensation.kept_norm;
        let (q, residual) = refine(&*self.factors, times, norm, &f).ok()?;
        Some((self.t.expand(&q) + &self.shift, residual))
    }

    /// Returns what gives the displacements inside, under a load, from those of the `kept` equations,
    /// length.
    pub(crate) fn interior(&self, load: &Rc<Eliminated>, kept: DVector<f64>) -> Interior {
        Interior { condensation: Arc::clone(&self.condensation), load: Rc::clone(load), kept }
    }

    /// Returns K u − f by degree of freedom, force, for displacements of the kept equations; 0 but on
    /// these.
    pub(crate) fn reaction(&self, u: &DVector<f64>, load: &Eliminated) -> DVector<f64> {
        self.condensation.whole(&(self.condensation.schur() * u - &load.kept))
    }

    /// Returns K u − f by degree of freedom under a load `f` on kept nodes alone, force, where u are
    /// the displacements without the shift of the constraints; 0 but on the kept equations.
    pub(crate) fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        let f = self.condensation.part(load);
        let force = self.condensation.schur() * self.under(&f);
        self.condensation.whole(&(force - f))
    }

    /// Returns those displacements of the kept equations, length, and the forces K u that keep them, by
    /// degree of freedom.
    pub(crate) fn unshifted(&self, load: &DVector<f64>) -> [DVector<f64>; 2] {
        let u = self.under(&self.condensation.part(load));
        let force = self.condensation.whole(&(self.condensation.schur() * &u));
        [u, force]
    }

    fn under(&self, load: &DVector<f64>) -> DVector<f64> {
        self.t.expand(&self.factors.solve(&self.t.load(load)))
    }
}

impl Interior {
    /// Returns whether a node's displacements are among those of the surfaces.
    pub(crate) fn knows(&self, node: NodeId) -> bool {
        self.condensation.bodies.is_kept[node.dofs()[0].index()]
    }

    /// Returns whether those are the displacements of all nodes of both surfaces.
    pub(crate) fn knows_surfaces(&self) -> bool {
        self.condensation.bodies.has_surfaces
    }

    /// Returns the displacements of the surfaces by degree of freedom, length; 0 elsewhere.
    pub(crate) fn on_surfaces(&self) -> DVector<f64> {
        self.condensation.expand_on_surfaces(&self.load, &self.kept)
    }

    /// Returns the displacements by degree of freedom, length.
    pub(crate) fn expand(&self) -> DVector<f64> {
        self.condensation.expand(&self.load, &self.kept)
    }
}

impl WholeFactors {
    /// Factors Tᵀ S T; None where that is singular or nearly so, and where a constraint binds what is not
    /// kept.
    pub(crate) fn new(condensation: Arc<Condensation>, all: &Elimination) -> Option<Self> {
        let mut inside = Vec::with_capacity(condensation.bodies.dofs.len());
        for dof in &condensation.bodies.dofs {
            if !condensation.is_kept[dof.index()] {
                let &[(column, _)] = all.row(*dof) else { return None };
                inside.push((dof.index(), column));
            }
        }
        let (t, columns) = rows(all, &condensation.kept);
        let shift = DVector::zeros(condensation.kept.len());
        let kept = KeptState::factored(condensation, t, shift)?;
        Some(WholeFactors { kept, columns, inside })
    }

    /// Returns what [`KeptState::response`] does.
    pub(crate) fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        self.kept.response(load)
    }
}

impl Normed for WholeFactors {
    /// Returns that of K without constraints, force/length.
    fn norm(&self) -> f64 {
        self.kept.condensation.bodies.condensed.norm()
    }
}

impl Factors<f64> for WholeFactors {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let KeptState { condensation, t, factors, .. } = &self.kept;
        let mut load = DVector::zeros(condensation.is_kept.len());
        self.inside.iter().for_each(|(dof, column)| load[*dof] = b[*column]);
        let eliminated = condensation.eliminated(&load);
        let columns = &self.columns;
        let own = DVector::from_iterator(columns.len(), columns.iter().map(|c| b[*c]));
        let q = factors.solve(&(own + t.load(&eliminated.kept)));
        let u = condensation.expand(&eliminated, &t.expand(&q));
        let mut x = DVector::zeros(b.len());
        self.inside.iter().for_each(|(dof, column)| x[*column] = u[*dof]);
        columns.iter().zip(&q).for_each(|(column, q)| x[*column] = *q);
        x
    }
}

/// Returns the rows of T of some degrees of freedom, with their columns numbered as they come; and which
/// equation of the state each of these is.
fn rows(all: &Elimination, dofs: &[Dof]) -> (Rows, Vec<usize>) {
    let mut column_of = vec![usize::MAX; all.size()];
    let mut columns = Vec::new();
    for (column, _) in dofs.iter().flat_map(|dof| all.row(*dof)) {
        if column_of[*column] == usize::MAX {
            column_of[*column] = columns.len();
            columns.push(*column);
        }
    }
    let own = |(column, weight): &(usize, f64)| (column_of[*column], *weight);
    let rows = dofs.iter().map(|dof| all.row(*dof).iter().map(own).collect());
    (Rows { rows: rows.collect(), columns: columns.len() }, columns)
}

/// Entries of a row: column and weight, of most rows one.
pub(super) type Row = SmallVec<[(usize, f64); 1]>;

/// Rows of few entries.
pub(super) struct Rows {
    pub(super) rows: Vec<Row>,
    pub(super) columns: usize,
}

impl Rows {
    /// Returns the lower triangle of Tᵀ S T of a dense S.
    pub(super) fn reduced(&self, s: &DMatrix<f64>) -> DMatrix<f64> {
        let mut of_column = vec![Row::new(); self.columns];
        for (l, row) in self.rows.iter().enumerate() {
            row.iter().for_each(|(column, weight)| of_column[*column].push((l, *weight)));
        }
        let mut reduced = DMatrix::zeros(self.columns, self.columns);
        let mut product = DVector::zeros(s.nrows());
        for (c, entries) in of_column.iter().enumerate() {
            product.fill(0.0);
            for (l, weight) in entries {
                product.axpy(*weight, &s.column(*l), 1.0);
            }
            for (row, value) in self.rows.iter().zip(product.iter()) {
                for (r, weight) in row.iter().filter(|(r, _)| *r >= c) {
                    reduced[(*r, c)] += weight * value;
                }
            }
        }
        reduced
    }

    /// Returns Tᵀ f.
    pub(super) fn load(&self, f: &DVector<f64>) -> DVector<f64> {
        let mut load = DVector::zeros(self.columns);
        for (row, f) in self.rows.iter().zip(f) {
            row.iter().for_each(|(column, weight)| load[*column] += weight * f);
        }
        load
    }

    /// Returns T q.
    pub(super) fn expand(&self, q: &DVector<f64>) -> DVector<f64> {
        let of_row = |row: &Row| row.iter().map(|(column, w)| w * q[*column]).sum();
        DVector::from_iterator(self.rows.len(), self.rows.iter().map(of_row))
    }

    /// Returns the columns that `place` gives one among those that are left, of which there are `columns`.
    pub(super) fn left(&self, place: &[Option<usize>], columns: usize) -> Rows {
        let entry = |(column, weight): &(usize, f64)| Some((place[*column]?, *weight));
        let rows = self.rows.iter().map(|row| row.iter().filter_map(entry).collect());
        Rows { rows: rows.collect(), columns }
    }
}

/// Solves Tᵀ K T q = `f` by `factors` of nearly that matrix, and refines; returns q and its relative
/// residual.
///
/// # Errors
/// The factors are too far from the matrix; returns q so far.
pub(crate) fn refined(
    stiffness: &Stiffness,
    t: &Elimination,
    factors: &dyn Normed,
    f: &DVector<f64>,
) -> Result<(DVector<f64>, f64), (DVector<f64>, f64)> {
    let times = |q: &DVector<f64>| t.load(&stiffness.times(&(t.expand(q) - t.shift())));
    refine(factors, times, factors.norm(), f)
}

/// Solves A q = `f`, where `times` multiplies by A, whose norm is `norm`.
///
/// # Errors
/// The refinement does not converge.
pub fn refine(
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
