//! The largest of several values where rounding alone may tell some of them apart, as those of mirror
//! images.

/// How far a value may be from the largest, over the largest magnitude, and count as no smaller.
const EQUAL: f64 = 1e-9;

/// Which of several values is the largest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Largest {
    /// The place of the first value that is as large as any.
    pub first: usize,
    /// The number of other values that are as large.
    pub others: usize,
}

/// Returns which of `values` is the largest; None of none.
pub fn largest(values: impl Iterator<Item = f64> + Clone) -> Option<Largest> {
    let most = values.clone().reduce(f64::max)?;
    let magnitude = values.clone().fold(0.0, |m: f64, x| m.max(x.abs()));
    let mut equal = values.enumerate().filter(|(_, x)| is_as_large(*x, most, magnitude));
    let (first, _) = equal.next()?;
    Some(Largest { first, others: equal.count() })
}

/// Returns whether a value counts as no smaller than the largest, `most`, of values up to `magnitude`.
pub fn is_as_large(value: f64, most: f64, magnitude: f64) -> bool {
    value >= most - EQUAL * magnitude
}
