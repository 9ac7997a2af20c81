//! Two things done at once, where memory allows it.

use crate::problem::model::Model;

/// Does both at once; one after the other of large bodies, as two factors take twice the memory.
pub fn side_by_side<A: Send, B: Send>(
    model: &Model,
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    /// The number of equations of large bodies.
    const LARGE: usize = 200_000;
    if model.free_dofs() < LARGE { rayon::join(a, b) } else { (a(), b()) }
}
