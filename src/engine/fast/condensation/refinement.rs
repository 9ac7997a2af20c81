//! Solutions by factors of nearly the right matrix, refined until they are those of the right one.

use nalgebra::DVector;

use crate::elimination::Elimination;
use crate::stiffness::Stiffness;
use numbers::solve::{Factors, Normed, backward_error};

/// The relative residual at which refinement ends.
const REFINED: f64 = 4.0 * f64::EPSILON;

/// The relative residual that is enough where refinement brings no more.
const ENOUGH: f64 = 32.0 * f64::EPSILON;

/// The part of its residual to which a step of refinement must bring the next one.
const CONTRACTION: f64 = 0.2;

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
