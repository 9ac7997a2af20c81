//! An order of equations in which factors of a sparse symmetric matrix fill little: approximate minimum
//! degree, by the library faer; of many equations, that of groups of them.
//!
//! Both equations of a node are joined to the same others, and may as well stand beside each other: what
//! is ordered is one of each group, in a third of the time.
//!
//! Source: C. Ashcraft, *Compressed graphs and the minimum degree algorithm*, SIAM J. Sci. Comput. 16(6),
//! 1995.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// The number of equations from which on groups are ordered. Those of fewer are ordered in a moment.
pub const ORDERED_IN_GROUPS: usize = 10_000;

/// Returns the equations in an order of small fill, from the lower triangle of the matrix, the rows of
/// each column ascending.
pub(super) fn order(lower: SymbolicSparseColMatRef<'_, usize>) -> Vec<usize> {
    if lower.ncols() < ORDERED_IN_GROUPS {
        return minimum_degree(lower);
    }
    let starts = groups(lower);
    let mut group = vec![0; lower.ncols()];
    for (g, range) in starts.windows(2).enumerate() {
        group[range[0]..range[1]].fill(g);
    }
    let (mut ends, mut rows) = (vec![0], Vec::new());
    for first in &starts[..starts.len() - 1] {
        let column = lower.row_idx_of_col_raw(*first).iter().map(|i| group[*i]);
        let before = rows.len();
        for row in column {
            if rows[before..].last() != Some(&row) {
                rows.push(row);
            }
        }
        ends.push(rows.len());
    }
    let n = ends.len() - 1;
    let of_groups = SymbolicSparseColMatRef::new_checked(n, n, &ends, None, &rows);
    minimum_degree(of_groups).into_iter().flat_map(|g| starts[g]..starts[g + 1]).collect()
}

/// Returns where each group of neighbouring equations that are joined to each other and to the same
/// others starts, and where the last one ends.
fn groups(lower: SymbolicSparseColMatRef<'_, usize>) -> Vec<usize> {
    let n = lower.ncols();
    let rows = |j: usize| lower.row_idx_of_col_raw(j);
    let mut starts = vec![false; n + 1];
    for j in 0..n {
        let column = rows(j);
        starts[j + 1] |= j + 1 == n || column.first() != Some(&j) || &column[1..] != rows(j + 1);
        // To this one, only one of two neighbours is joined.
        for run in column.chunk_by(|a, b| a + 1 == *b) {
            let (first, last) = (run[0], run[run.len() - 1]);
            starts[first] |= first > j + 1;
            starts[last + 1] |= last > j;
        }
    }
    starts[0] = true;
    (0..=n).filter(|k| starts[*k] || *k == n).collect()
}

/// Returns the order of approximate minimum degree.
fn minimum_degree(pattern: SymbolicSparseColMatRef<'_, usize>) -> Vec<usize> {
    let n = pattern.ncols();
    let (mut order, mut place) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, pattern.compute_nnz()));
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut place, pattern, amd::Control::default(), stack)
        .expect("the indices fit");
    order
}

/// Returns the place of each equation in an order.
pub(super) fn places(order: &[usize]) -> Vec<usize> {
    let mut places = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, equation)| places[*equation] = place);
    places
}
