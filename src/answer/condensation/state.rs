//! A contact state on the kept nodes: Tᵀ S T, factored.

use std::rc::Rc;
use std::sync::Arc;

use nalgebra::DVector;

use super::gaps::{Gaps, Held};
use super::refinement::refine;
use super::rows::Rows;
use super::schur::{Condensation, holds};
use crate::answer::elimination::{Constraint, Elimination};
use crate::numbers::solve::{DenseCholesky, Eliminated, Factors};
use crate::problem::model::NodeId;

/// Tᵀ S T under one contact state, factored.
struct Small {
    condensation: Arc<Condensation>,
    /// The rows of T of the kept degrees of freedom.
    t: Rows,
    factors: Box<dyn Factors<f64> + Send>,
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
    /// The equation of the bodies and that of the state for each degree of freedom inside.
    inside: Vec<(usize, usize)>,
    /// What made T.
    constraints: Vec<Constraint>,
}

impl Small {
    /// Factors Tᵀ S T, and says which equation of the state each column of T is; None where that is
    /// singular or nearly so.
    fn new(condensation: Arc<Condensation>, all: &Elimination) -> Option<(Self, Vec<usize>)> {
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
        holds(&factors, &matrix.diagonal())
            .then(|| (Small { condensation, t, factors: Box::new(factors) }, columns))
    }

    /// Returns the displacements of the kept equations under a load on them, without shift.
    fn under(&self, load: &DVector<f64>) -> DVector<f64> {
        self.t.expand(&self.factors.solve(&self.t.load(load)))
    }

    /// Returns K u − f by degree of freedom under a load `f` on kept nodes alone, force, where u are
    /// the displacements without the shift of the constraints; 0 but on the kept equations.
    fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        let f = self.condensation.part(load);
        let force = self.condensation.condensed.schur() * self.under(&f);
        self.condensation.whole(&(force - f))
    }
}

impl OnKept {
    /// Factors a contact state on the kept equations, in terms of `gaps` where it can be; None where it is
    /// singular or nearly so.
    pub(super) fn new(
        condensation: Arc<Condensation>,
        gaps: Option<&Arc<Gaps>>,
        constraints: &[Constraint],
    ) -> Option<Self> {
        if let Some(Held { t, shift, factors }) = gaps.and_then(|gaps| gaps.held(constraints)) {
            let small = Small { condensation, t, factors: Box::new(factors) };
            return Some(OnKept { small, shift });
        }
        let t = Elimination::closing(&condensation.is_outside, constraints);
        let shift = condensation.part(t.shift());
        let (small, _) = Small::new(condensation, &t)?;
        Some(OnKept { small, shift })
    }

    /// Returns the condensed bodies.
    pub(super) fn condensation(&self) -> &Arc<Condensation> {
        &self.small.condensation
    }

    /// Returns the displacements of the kept equations under a load, length, and their relative residual;
    /// None where the factors are too far from the matrix.
    pub fn displacements(&self, load: &Eliminated) -> Option<(DVector<f64>, f64)> {
        let Small { condensation, t, factors } = &self.small;
        let schur = condensation.condensed.schur();
        let f = t.load(&(&load.kept - schur * &self.shift));
        let times = |q: &DVector<f64>| t.load(&(schur * t.expand(q)));
        let (q, residual) = refine(&**factors, times, condensation.kept_norm, &f).ok()?;
        Some((t.expand(&q) + &self.shift, residual))
    }

    /// Returns what gives the displacements inside, under a load, from those of the `kept` equations,
    /// length.
    pub(in crate::answer) fn inside(&self, load: &Rc<Eliminated>, kept: DVector<f64>) -> Inside {
        let condensation = Arc::clone(&self.small.condensation);
        Inside { condensation, load: Rc::clone(load), kept }
    }

    /// Returns K u − f by degree of freedom, force, for displacements of the kept equations; 0 but on
    /// these.
    pub(in crate::answer) fn reaction(&self, u: &DVector<f64>, load: &Eliminated) -> DVector<f64> {
        let condensation = &self.small.condensation;
        let force = condensation.condensed.schur() * u;
        condensation.whole(&(force - &load.kept))
    }

    /// Returns the same of the displacements without the shift of the constraints, under a load on
    /// kept nodes alone.
    pub(in crate::answer) fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        self.small.response(load)
    }

    /// Returns those displacements of the kept equations, length, and the forces K u that keep them, by
    /// degree of freedom.
    pub(in crate::answer) fn under(&self, load: &DVector<f64>) -> [DVector<f64>; 2] {
        let condensation = &self.small.condensation;
        let u = self.small.under(&condensation.part(load));
        let force = condensation.whole(&(condensation.condensed.schur() * &u));
        [u, force]
    }
}

impl Inside {
    /// Returns whether the displacements of a node are known without those inside.
    pub(in crate::answer) fn keeps(&self, node: NodeId) -> bool {
        self.condensation.keeps(node)
    }

    /// Returns the displacements by degree of freedom, length; 0 inside.
    pub(in crate::answer) fn kept(&self) -> DVector<f64> {
        self.condensation.whole(&self.kept)
    }

    /// Returns the displacements by degree of freedom, length.
    pub(in crate::answer) fn expand(&self) -> DVector<f64> {
        self.condensation.expand(&self.load, &self.kept)
    }
}

impl Bound {
    /// Factors Tᵀ S T of a T that was built from `constraints`; None where that is singular or nearly
    /// so.
    pub(in crate::answer) fn new(
        condensation: Arc<Condensation>,
        all: &Elimination,
        constraints: &[Constraint],
    ) -> Option<Self> {
        let mut inside = Vec::with_capacity(condensation.dofs.len());
        for (e, dof) in condensation.dofs.iter().enumerate() {
            if !condensation.is_kept[dof.index()] {
                let &[(column, _)] = all.row(*dof) else { return None };
                inside.push((e, column));
            }
        }
        let (small, columns) = Small::new(condensation, all)?;
        Some(Bound { small, columns, inside, constraints: constraints.to_vec() })
    }

    /// Returns K u − f by degree of freedom under a load `f` on kept nodes alone, force, where u are
    /// the displacements without the shift of the constraints; 0 but on the kept equations.
    pub(in crate::answer) fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        self.small.response(load)
    }

    /// Returns whether its T was built from just these constraints.
    pub(in crate::answer) fn is_of(&self, constraints: &[Constraint]) -> bool {
        self.constraints == constraints
    }

    /// Returns the largest row sum of |K| without constraints, force/length.
    pub(in crate::answer) fn norm(&self) -> f64 {
        self.small.condensation.norm
    }
}

impl Factors<f64> for Bound {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let Bound { small: Small { condensation, t, factors }, columns, .. } = self;
        let condensed = &condensation.condensed;
        let mut load = DVector::zeros(condensation.dofs.len());
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
