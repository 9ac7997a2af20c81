//! Lemke's method for the linear complementarity problem w = M z + b, w ≥ 0, z ≥ 0, wᵀ z = 0.
//!
//! Source: R. W. Cottle, J.-S. Pang, R. E. Stone, *The Linear Complementarity Problem*, algorithm
//! 4.4.1, with the lexicographic rule of section 4.9 that keeps it from returning.

use nalgebra::{DMatrix, DVector};

/// The entry of a column below which a row does not limit the variable that enters: rounding.
const PIVOT: f64 = 1e-11;

/// The number of pivots after which the search ends: fifty for each of the 450 variables of the
/// largest problem that is set up.
const PATIENCE: usize = 22_500;

/// The number of covering vectors that are tried.
const COVERINGS: usize = 8;

/// Returns a solution z; None where the method ends on a ray, on which it finds none, from each of
/// eight covering vectors: that of ones, and others in no order.
pub(super) fn lemke(m: &DMatrix<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
    let covering = |attempt: usize| {
        DVector::from_fn(b.len(), |i, _| 1.0 + (attempt * (7 * i + 3) * (i + 1) % 31) as f64)
    };
    (0..COVERINGS).find_map(|attempt| from(m, b, &covering(attempt)))
}

/// Follows the path from one covering vector.
fn from(m: &DMatrix<f64>, b: &DVector<f64>, covering: &DVector<f64>) -> Option<DVector<f64>> {
    let n = b.len();
    if b.iter().all(|b| *b >= 0.0) {
        return Some(DVector::zeros(n));
    }
    // Columns: w, z, the artificial variable, the right side. Each row starts with its w as basis.
    let (artificial, right) = (2 * n, 2 * n + 1);
    let mut table = DMatrix::zeros(n, 2 * n + 2);
    for i in 0..n {
        table[(i, i)] = 1.0;
        (0..n).for_each(|j| table[(i, n + j)] = -m[(i, j)]);
        table[(i, artificial)] = -covering[i];
        table[(i, right)] = b[i];
    }
    let mut basis: Vec<usize> = (0..n).collect();
    let mut row = (0..n).min_by(|&i, &k| (b[i] / covering[i]).total_cmp(&(b[k] / covering[k])))?;
    let mut entering = artificial;
    for _ in 0..PATIENCE {
        let leaving = basis[row];
        pivot(&mut table, row, entering);
        basis[row] = entering;
        if leaving == artificial {
            let mut z = DVector::zeros(n);
            for (row, variable) in basis.iter().enumerate() {
                if (n..2 * n).contains(variable) {
                    z[variable - n] = table[(row, right)].max(0.0);
                }
            }
            return Some(z);
        }
        entering = if leaving < n { leaving + n } else { leaving - n };
        row = limiting(&table, &basis, entering)?;
    }
    None
}

/// Eliminates a column from all rows but one.
fn pivot(table: &mut DMatrix<f64>, row: usize, column: usize) {
    let scale = table[(row, column)];
    table.row_mut(row).scale_mut(1.0 / scale);
    let own = table.row(row).into_owned();
    for i in (0..table.nrows()).filter(|i| *i != row) {
        let factor = table[(i, column)];
        if factor != 0.0 {
            let reduced = table.row(i) - &own * factor;
            table.set_row(i, &reduced);
        }
    }
}

/// Returns the row that limits the entering variable first: of equal ones that of the artificial
/// variable, else the first in lexicographic order; None where no row limits it.
fn limiting(table: &DMatrix<f64>, basis: &[usize], entering: usize) -> Option<usize> {
    let n = table.nrows();
    let (artificial, right) = (2 * n, 2 * n + 1);
    let ratio = |i: usize, column: usize| table[(i, column)] / table[(i, entering)];
    let before = |i: usize, k: usize| {
        let columns = std::iter::once(right).chain(0..n);
        for column in columns {
            let (a, b) = (ratio(i, column), ratio(k, column));
            if (a - b).abs() > 1e-13 * (a.abs() + b.abs()) {
                return a < b;
            }
            if column == right && [i, k].iter().any(|row| basis[*row] == artificial) {
                return basis[i] == artificial;
            }
        }
        false
    };
    let limits = (0..n).filter(|i| table[(*i, entering)] > PIVOT);
    limits.reduce(|best, i| if before(i, best) { i } else { best })
}
