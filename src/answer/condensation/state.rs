//! A contact state on the kept nodes: Tᵀ S T, factored.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use smallvec::SmallVec;

use super::refinement::refine;
use super::schur::Condensation;
use crate::answer::elimination::{Constraint, Elimination};
use crate::numbers::solve::{DenseCholesky, Eliminated, Factors, largest_motion};

/// The motion under loads of 1, both scaled to a unit diagonal, beyond which a state is left to the
/// factors of its whole matrix, which tell a singular one.
const LOOSE: f64 = 1e10;

/// The columns of Tᵀ S T that are worth a thread.
const AT_ONCE: usize = 256;

/// Tᵀ S T under one contact state, factored.
struct Small {
    condensation: Arc<Condensation>,
    /// The equation of the state for each column of `t`.
    columns: Vec<usize>,
    /// The rows of T of the kept degrees of freedom.
    t: Rows,
    factors: DenseCholesky<f64>,
}

/// The bodies under one contact state, in terms of what is kept of them.
pub(in crate::answer) struct OnKept {
    small: Small,
    /// s on the kept equations, length.
    shift: DVector<f64>,
}

/// The factors of Tᵀ K T under one contact state.
pub(in crate::answer) struct Bound {
    small: Small,
    /// The equation of the bodies and that of the state for each degree of freedom inside.
    inside: Vec<(usize, usize)>,
}

impl Small {
    /// Factors Tᵀ S T; None where that is singular or nearly so.
    fn new(condensation: Arc<Condensation>, all: &Elimination) -> Option<Self> {
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
        (motion < LOOSE).then_some(Small { condensation, columns, t, factors })
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
    /// Factors a contact state on the kept equations; None where it is singular or nearly so.
    pub(in crate::answer) fn new(
        condensation: Arc<Condensation>,
        constraints: &[Constraint],
    ) -> Option<Self> {
        let t = Elimination::closing(&condensation.is_outside, constraints);
        let shift = condensation.part(t.shift());
        Some(OnKept { small: Small::new(condensation, &t)?, shift })
    }

    /// Returns the condensed bodies.
    pub(super) fn condensation(&self) -> &Arc<Condensation> {
        &self.small.condensation
    }

    /// Returns the displacements of the kept equations under a load, length, and their relative residual;
    /// None where the factors are too far from the matrix.
    pub(in crate::answer) fn displacements(
        &self,
        load: &Eliminated,
    ) -> Option<(DVector<f64>, f64)> {
        let Small { condensation, t, factors, .. } = &self.small;
        let schur = condensation.condensed.schur();
        let f = t.load(&(&load.kept - schur * &self.shift));
        let times = |q: &DVector<f64>| t.load(&(schur * t.expand(q)));
        let (q, residual) = refine(factors, times, condensation.kept_norm, &f).ok()?;
        Some((t.expand(&q) + &self.shift, residual))
    }

    /// Returns the displacements by degree of freedom, length, from those of the kept equations.
    pub(in crate::answer) fn expand(&self, load: &Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        self.small.condensation.expand(load, kept)
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

impl Bound {
    /// Factors Tᵀ S T; None where that is singular or nearly so.
    pub(in crate::answer) fn new(
        condensation: Arc<Condensation>,
        all: &Elimination,
    ) -> Option<Self> {
        let mut inside = Vec::with_capacity(condensation.dofs.len());
        for (e, dof) in condensation.dofs.iter().enumerate() {
            if !condensation.is_kept[dof.index()] {
                let &[(column, _)] = all.row(*dof) else { return None };
                inside.push((e, column));
            }
        }
        Some(Bound { small: Small::new(condensation, all)?, inside })
    }

    /// Returns K u − f by degree of freedom under a load `f` on kept nodes alone, force, where u are
    /// the displacements without the shift of the constraints; 0 but on the kept equations.
    pub(in crate::answer) fn response(&self, load: &DVector<f64>) -> DVector<f64> {
        self.small.response(load)
    }

    /// Returns the largest row sum of |K| without constraints, force/length.
    pub(in crate::answer) fn norm(&self) -> f64 {
        self.small.condensation.norm
    }
}

impl Factors<f64> for Bound {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let Small { condensation, columns, t, factors } = &self.small;
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

/// Rows of few entries: column and weight.
struct Rows {
    rows: Vec<Vec<(usize, f64)>>,
    columns: usize,
}

impl Rows {
    /// Returns the lower triangle of Tᵀ S T of a dense S.
    fn reduced(&self, s: &DMatrix<f64>) -> DMatrix<f64> {
        let mut of_column: Vec<SmallVec<[(usize, f64); 1]>> = vec![SmallVec::new(); self.columns];
        for (l, row) in self.rows.iter().enumerate() {
            row.iter().for_each(|(column, weight)| of_column[*column].push((l, *weight)));
        }
        let mut reduced = DMatrix::zeros(self.columns, self.columns);
        let columns = reduced.as_mut_slice().par_chunks_mut(self.columns.max(1)).enumerate();
        let columns = columns.with_min_len(AT_ONCE);
        columns.for_each_init(
            || DVector::zeros(s.nrows()),
            |product, (c, column)| {
                product.fill(0.0);
                for (l, weight) in &of_column[c] {
                    product.axpy(*weight, &s.column(*l), 1.0);
                }
                for (row, value) in self.rows.iter().zip(product.iter()) {
                    for (r, weight) in row.iter().filter(|(r, _)| *r >= c) {
                        column[*r] += weight * value;
                    }
                }
            },
        );
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
