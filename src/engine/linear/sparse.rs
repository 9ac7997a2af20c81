//! Cholesky factors of sparse symmetric matrices that are positive definite.

use nalgebra::{DMatrix, DVector};

use super::cholesky::Cholesky;
use super::factors::{Factors, Singular};
use super::inverse_norm::inverse_norm;
use super::symmetric::SparseSymmetric;

/// Displacements beyond this (5e14) under a load of the size of the stiffness mean a singular matrix; both
/// are scaled to a unit diagonal.
const UNBOUNDED: f64 = 0.1 / f64::EPSILON;

/// Where every pivot is large and one trial load moves less than this part of what means a singular
/// matrix, no other load is tried.
const SMALL_PART: f64 = 1e-5;

/// The Cholesky factors of a symmetric positive definite matrix.
pub struct SparseCholesky {
    /// The largest row sum of the matrix's sizes.
    norm: f64,
    factors: Cholesky,
}

impl SparseCholesky {
    /// Factors a `matrix` that must be positive definite.
    ///
    /// # Errors
    /// Names an equation that a trial load, scaled by the diagonal, moves without bound:
    /// the matrix is singular or nearly so.
    pub fn new(matrix: &SparseSymmetric) -> Result<Self, Singular> {
        let Some(factors) = Cholesky::new(matrix) else {
            return Err(mechanism(matrix));
        };
        let diagonal = matrix.diagonal();
        let cholesky = SparseCholesky { norm: matrix.norm(), factors };
        let Some((column, size)) = probe(&cholesky.factors, &diagonal) else {
            return Ok(cholesky);
        };
        let small = SMALL_PART * UNBOUNDED;
        if size < small && cholesky.factors.has_large_pivots(&diagonal) {
            return Ok(cholesky);
        }
        match size.max(largest_motion(&cholesky, &diagonal)) {
            size if size.is_finite() && size < UNBOUNDED => Ok(cholesky),
            size => Err(Singular { column, pivot: 1.0 / size }),
        }
    }

    /// Returns the largest row sum of |A|.
    pub fn norm(&self) -> f64 {
        self.norm
    }
}

impl Factors for SparseCholesky {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        solve(&self.factors, b)
    }

    fn solve_all(&self, b: DMatrix<f64>) -> DMatrix<f64> {
        self.factors.solve(b)
    }
}

/// Returns the solution x of A x = `b` by the factors of A.
pub(super) fn solve(factors: &Cholesky, b: &DVector<f64>) -> DVector<f64> {
    factors.solve(DMatrix::from_column_slice(b.len(), 1, b.as_slice())).column(0).into_owned()
}

/// Returns the largest motion under loads of 1, both scaled to a unit diagonal: what no single trial
/// load is sure to find.
pub(super) fn largest_motion(factors: &impl Factors, diagonal: &DVector<f64>) -> f64 {
    let scale = diagonal.map(|d| d.sqrt());
    let ones = DVector::from_element(scale.len(), 1.0);
    inverse_norm(&Scaled { factors, scale }, &ones)
}

/// The factors of A scaled to a unit diagonal.
struct Scaled<'a, F> {
    factors: &'a F,
    scale: DVector<f64>,
}

impl<F: Factors> Factors for Scaled<'_, F> {
    fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        self.factors.solve(&b.component_mul(&self.scale)).component_mul(&self.scale)
    }
}

/// Returns the equation that moves most under a trial load, and how far, both scaled to a unit
/// diagonal; nothing without equations.
fn probe(factors: &Cholesky, diagonal: &DVector<f64>) -> Option<(usize, f64)> {
    let scale = diagonal.map(|d| d.sqrt());
    // 1 and −1, without a pattern that a motion of the body could be orthogonal to.
    let trial_load = |i: usize| if (i * i + i / 3) % 5 < 2 { 1.0 } else { -1.0 };
    let load = DVector::from_fn(scale.len(), |i, _| trial_load(i) * scale[i]);
    let moved = solve(factors, &load).component_mul(&scale);
    let largest = moved.iter().map(|x| x.abs()).enumerate();
    largest.reduce(|a, b| if b.1 > a.1 || b.1.is_nan() { b } else { a })
}

/// Returns the equation that a singular matrix leaves free to move.
pub(super) fn mechanism(matrix: &SparseSymmetric) -> Singular {
    let diagonal = matrix.diagonal();
    if let Some(column) = diagonal.iter().position(|d| d.is_nan() || *d <= 0.0) {
        return Singular { column, pivot: diagonal[column] };
    }
    let shifted = Cholesky::new(&matrix.softly_held());
    let shifted = shifted.and_then(|factors| probe(&factors, &diagonal));
    let (column, size) = shifted.unwrap_or((0, f64::INFINITY));
    Singular { column, pivot: 1.0 / size }
}
