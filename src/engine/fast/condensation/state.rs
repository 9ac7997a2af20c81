//! A contact state on the kept nodes: Tᵀ S T, factored.

use std::rc::Rc;
use std::sync::Arc;

use nalgebra::DVector;

use super::gaps::Held;
use super::refinement::refine;
use super::rows::Rows;
use super::schur::{Condensation, Eliminated, holds};
use crate::elimination::{Constraint, Elimination};
use numbers::solve::{DenseCholesky, Factors, Normed};
use problem::model::{Dof, NodeId};

/// Tᵀ S T under one contact state, factored.
struct Small {
    condensation: Arc<Condensation>,
    /// The rows of T of the kept degrees of freedom.
    t: Rows,
    factors: Box<dyn Factors<f64> + Send + Sync>,
}

/// The bodies under one contact state, in terms of what is kept of them.
pub struct OnKept {
    small: Small,
    /// s on the kept equations, length.
    shift: DVector<f64>,
}

/// Displacements of the kept equations, from which those inside the bodies follow.
#[derive(Clone)]
pub struct Inside {
    condensation: Arc<Condensation>,
    load: Rc<Eliminated>,
    /// Those of the kept equations, length.
    kept: DVector<f64>,
}

/// The factors of Tᵀ K T under one contact state.
pub struct Bound {
    small: Small,
    /// The equation of the state for each column of T.
    columns: Vec<usize>,
    /// The index of each degree of freedom inside, and its equation of the state.
    inside: Vec<(usize, usize)>,
}

impl Small {
    /// Factors Tᵀ S T; None where that is singular or nearly so.
    fn new(condensation: Arc<Condensation>, t: Rows) -> Option<Self> {
        let matrix = t.reduced(condensation.schur());
        let factors = DenseCholesky::new(&matrix).ok()?;
        holds(&factors, &matrix.diagonal()).then(|| Small {
            condensation,
            t,
            factors: Box::new(factors),
        })
    }

    /// Returns the displacements of the kept equations under a load on them, without shift.
    fn under(&self, load: &DVector<f64>) -> DVector<f64> {
        self.t.expand(&self.factors.solve(&self.t.load(load)))
    }

    /// Returns K u − f by degree of freedom under a load `f` on kept nodes alone, force, where u are
    /// the displacements without the shift of the constraints; 0 but on the kept equations.
    fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        let f = self.condensation.part(load);
        let force = self.condensation.schur() * self.under(&f);
        self.condensation.whole(&(force - f))
    }
}

impl OnKept {
    /// Factors a contact state on the kept equations; None where it is singular or nearly so.
    pub(super) fn new(condensation: Arc<Condensation>, constraints: &[Constraint]) -> Option<Self> {
        let (t, dofs) = condensation.closing(constraints);
        let shift = DVector::from_iterator(dofs.len(), dofs.iter().map(|d| t.shift()[d.index()]));
        let (t, _) = rows(&t, dofs);
        let small = Small::new(condensation, t)?;
        Some(OnKept { small, shift })
    }

    /// Takes a contact state that holds gaps and slips.
    pub(super) fn holding(
        condensation: Arc<Condensation>,
        Held { t, shift, factors }: Held,
    ) -> Self {
        OnKept { small: Small { condensation, t, factors: Box::new(factors) }, shift }
    }

    /// Returns the condensed bodies.
    pub(super) fn condensation(&self) -> &Arc<Condensation> {
        &self.small.condensation
    }

    /// Returns the displacements of the kept equations under a load, length, and their relative residual;
    /// None where the factors are too far from the matrix.
    pub fn displacements(&self, load: &Eliminated) -> Option<(DVector<f64>, f64)> {
        let Small { condensation, t, factors } = &self.small;
        let schur = condensation.schur();
        let f = t.load(&(&load.kept - schur * &self.shift));
        let times = |q: &DVector<f64>| t.load(&(schur * t.expand(q)));
        let (q, residual) = refine(&**factors, times, condensation.kept_norm, &f).ok()?;
        Some((t.expand(&q) + &self.shift, residual))
    }

    /// Returns what gives the displacements inside, under a load, from those of the `kept` equations,
    /// length.
    pub(crate) fn inside(&self, load: &Rc<Eliminated>, kept: DVector<f64>) -> Inside {
        let condensation = Arc::clone(&self.small.condensation);
        Inside { condensation, load: Rc::clone(load), kept }
    }

    /// Returns K u − f by degree of freedom, force, for displacements of the kept equations; 0 but on
    /// these.
    pub(crate) fn reaction(&self, u: &DVector<f64>, load: &Eliminated) -> DVector<f64> {
        let condensation = &self.small.condensation;
        let force = condensation.schur() * u;
        condensation.whole(&(force - &load.kept))
    }

    /// Returns the same of the displacements without the shift of the constraints, under a load on
    /// kept nodes alone.
    pub(crate) fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        self.small.response(load)
    }

    /// Returns those displacements of the kept equations, length, and the forces K u that keep them, by
    /// degree of freedom.
    pub(crate) fn under(&self, load: &DVector<f64>) -> [DVector<f64>; 2] {
        let condensation = &self.small.condensation;
        let u = self.small.under(&condensation.part(load));
        let force = condensation.whole(&(condensation.schur() * &u));
        [u, force]
    }
}

impl Inside {
    /// Returns whether a node's displacements are among those of the surfaces.
    pub(crate) fn knows(&self, node: NodeId) -> bool {
        self.condensation.is_on_surface(node)
    }

    /// Returns whether those are the displacements of all nodes of both surfaces.
    pub(crate) fn knows_surfaces(&self) -> bool {
        self.condensation.has_surfaces()
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

impl Bound {
    /// Factors Tᵀ S T; None where that is singular or nearly so.
    pub(crate) fn new(condensation: Arc<Condensation>, all: &Elimination) -> Option<Self> {
        let mut inside = Vec::with_capacity(condensation.dofs().len());
        for dof in condensation.dofs() {
            if !condensation.is_kept[dof.index()] {
                let &[(column, _)] = all.row(*dof) else { return None };
                inside.push((dof.index(), column));
            }
        }
        let (t, columns) = rows(all, &condensation.kept);
        let small = Small::new(condensation, t)?;
        Some(Bound { small, columns, inside })
    }

    /// Returns K u − f by degree of freedom under a load `f` on kept nodes alone, force, where u are
    /// the displacements without the shift of the constraints; 0 but on the kept equations.
    pub(crate) fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        self.small.response(load)
    }
}

impl Normed for Bound {
    /// Returns that of K without constraints, force/length.
    fn norm(&self) -> f64 {
        self.small.condensation.norm()
    }
}

impl Factors<f64> for Bound {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let Bound { small: Small { condensation, t, factors }, columns, .. } = self;
        let mut load = DVector::zeros(condensation.is_kept.len());
        self.inside.iter().for_each(|(dof, column)| load[*dof] = b[*column]);
        let eliminated = condensation.eliminated(&load);
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
