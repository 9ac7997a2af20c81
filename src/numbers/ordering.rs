//! The order of the equations of a sparse matrix, symmetric or nearly, in which its factors fill little, by the library
//! faer.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// Returns the equations in an order of small fill (approximate minimum degree), from all or the lower triangle of
/// the matrix.
pub fn order(pattern: SymbolicSparseColMatRef<'_, usize>) -> Vec<usize> {
    let n = pattern.ncols();
    let (mut order, mut place) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, pattern.compute_nnz()));
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut place, pattern, amd::Control::default(), stack)
        .expect("the indices fit");
    order
}

/// Returns the place of each equation in an order.
pub fn places(order: &[usize]) -> Vec<usize> {
    let mut places = vec![0; order.len()];
    order.iter().enumerate().for_each(|(place, equation)| places[*equation] = place);
    places
}
