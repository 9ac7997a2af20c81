//! A number that counts what is done with it: the mirror, generic over its scalar, counts by it how
//! many operations the listing takes.

use std::cell::Cell;
use std::cmp::Ordering;
use std::fmt;

use plane_contact::numbers::operators;
use plane_contact::numbers::scalar::{Scalar, Subscript};

thread_local! {
    static OPERATIONS: Cell<u64> = const { Cell::new(0) };
}

/// What `work` returns, and the sums, differences, products, quotients and comparisons that it
/// made, one each. A test for 0 or for overflow is Mathcad's and counts nothing.
pub fn counting<R>(work: impl FnOnce() -> R) -> (R, u64) {
    let before = OPERATIONS.get();
    let result = work();
    (result, OPERATIONS.get() - before)
}

/// An `f64` that counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted(f64);

/// Counts one operation, which led to `result`.
fn one_more<R>(result: R) -> R {
    OPERATIONS.set(OPERATIONS.get() + 1);
    result
}

impl Counted {
    const ZERO: Self = Counted(0.0);
    const ONE: Self = Counted(1.0);

    fn sum(x: Self, y: Self) -> Self {
        Counted(one_more(x.0 + y.0))
    }

    fn difference(x: Self, y: Self) -> Self {
        Counted(one_more(x.0 - y.0))
    }

    fn product(x: Self, y: Self) -> Self {
        Counted(one_more(x.0 * y.0))
    }

    fn quotient(x: Self, y: Self) -> Self {
        Counted(one_more(x.0 / y.0))
    }

    fn negative(x: Self) -> Self {
        Counted(-x.0)
    }

    fn vanishes(x: Self) -> bool {
        x.0 == 0.0
    }
}

operators!(Counted);

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Counted) -> Option<Ordering> {
        one_more(self.0.partial_cmp(&other.0))
    }
}

impl fmt::Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Subscript for Counted {
    fn index(self) -> usize {
        self.0.index()
    }
}

impl Scalar for Counted {
    fn from_f64(x: f64) -> Self {
        Counted(x)
    }
    fn to_f64(self) -> f64 {
        self.0
    }
    fn scaled_root(factor: Self, scale: Self, square: Self) -> f64 {
        f64::scaled_root(factor.0, scale.0, square.0)
    }
    fn abs(self) -> Self {
        Counted(self.0.abs())
    }
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
}
