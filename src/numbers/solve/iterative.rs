//! Solutions to a tolerance: conjugate gradients, and refinement of factors in a scalar of fewer
//! digits.

use nalgebra::DVector;

use super::factors::{Factors, Singular, backward_error, largest};
use super::sparse::{UNBOUNDED, trial_load};
use super::symmetric::SparseSymmetric;
use crate::scalar::Scalar;

/// An iteration that stopped short of its tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NotConverged {
    /// How many iterations it took.
    pub iterations: usize,
    /// The relative residual |A x − b| / (|A| |x| + |b|) after the last of them.
    pub residual: f64,
}

/// Why A x = b was not solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unsolved {
    /// A has no unique solution, or is too near to such a matrix.
    Singular(Singular),
    /// An iteration stopped short of its tolerance.
    NotConverged(NotConverged),
}

impl From<Singular> for Unsolved {
    fn from(singular: Singular) -> Self {
        Unsolved::Singular(singular)
    }
}

impl From<NotConverged> for Unsolved {
    fn from(not_converged: NotConverged) -> Self {
        Unsolved::NotConverged(not_converged)
    }
}

/// Solves A x = `b`, A positive definite, by conjugate gradients on A scaled to a unit diagonal, until
/// |A x − b| / (|A| |x| + |b|), computed anew, is at most `tol` of A and of the scaled A. `epsilon` is
/// that of T.
///
/// x grows without limit along a motion that nothing holds, until any rest is small beside |A| |x|; and
/// of a load without work in that motion nothing is left. So a trial load is solved for first. Each
/// direction p has pᵀ A p at least the least eigenvalue of A times pᵀ p: where that is the rounding
/// that the direct solvers take for a singular matrix, A is one.
///
/// Source: Y. Saad, *Iterative methods for sparse linear systems*, 2nd ed., algorithm 6.18.
///
/// # Errors
/// A diagonal entry that is not positive or a direction along which A is not; no solution after 20 n +
/// 200 iterations, and after none where an entry of A or of b is not finite, for a norm does not tell.
pub fn conjugate_gradients<T: Scalar>(
    a: &SparseSymmetric<T>,
    b: &DVector<T>,
    tol: f64,
    epsilon: f64,
) -> Result<DVector<T>, Unsolved> {
    let entries = a.entries().map(|(_, _, value)| value);
    if !entries.chain(b.iter().copied()).all(Scalar::is_finite) {
        return Err(NotConverged { iterations: 0, residual: f64::INFINITY }.into());
    }
    if b.is_empty() {
        return Ok(b.clone());
    }
    let scaled = Scaled::new(a, epsilon)?;
    let limit = 20 * b.len() + 200;
    scaled.check_held(limit)?;
    let zero = DVector::from_element(b.len(), T::zero());
    if largest(b.as_slice()) == 0.0 {
        return Ok(zero);
    }
    let own = scaled.load(b);
    // Of size 1, so that no square underflows.
    let size = T::from_f64(largest(own.as_slice()));
    let own = own.map(|b| b / size);
    let (norm, own_norm) = (a.norm(), scaled.norm());
    let motion = |x: &DVector<T>| scaled.motion(x) * size;
    let error = |x: &DVector<T>, r: &DVector<T>| {
        let of_a = backward_error(&(scaled.force(r) * size), norm, &motion(x), b);
        of_a.max(backward_error(r, own_norm, x, &own))
    };
    let (mut x, mut iterations) = (zero, 0);
    loop {
        // Begun anew from the true residual, from which the updated one drifts away.
        let r = scaled.load(&(b - a.times(&motion(&x)))).map(|r| r / size);
        let start = error(&x, &r);
        if start <= tol {
            return Ok(motion(&x));
        }
        if iterations >= limit {
            let residual = a.residual(&motion(&x), b);
            return Err(NotConverged { iterations, residual }.into());
        }
        iterations += scaled.descend(&mut x, r, limit - iterations, |x, r| {
            let left = error(x, r);
            left <= tol || left <= start * 1e-6
        })?;
    }
}

/// A matrix scaled to a unit diagonal.
struct Scaled<T> {
    /// The square roots of the diagonal.
    roots: DVector<T>,
    /// The rows of the whole matrix: column, value. A product by them is quicker than by the lower
    /// triangle, as no sum is left and taken up again.
    rows: Vec<Vec<(usize, T)>>,
    /// The least eigenvalue that is no rounding.
    least: T,
}

impl<T: Scalar> Scaled<T> {
    /// # Errors
    /// A diagonal entry is not positive.
    fn new(a: &SparseSymmetric<T>, epsilon: f64) -> Result<Self, Singular> {
        let diagonal = a.diagonal();
        if let Some(column) = diagonal.iter().position(|d| *d <= T::zero()) {
            return Err(Singular { column, pivot: diagonal[column].to_f64() });
        }
        let roots = diagonal.map(Scalar::root);
        let mut rows = vec![Vec::new(); a.size()];
        for (i, j, value) in a.entries() {
            let value = value / (roots[i] * roots[j]);
            rows[i].push((j, value));
            if i != j {
                rows[j].push((i, value));
            }
        }
        Ok(Scaled { roots, rows, least: T::from_f64(epsilon / UNBOUNDED) })
    }

