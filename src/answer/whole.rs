//! The factors of the whole matrix of a contact state.

use nalgebra::DVector;

use super::elimination::Elimination;
use super::stiffness::Stiffness;
use crate::numbers::solve::{Factors, Singular, SparseCholesky};

/// The factors of the whole matrix under some constraints.
pub struct Whole {
    factors: SparseCholesky,
    /// The norm of the matrix, force/length.
    norm: f64,
}

impl Whole {
    /// Factors Tᵀ K T.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn new(stiffness: &Stiffness, t: &Elimination) -> Result<Self, Singular> {
        let matrix = stiffness.reduced(t);
        let norm = matrix.norm();
        let factors = SparseCholesky::new(matrix)?;
        Ok(Whole { factors, norm })
    }

    /// Returns the norm of the matrix, force/length.
    pub(super) fn norm(&self) -> f64 {
        self.norm
    }
}

impl Factors<f64> for Whole {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        self.factors.solve(b)
    }
}
