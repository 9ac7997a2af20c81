//! What random cases are drawn by.

use fastrand::Rng;

/// One of few.
pub fn one_of<T: Clone>(rng: &mut Rng, from: &[T]) -> T {
    from[rng.usize(..from.len())].clone()
}
