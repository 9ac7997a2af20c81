//! LU of the entries of a matrix that are not 0, with row exchanges, by the library faer.

use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::{MatRef, Par, prelude::Solve};

use super::square::SparseSquare;

/// Factors an n x n `matrix`, however near to a singular one it is; None where a pivot is 0.
pub fn factored(matrix: &SparseSquare) -> Option<Lu<usize, f64>> {
    let matrix = columns(matrix);
    faer::set_global_parallelism(Par::Seq);
    let symbolic = SymbolicLu::try_new(matrix.symbolic()).expect("a pattern fits in memory");
    Lu::try_new_with_symbolic(symbolic, matrix.as_ref()).ok()
}

/// Returns the solution x of A x = `b`; None where a pivot of `matrix`, which is A, is 0.
pub fn solved(matrix: &SparseSquare, b: &[f64]) -> Option<Vec<f64>> {
    let factors = factored(matrix)?;
    let x = factors.solve(MatRef::from_column_major_slice(b, b.len(), 1));
    Some((0..b.len()).map(|i| x[(i, 0)]).collect())
}

/// Returns the entries that are not 0, column by column.
fn columns(matrix: &SparseSquare) -> SparseColMat<usize, f64> {
    let n = matrix.size();
    let (mut starts, mut rows, mut values) = (vec![0; n + 1], Vec::new(), Vec::new());
    for (row, column, value) in matrix.entries() {
        rows.push(row);
        values.push(value);
        starts[column + 1] = rows.len();
    }
    // A column without entries starts where the last one ended.
    (0..n).for_each(|j| starts[j + 1] = starts[j + 1].max(starts[j]));
    SparseColMat::new(SymbolicSparseColMat::new_checked(n, n, starts, None, rows), values)
}