    /// Returns a load as the scaled equations have it.
    fn load(&self, b: &DVector<T>) -> DVector<T> {
        b.zip_map(&self.roots, |b, root| b / root)
    }

    /// Returns the load that the scaled equations have as `b`.
    fn force(&self, b: &DVector<T>) -> DVector<T> {
        b.component_mul(&self.roots)
    }

    /// Returns the solution that the scaled equations have as `x`.
    fn motion(&self, x: &DVector<T>) -> DVector<T> {
        x.zip_map(&self.roots, |x, root| x / root)
    }

    /// Returns the largest row sum of |A|.
    fn norm(&self) -> f64 {
        let sum = |row: &Vec<(usize, T)>| row.iter().map(|(_, a)| a.to_f64().abs()).sum::<f64>();
        self.rows.iter().map(sum).fold(0.0, f64::max)
    }

    fn times(&self, x: &DVector<T>) -> DVector<T> {
        let x = x.as_slice();
        let of_row =
            |row: &Vec<(usize, T)>| row.iter().fold(T::zero(), |sum, (j, a)| sum + *a * x[*j]);
        DVector::from_iterator(x.len(), self.rows.iter().map(of_row))
    }

    /// Checks with a trial load that no motion is free, as far as `limit` iterations tell.
    fn check_held(&self, limit: usize) -> Result<(), Singular> {
        /// The part of the trial load that is left where no motion is free: one that nothing holds
        /// keeps its share of the load, of the order of 1 / √n.
        const TRIED: f64 = 1e-6;
        let n = self.roots.len();
        let trial = DVector::from_fn(n, |i, _| T::from_f64(trial_load(i)));
        let mut x = DVector::from_element(n, T::zero());
        self.descend(&mut x, trial, limit, |_, r| largest(r.as_slice()) <= TRIED).map(drop)
    }

    /// Goes from `x`, whose residual is `r`, until `is_done` of both, or for `limit` iterations; returns
    /// the number of iterations.
    ///
    /// # Errors
    /// A direction along which the matrix is not positive, or by no more than rounding.
    fn descend(
        &self,
        x: &mut DVector<T>,
        mut r: DVector<T>,
        limit: usize,
        is_done: impl Fn(&DVector<T>, &DVector<T>) -> bool,
    ) -> Result<usize, Singular> {
        let (mut p, mut rr) = (r.clone(), r.dot(&r));
        for iterations in 1..=limit {
            let ap = self.times(&p);
            let (curvature, pp) = (p.dot(&ap), p.dot(&p));
            let is_held = curvature > self.least * pp;
            if !is_held {
                let column = p.map(|p| Scalar::abs(p).to_f64()).imax();
                return Err(Singular { column, pivot: (curvature / pp).to_f64() });
            }
            let step = rr / curvature;
            add(x, step, &p);
            add(&mut r, -step, &ap);
            if is_done(x, &r) {
                return Ok(iterations);
            }
            let next = r.dot(&r);
            p = &r + p * (next / rr);
            rr = next;
        }
        Ok(limit)
    }
}

/// Solves A x = `b` with `factors` of A rounded to another scalar: x ← x + (factors)⁻¹ (b − A x), until
/// |A x − b| / (|A| |x| + |b|) is at most `tol`, and what the next change of x would be over x, foreseen
/// from the last two changes, at most `settled`. Where stiff parts are beside soft ones, the first alone
/// would leave forces on the soft ones that |A| hides.
///
/// # Errors
/// Stops where the changes no longer halve, or vanish, at a residual above `tol`: A is too near to a singular
/// matrix for those factors, or `tol` is below what T can reach.
pub fn refine<L: Scalar, T: Scalar>(
    factors: &impl Factors<L>,
    a: &SparseSymmetric<T>,
    b: &DVector<T>,
    [tol, settled]: [f64; 2],
) -> Result<DVector<T>, NotConverged> {
    let norm = a.norm();
    let mut x = DVector::from_element(b.len(), T::zero());
    // The first change is all of x.
    let (mut iterations, mut last, mut next) = (0, 2.0, f64::INFINITY);
    loop {
        let r = b - a.times(&x);
        let residual = backward_error(&r, norm, &x, b);
        if residual == 0.0 || residual <= tol && next <= settled {
            return Ok(x);
        }
        // The residual of size 1: a small one would underflow in a scalar of smaller range.
        let scale = T::from_f64(largest(r.as_slice()));
        let correction = factors.solve(&r.map(|r| L::from_f64((r / scale).to_f64())));
        let mut refined = x.clone();
        add(&mut refined, scale, &correction.map(|c| T::from_f64(c.to_f64())));
        let change = largest((&refined - &x).as_slice()) / largest(refined.as_slice());
        let comes_nearer = 0.0 < change && change <= last / 2.0;
        if !comes_nearer {
            return if residual <= tol {
                Ok(x)
            } else {
                Err(NotConverged { iterations, residual })
            };
        }
        (next, last) = (change * change / last, change);
        x = refined;
        iterations += 1;
    }
}

/// Adds factor · y to x.
fn add<T: Scalar>(x: &mut DVector<T>, factor: T, y: &DVector<T>) {
    x.zip_apply(y, |x, y| *x += factor * y);
}
