//! The linear complementarity problem w = M z + r, w ≥ 0, z ≥ 0, w z = 0, by complementary pivots.
//!
//! ```text
//!   w = M z + d z0 + r      d > 0; z0 enters first, then the complement of what left, until z0 is 0
//! ```
//!
//! Source: C. E. Lemke, Management Sci. 11 (1965) 681-689; ties by the lexicographic rule, R. W. Cottle,
//! J.-S. Pang, R. E. Stone, *The Linear Complementarity Problem* (1992), section 4.9.

use std::cmp::Ordering;

use nalgebra::{DMatrix, DVector};

/// A pivot, over the largest entry of M, up to which it is rounding, and what of z0, over its first value: z0
/// leaves although another unknown came to 0 as it did. Measured where one node carries a body that turns: z0
/// is 1e-6 before that pivot, 1e-14 after it.
const ROUNDING: f64 = 1e-11;

/// The number of pivots for each unknown after which the search ends: three are usual.
const PATIENCE: usize = 20;

/// Returns which z are not 0 in a solution, by the way that d makes; None where the pivots end without one.
pub(super) fn complementary(
    m: &DMatrix<f64>,
    r: &DVector<f64>,
    d: &DVector<f64>,
) -> Option<Vec<bool>> {
    let n = r.len();
    // w − M z − d z0 = r, with the columns w, z, z0 and r.
    let (z0, mut tableau) = (2 * n, DMatrix::identity(n, 2 * n + 2));
    tableau.view_mut((0, n), (n, n)).copy_from(&-m);
    tableau.set_column(z0, &-d);
    tableau.set_column(z0 + 1, r);
    let mut basis: Vec<usize> = (0..n).collect();
    let mut row = r.component_div(d).imin();
    if r[row] >= 0.0 {
        return Some(vec![false; n]);
    }
    let (first, mut entering) = (-r[row] / d[row], z0);
    for _ in 0..PATIENCE * n {
        pivot(&mut tableau, row, entering);
        let leaving = std::mem::replace(&mut basis[row], entering);
        let is_left = |at: usize| basis[at] == z0 && tableau[(at, z0 + 1)] > ROUNDING * first;
        if !(0..n).any(is_left) {
            return Some((n..2 * n).map(|z| basis.contains(&z)).collect());
        }
        entering = (leaving + n) % z0;
        row = first_at_zero(&tableau, entering, ROUNDING * m.amax())?;
    }
    None
}

/// Brings a column into the basis in place of that of a row.
fn pivot(tableau: &mut DMatrix<f64>, row: usize, column: usize) {
    let (own, size) = (tableau.column(column).into_owned(), tableau[(row, column)]);
    for mut other in tableau.column_iter_mut() {
        let x = other[row] / size;
        if x != 0.0 {
            other.axpy(-x, &own, 1.0);
            other[row] = x;
        }
    }
}

/// Returns the row whose unknown comes to 0 first as that of a column grows.
fn first_at_zero(t: &DMatrix<f64>, column: usize, flat: f64) -> Option<usize> {
    let n = t.nrows();
    let ratio = |row: usize, c: usize| t[(row, c)] / t[(row, column)];
    let last = 2 * n + 1;
    let in_order = |a: &usize, b: &usize| {
        let mut columns = std::iter::once(last).chain(0..n);
        let orders = |c: usize| ratio(*a, c).total_cmp(&ratio(*b, c));
        columns
            .find_map(|c| Some(orders(c)).filter(|order| order.is_ne()))
            .unwrap_or(Ordering::Equal)
    };
    (0..n).filter(|row| t[(*row, column)] > flat).min_by(in_order)
}
