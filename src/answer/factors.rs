//! The factors with which a run ended, which the estimates of its errors go on with.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::DVector;

use super::condensation::{Bound, Condensation};
use super::elimination::{Constraint, Elimination, are_alike};
use super::stiffness::Stiffness;
use crate::numbers::solve::{Factors, Singular, SparseCholesky};

/// The change of a weight, a normal or, over the largest displacement, a shift below which factors
/// of one contact state serve for the other.
const ALIKE: f64 = 1e-9;

/// The factors with which a run ended.
#[derive(Clone, Default)]
pub enum LastFactors {
    /// None are known.
    #[default]
    Unknown,
    /// Those of the condensed bodies, and of their last contact state where that was factored.
    Condensed(Arc<Condensation>, Option<Arc<Bound>>),
    /// Those of the whole matrix.
    Whole(Arc<Whole>),
}

impl fmt::Debug for LastFactors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            LastFactors::Unknown => "unknown",
            LastFactors::Condensed(..) => "condensed",
            LastFactors::Whole(_) => "whole",
        })
    }
}

/// The factors with which a run ended, shared by all copies of its solution, until they are let go.
#[derive(Clone, Debug, Default)]
pub struct Kept(Arc<Mutex<LastFactors>>);

impl From<LastFactors> for Kept {
    fn from(factors: LastFactors) -> Self {
        Kept(Arc::new(Mutex::new(factors)))
    }
}

impl Kept {
    /// Returns the factors; unknown ones once they were let go.
    pub(super) fn known(&self) -> LastFactors {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub(super) fn let_go(&self) {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

/// The factors of the whole matrix under some constraints.
pub struct Whole {
    constraints: Vec<Constraint>,
    factors: SparseCholesky,
    /// The norm of the matrix, force/length.
    norm: f64,
}

impl Whole {
    /// Factors Tᵀ K T of a T that was built from `constraints`.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn new(
        stiffness: &Stiffness,
        t: &Elimination,
        constraints: &[Constraint],
    ) -> Result<Self, Singular> {
        let matrix = stiffness.reduced(t);
        let norm = matrix.norm();
        let factors = SparseCholesky::new(matrix)?;
        Ok(Whole { constraints: constraints.to_vec(), factors, norm })
    }

    /// Returns the norm of the matrix, force/length.
    pub(super) fn norm(&self) -> f64 {
        self.norm
    }

    /// Returns whether its constraints bind the same motions in nearly the same directions.
    pub(super) fn is_nearly_of(&self, constraints: &[Constraint]) -> bool {
        are_alike(&self.constraints, constraints, ALIKE)
    }
}

impl Factors<f64> for Whole {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        self.factors.solve(b)
    }
}
