//! The norm of a matrix's inverse, estimated from a few solutions.

use nalgebra::DVector;

use super::factors::Factors;

/// Returns the largest entry of |A⁻¹| w, A symmetric and w >= 0: the 1-norm of diag(w) A⁻¹.
///
/// Source: N. J. Higham, *FORTRAN codes for estimating the one-norm of a real or complex matrix*,
/// ACM TOMS 14(4), 1988, algorithm 4.1, as in LAPACK's xLACN2.
pub fn inverse_norm(factors: &dyn Factors, w: &DVector<f64>) -> f64 {
    /// The rounds that LAPACK allows.
    const ROUNDS: usize = 5;
    let n = w.len();
    if n == 0 || w.amax() == 0.0 {
        return 0.0;
    }
    let forward = |v: &DVector<f64>| factors.solve(v).component_mul(w);
    let transposed = |v: &DVector<f64>| factors.solve(&v.component_mul(w));
    let mut y = forward(&DVector::from_element(n, 1.0 / n as f64));
    let mut estimate = y.lp_norm(1);
    let mut signs = y.map(sign);
    let mut at = None;
    for _ in 1..ROUNDS {
        let z = transposed(&signs);
        let next = z.iamax();
        if at.is_some_and(|at: usize| z[at].abs() >= z[next].abs()) {
            break;
        }
        at = Some(next);
        y = forward(&DVector::from_fn(n, |i, _| f64::from(i == next)));
        let (last, last_signs) = (estimate, std::mem::replace(&mut signs, y.map(sign)));
        estimate = y.lp_norm(1).max(last);
        if signs == last_signs || estimate <= last {
            break;
        }
    }
    // A vector that the ascent above is blind to.
    let last = (n.max(2) - 1) as f64;
    let alternating =
        |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 } * (1.0 + i as f64 / last);
    let other = forward(&DVector::from_fn(n, |i, _| alternating(i)));
    estimate.max(2.0 * other.lp_norm(1) / (3.0 * n as f64))
}

fn sign(x: f64) -> f64 {
    if x < 0.0 { -1.0 } else { 1.0 }
}
