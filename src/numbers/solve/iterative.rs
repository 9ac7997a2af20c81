//! Solutions to a tolerance: conjugate gradients, and refinement of factors in a scalar of fewer
//! digits.

use nalgebra::DVector;

use super::factors::{Factors, backward_error, largest};
use super::symmetric::SparseSymmetric;
use crate::numbers::scalar::Scalar;

/// An iteration that stopped short of its tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotConverged {
    pub iterations: usize,
    /// The relative residual |A x − b| / (|A| |x| + |b|) after the last of them.
    pub residual: f64,
}

/// Solves A x = `b`, A positive definite, by conjugate gradients with the diagonal as
/// preconditioner, until |A x − b| / (|A| |x| + |b|), computed anew, is at most `tol`.
///
/// Source: Y. Saad, *Iterative methods for sparse linear systems*, 2nd ed., algorithm 9.1.
/// Errors: stops at a diagonal entry or a direction along which A is not positive, after 20 n + 200
/// iterations, and before the first where an entry of A or of b is not finite, for a norm does not tell.
pub fn conjugate_gradients<T: Scalar>(
    a: &SparseSymmetric<T>,
    b: &DVector<T>,
    tol: f64,
) -> Result<DVector<T>, NotConverged> {
    let (norm, diagonal, limit) = (a.norm(), a.diagonal(), 20 * b.len() + 200);
    let entries = a.entries().map(|(_, _, value)| value);
    if !entries.chain(b.iter().copied()).all(Scalar::is_finite) {
        return Err(NotConverged { iterations: 0, residual: f64::INFINITY });
    }
    let precondition = |r: &DVector<T>| r.zip_map(&diagonal, |r, d| r / d);
    let rows = rows(a);
    let mut x = DVector::from_element(b.len(), T::zero());
    let mut iterations = 0;
    loop {
        // Begun anew from the true residual, from which the updated one drifts away.
        let mut r = b - a.times(&x);
        let start = backward_error(&r, norm, &x, b);
        if start <= tol {
            return Ok(x);
        }
        let mut z = precondition(&r);
        let (mut p, mut rz) = (z.clone(), r.dot(&z));
        loop {
            let ap = times(&rows, &p);
            let curvature = p.dot(&ap);
            let positive = curvature > T::zero() && rz > T::zero();
            if iterations >= limit || !positive {
                let residual = a.residual(&x, b);
                return Err(NotConverged { iterations, residual });
            }
            iterations += 1;
            let step = rz / curvature;
            add(&mut x, step, &p);
            add(&mut r, -step, &ap);
            let left = backward_error(&r, norm, &x, b);
            if left <= tol || left <= start * 1e-6 {
                break;
            }
            z = precondition(&r);
            let next = r.dot(&z);
            p = &z + p * (next / rz);
            rz = next;
        }
    }
}

/// Solves A x = `b` with `factors` of A rounded to another scalar: x ← x + (factors)⁻¹ (b − A x),
/// until the relative residual |A x − b| / (|A| |x| + |b|) is at most `tol`.
/// Errors: stops at a residual that no longer halves: A is too near to a singular matrix for those
/// factors, or `tol` is below what T can reach.
pub fn refine<L: Scalar, T: Scalar>(
    factors: &impl Factors<L>,
    a: &SparseSymmetric<T>,
    b: &DVector<T>,
    tol: f64,
) -> Result<DVector<T>, NotConverged> {
    let norm = a.norm();
    let mut x = DVector::from_element(b.len(), T::zero());
    let (mut iterations, mut last) = (0, f64::INFINITY);
    loop {
        let r = b - a.times(&x);
        let residual = backward_error(&r, norm, &x, b);
        if residual <= tol {
            return Ok(x);
        }
        // The first, at x = 0, is 1 whatever comes of it.
        if residual.is_nan() || residual > last / 2.0 {
            return Err(NotConverged { iterations, residual });
        }
        last = if iterations == 0 { f64::INFINITY } else { residual };
        // The residual of size 1: a small one would underflow in a scalar of smaller range.
        let scale = T::from_f64(largest(r.as_slice()));
        let correction = factors.solve(&r.map(|r| L::from_f64((r / scale).to_f64())));
        add(&mut x, scale, &correction.map(|c| T::from_f64(c.to_f64())));
        iterations += 1;
    }
}

/// Returns the rows of the whole matrix: column, value. A product by them is quicker than by the lower
/// triangle, as no sum is left and taken up again.
fn rows<T: Scalar>(a: &SparseSymmetric<T>) -> Vec<Vec<(usize, T)>> {
    let mut rows = vec![Vec::new(); a.size()];
    for (i, j, value) in a.entries() {
        rows[i].push((j, value));
        if i != j {
            rows[j].push((i, value));
        }
    }
    rows
}

fn times<T: Scalar>(rows: &[Vec<(usize, T)>], x: &DVector<T>) -> DVector<T> {
    let x = x.as_slice();
    let of_row = |row: &Vec<(usize, T)>| row.iter().fold(T::zero(), |sum, (j, a)| sum + *a * x[*j]);
    DVector::from_iterator(x.len(), rows.iter().map(of_row))
}

/// Adds factor · y to x.
fn add<T: Scalar>(x: &mut DVector<T>, factor: T, y: &DVector<T>) {
    x.zip_apply(y, |x, y| *x += factor * y);
}
