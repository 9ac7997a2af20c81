//! Elimination in numbers that no library factors: `f32`, double-doubles, rationals.

use super::is_lost;
use nalgebra::DMatrix;

use super::factors::Singular;
use numbers::scalar::Field;

/// Returns the solution x of A x = `b`, by Gauss's elimination with the largest pivot of each
/// column.
///
/// # Errors
/// Names a pivot that is 0, or below 16 n · eps of the largest entry of its column.
pub fn solve_dense<F: Field>(
    matrix: impl Fn(usize, usize) -> F,
    mut b: Vec<F>,
) -> Result<Vec<F>, Singular> {
    let n = b.len();
    let mut rows: Vec<Vec<F>> = (0..n).map(|i| (0..n).map(|j| matrix(i, j)).collect()).collect();
    let largest = DMatrix::from_fn(n, n, |i, j| rows[i][j].size());
    for k in 0..n {
        let size = |i: usize| rows[i][k].size();
        let candidates = (k..n).filter(|&i| !rows[i][k].vanishes());
        let best = candidates.reduce(|a, i| if size(i) > size(a) { i } else { a }).unwrap_or(k);
        if is_lost(&rows[best][k], largest.column(k).max(), n) {
            return Err(Singular { column: k, pivot: size(best) });
        }
        rows.swap(k, best);
        b.swap(k, best);
        eliminate(&mut rows, &mut b, k);
    }
    Ok(substitute(&rows, b))
}

/// Makes column k below its pivot 0; the entries that become 0 are left as they were.
fn eliminate<F: Field>(rows: &mut [Vec<F>], b: &mut [F], k: usize) {
    let (above, below) = rows.split_at_mut(k + 1);
    let pivot_row = &above[k];
    let (b_above, b_below) = b.split_at_mut(k + 1);
    for (row, value) in below.iter_mut().zip(b_below) {
        if row[k].vanishes() {
            continue;
        }
        let factor = row[k].over(&pivot_row[k]);
        for (a, p) in row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]) {
            if !p.vanishes() {
                a.subtract_product(&factor, p);
            }
        }
        value.subtract_product(&factor, &b_above[k]);
    }
}

/// Returns the solution x of U x = b, U being the upper triangle of `rows`.
fn substitute<F: Field>(rows: &[Vec<F>], mut b: Vec<F>) -> Vec<F> {
    for k in (0..b.len()).rev() {
        let (before, after) = b.split_at_mut(k + 1);
        for (a, x) in rows[k][k + 1..].iter().zip(after.iter()) {
            before[k].subtract_product(a, x);
        }
        before[k] = before[k].over(&rows[k][k]);
    }
    b
}
