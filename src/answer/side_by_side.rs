//! Two things done at once, where memory allows it.

use crate::problem::model::Model;

/// Returns whether runs on a model are done side by side: not of large bodies, as two factors take twice
/// the memory.
pub(super) fn are_side_by_side(model: &Model) -> bool {
    /// The number of equations of large bodies.
    const LARGE: usize = 200_000;
    model.free_dofs() < LARGE
}

/// Does both at once, or of large bodies one after the other.
pub fn side_by_side<A: Send, B: Send>(
    model: &Model,
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    if are_side_by_side(model) { rayon::join(a, b) } else { (a(), b()) }
}
