//! `Km` as printed by the factors of the condensed bodies.
//!
//! Contact changes `Km` at the surfaces alone: it adds element matrices at the equations of mates. So the
//! bodies are factored once, and of each contact state only what is left of it on the surfaces' equations,
//! by LU, for weights may leave it indefinite. The solution is refined until it is that of `Km` itself.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::condensation::{Factored, few_surfaces, refine};
use super::request::Request;
use crate::numbers::solve::{
    AnyLu, DenseLu, Factors, Lu, ScalarName, SparseSquare, backward_error,
};
use crate::paper::listings::Which;
use crate::paper::mirror::RestraintIndex;
use crate::problem::model::Model;
use crate::problem::modelling::Variant;

/// Returns whether a request for `printed` is solved so: where no solver is asked for by its name, and the
/// bodies of the model are small.
pub fn condenses_printed(request: &Request, model: &Model) -> bool {
    let scalar = request.arithmetic.scalar;
    request.variant == Variant::Printed
        && request.arithmetic.solver.is_none()
        && matches!(scalar, ScalarName::F64 | ScalarName::Bounded)
        // Otherwise `Km` does not restrain what the model does.
        && request.reading.r2 == RestraintIndex::Odd
        && !request.is_edited(Which::Km)
        && model.has_contact()
        && few_surfaces(model).is_some()
}

/// The bodies condensed to their surfaces, beside `Km` without contact.
pub(super) struct AtSurfaces {
    bodies: Arc<Factored>,
    /// What condensation adds to the surfaces' entries, force/length.
    added: DMatrix<f64>,
}

/// `Km` of a contact state, and its factors.
struct OfState {
    bodies: Arc<Factored>,
    on_surfaces: DenseLu,
    matrix: SparseSquare,
    /// The largest row sum of its entries' sizes, force/length.
    norm: f64,
    /// The load for which they were made, force, and its solution, length; None until that is found.
    known: Option<(DVector<f64>, DVector<f64>)>,
}

impl AtSurfaces {
    /// Takes `bodies` that are condensed to their surfaces, and `free`, `Km` without contact.
    pub(super) fn new(bodies: Arc<Factored>, free: &SparseSquare) -> Self {
        let added = bodies.schur() - at_surfaces(&bodies, free);
        AtSurfaces { bodies, added }
    }

    /// Returns factors of `Km` of a contact state; None where they do not solve for a `load`, force.
    pub(super) fn factors(&self, matrix: &SparseSquare, load: &DVector<f64>) -> Option<AnyLu> {
        let on_surfaces = DenseLu::new(at_surfaces(&self.bodies, matrix) + &self.added).ok()?;
        let mut row_sums = DVector::<f64>::zeros(matrix.size());
        matrix.entries().for_each(|(row, _, value)| row_sums[row] += value.abs());
        let (bodies, matrix, norm) = (Arc::clone(&self.bodies), matrix.clone(), row_sums.amax());
        let mut state = OfState { bodies, on_surfaces, matrix, norm, known: None };
        state.known = Some((load.clone(), state.solution(load)?));
        Some(Arc::new(state))
    }
}

/// Returns the entries of a matrix by degree of freedom at the equations of the surfaces.
fn at_surfaces(bodies: &Factored, matrix: &SparseSquare) -> DMatrix<f64> {
    let surfaces = bodies.kept();
    let mut place = vec![None; matrix.size()];
    surfaces.iter().enumerate().for_each(|(i, dof)| place[dof.index()] = Some(i));
    let mut entries = DMatrix::zeros(surfaces.len(), surfaces.len());
    for (row, column, value) in matrix.written() {
        if let (Some(i), Some(j)) = (place[row], place[column]) {
            entries[(i, j)] = value;
        }
    }
    entries
}

impl OfState {
    fn times(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut product = DVector::zeros(x.len());
        self.matrix.entries().for_each(|(row, column, value)| product[row] += value * x[column]);
        product
    }
}

impl Factors<f64> for OfState {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let eliminated = self.bodies.eliminated(b);
        let on_surfaces = self.on_surfaces.solve(&eliminated.kept);
        let mut x = self.bodies.expand(&eliminated, &on_surfaces);
        // A restrained equation has a 1 on the diagonal, and nothing beside it.
        self.bodies.restrained().for_each(|dof| x[dof.index()] = b[dof.index()]);
        x
    }
}

impl Lu<f64> for OfState {
    fn residual(&self, x: &DVector<f64>, b: &DVector<f64>) -> f64 {
        backward_error(&(self.times(x) - b), self.norm, x, b)
    }

    fn solution(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        if let Some((_, x)) = self.known.as_ref().filter(|(load, _)| load == b) {
            return Some(x.clone());
        }
        let (x, _) = refine(self, |x| self.times(x), self.norm, b).ok()?;
        // Once more, for small displacements beside large ones.
        let rest = self.solve(&(b - self.times(&x)));
        Some(x + rest)
    }
}
