//! Solutions of equations by factors of nearly their matrix, refined.

use nalgebra::DVector;

use super::elimination::Elimination;
use super::stiffness::Stiffness;
use crate::linear::{Factors, Normed, backward_error};

/// The relative residual at which refinement ends.
const REFINED: f64 = 4.0 * f64::EPSILON;

/// The part of its residual to which a step of refinement must bring the next one.
const CONTRACTION: f64 = 0.2;

/// Corrects x as long as that brings more: `rest` returns its residual and the relative size of that, `correction`
/// what a residual adds to x. Returns x and the relative size of its residual.
pub(super) fn corrected(
    mut x: DVector<f64>,
    rest: impl Fn(&DVector<f64>) -> (DVector<f64>, f64),
    correction: impl Fn(&DVector<f64>) -> DVector<f64>,
) -> (DVector<f64>, f64) {
    let mut before = f64::INFINITY;
    loop {
        let (rest, error) = rest(&x);
        if error <= REFINED || error.is_nan() || error > CONTRACTION * before {
            return (x, error);
        }
        before = error;
        x += correction(&rest);
    }
}

/// Solves A q = `f`, where `times` multiplies by A, whose norm is `norm`; returns q and its relative residual.
pub(super) fn refine(
    factors: &dyn Factors,
    times: impl Fn(&DVector<f64>) -> DVector<f64>,
    norm: f64,
    f: &DVector<f64>,
) -> (DVector<f64>, f64) {
    let rest = |q: &DVector<f64>| {
        let rest = f - times(q);
        let error = backward_error(&rest, norm, q, f);
        (rest, error)
    };
    corrected(factors.solve(f), rest, |rest| factors.solve(rest))
}

/// Solves Tᵀ K T q = `f` in the same way, with K as the triangles add it up.
pub(super) fn refined(
    stiffness: &Stiffness,
    t: &Elimination,
    factors: &dyn Normed,
    f: &DVector<f64>,
) -> (DVector<f64>, f64) {
    refine(factors, |q| t.load(&stiffness.times(&t.motion(q))), factors.norm(), f)
}
