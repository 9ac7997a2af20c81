//! How far a computed solution of A x = b may be from the true one, A and b themselves being known
//! within bounds.
//!
//! (A + ΔA)(x + δ) = b + Δb with |ΔA| <= E and |Δb| <= e gives |δ| <= |(A + ΔA)⁻¹| w, where w is
//! |b − A x| + E |x| + e, as in LAPACK's xSYRFS. The norm of |A⁻¹| w is estimated by solving with A
//! a few times; |(A + ΔA)⁻¹| is at most |A⁻¹| / (1 − ρ), ρ the norm of |A⁻¹| E. The estimate is a
//! lower bound of the norm, in practice the norm itself.

use nalgebra::DVector;

use super::factors::Factors;
use numbers::scalar::{BoundedDouble, Rounded, Scalar, SumOfProducts, WithBound};

/// Returns a bound on the largest |δ|, infinite where A cannot be told from a singular matrix.
/// `factors` are those of A rounded to `f64`; `entries` those of the whole of A: row, column, value.
pub fn error_bound<V: Rounded>(
    factors: &dyn Factors,
    entries: impl Iterator<Item = (usize, usize, WithBound<V>)>,
    b: &DVector<WithBound<V>>,
    x: &DVector<V>,
) -> f64 {
    let x = x.map(|x| BoundedDouble::new(x.double(), 0.0));
    // In double-double, which bounds its own rounding, the error of b and of A included.
    let mut products = vec![SumOfProducts::ZERO; x.len()];
    let mut spread = DVector::zeros(x.len());
    for (i, j, a) in entries {
        products[i].add(a.in_double(), x[j]);
        spread[i] += a.off();
    }
    let r = DVector::from_fn(x.len(), |i, _| b[i].in_double() - products[i].total());
    error_of_rest(factors, &r, &spread)
}

/// Returns the same bound from `rest`, which is b − A x, and `spread`, the sums of the rows of E.
pub fn error_of_rest(
    factors: &dyn Factors,
    rest: &DVector<BoundedDouble>,
    spread: &DVector<f64>,
) -> f64 {
    /// The ρ up to which that of a larger vector serves.
    const SMALL: f64 = 1e-6;
    let w = rest.map(|r| r.to_f64().abs() + r.error());
    let bound = inverse_norm(factors, &w);
    // No entry of |A⁻¹| E is larger than of |A⁻¹| w times the most that E is of w.
    let share = |(e, w): (&f64, &f64)| if *e == 0.0 { 0.0 } else { e / w };
    let rho = bound * spread.iter().zip(&w).map(share).fold(0.0, f64::max);
    let rho = if rho <= SMALL { rho } else { inverse_norm(factors, spread) };
    if rho < 1.0 { bound / (1.0 - rho) } else { f64::INFINITY }
}

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
