//! Solutions of Tᵀ K T q = f by its factors, refined until they are those of the triangles' own numbers.

use nalgebra::DVector;

use super::elimination::Elimination;
use super::stiffness::Stiffness;
use numbers::solve::{Normed, backward_error};

/// The relative residual at which refinement ends.
const REFINED: f64 = 4.0 * f64::EPSILON;

/// The part of its residual to which a step of refinement must bring the next one.
const CONTRACTION: f64 = 0.2;

/// Solves Tᵀ K T q = `f` by `factors` of nearly that matrix, and refines as long as that brings more;
/// returns q and its relative residual.
pub(crate) fn refined(
    stiffness: &Stiffness,
    t: &Elimination,
    factors: &dyn Normed,
    f: &DVector<f64>,
) -> (DVector<f64>, f64) {
    let mut q = factors.solve(f);
    let mut before = f64::INFINITY;
    loop {
        let rest = f - t.load(&stiffness.times(&t.motion(&q)));
        let error = backward_error(&rest, factors.norm(), &q, f);
        if error <= REFINED || error.is_nan() || error > CONTRACTION * before {
            return (q, error);
        }
        before = error;
        q += factors.solve(&rest);
    }
}
