//! The least ½ xᵀ M x + bᵀ x over x ≥ 0, with M symmetric and positive semidefinite: entries become
//! greater than 0 one by one, where the sum falls most steeply, and it falls with each.
//!
//! Source: C. L. Lawson, R. J. Hanson, *Solving Least Squares Problems* (1974), chapter 23; from M and b
//! alone R. Bro, S. de Jong, J. Chemometrics 11 (1997) 393-401.

use nalgebra::{Cholesky, DMatrix, DVector};

/// A slope, over the largest entry of b, up to which it is 0: rounding.
const FLAT: f64 = 1e-13;

/// What is added to the diagonal, over its largest entry, so that an M that lets x move freely has factors.
const SOFT: f64 = 1e-14;

/// An entry of x, over what b moves, beyond which x moves freely and nothing ends that.
const FAR: f64 = 1e11;

/// The number of entries that are tried for each entry of x.
const PATIENCE: usize = 30;

/// Returns x from a `start` ≥ 0; None where the sum falls without end.
pub(super) fn least(
    m: &DMatrix<f64>,
    b: &DVector<f64>,
    start: DVector<f64>,
) -> Option<DVector<f64>> {
    let n = b.len();
    let mut x = start;
    let mut free: Vec<usize> = (0..n).filter(|i| x[*i] > 0.0).collect();
    // Entries that by rounding fell back to 0 at once.
    let mut refused = vec![false; n];
    for _ in 0..PATIENCE * (n + 1) {
        let before = x.clone();
        descend(m, b, &mut x, &mut free)?;
        if x != before {
            refused.fill(false);
        }
        let slope = m * &x + b;
        let falls = |i: &usize| x[*i] == 0.0 && !refused[*i] && slope[*i] < -FLAT * b.amax();
        let steepest = (0..n).filter(falls).min_by(|i, k| slope[*i].total_cmp(&slope[*k]));
        let Some(next) = steepest else { return Some(x) };
        refused[next] = true;
        free.push(next);
    }
    None
}

/// Goes to the least sum where the entries that are `free` alone are not 0; takes from these the ones that
/// come to 0 on the way. None where the sum falls without end.
fn descend(
    m: &DMatrix<f64>,
    b: &DVector<f64>,
    x: &mut DVector<f64>,
    free: &mut Vec<usize>,
) -> Option<()> {
    while !free.is_empty() {
        let to = minimum(m, b, free)?;
        let part = |x: f64, to: f64| if x == 0.0 { 0.0 } else { x / (x - to) };
        let falls = free.iter().zip(&to).filter(|(_, to)| **to <= 0.0);
        let limits = falls.map(|(i, to)| (part(x[*i], *to), *i));
        let first = limits.min_by(|a, b| a.0.total_cmp(&b.0));
        let part = first.map_or(1.0, |(part, _)| part);
        free.iter().zip(&to).for_each(|(i, to)| x[*i] += part * (to - x[*i]));
        let Some((_, at)) = first else {
            return (to.amax() <= FAR * b.amax() / m.diagonal().amax()).then_some(());
        };
        x[at] = 0.0;
        free.retain(|i| *i != at);
    }
    Some(())
}

/// Returns the entries of the least sum where those that are `free` alone are not 0.
fn minimum(m: &DMatrix<f64>, b: &DVector<f64>, free: &[usize]) -> Option<DVector<f64>> {
    let n = free.len();
    let soft = SOFT * m.diagonal().amax();
    let own = |i: usize, k: usize| if i == k { soft } else { 0.0 };
    let matrix = DMatrix::from_fn(n, n, |i, k| m[(free[i], free[k])] + own(i, k));
    let right = DVector::from_fn(n, |i, _| -b[free[i]]);
    Some(Cholesky::new(matrix)?.solve(&right))
}
