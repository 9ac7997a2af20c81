//! A number that counts what is done with it: the mirror, generic over its scalar, tells by it how many operations the listing takes.

use std::cell::Cell;
use std::fmt;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use crate::numbers::scalar::{Scalar, Subscript};

thread_local! {
    static OPERATIONS: Cell<u64> = const { Cell::new(0) };
}

fn one_more() {
    OPERATIONS.set(OPERATIONS.get() + 1);
}

/// What `work` gives, and the sums, differences, products, quotients and comparisons that it made, one each. A test for 0 or for
/// overflow is Mathcad's and counts nothing.
pub fn counting<R>(work: impl FnOnce() -> R) -> (R, u64) {
    let before = OPERATIONS.get();
    let result = work();
    (result, OPERATIONS.get() - before)
}

/// An `f64` that counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted(f64);

macro_rules! counted {
    ($($trait:ident $method:ident),+) => {
        $(impl $trait for Counted {
            type Output = Counted;
            fn $method(self, other: Counted) -> Counted {
                one_more();
                Counted(self.0.$method(other.0))
            }
        })+
    };
}
counted!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Counted {
    type Output = Counted;
    fn neg(self) -> Counted {
        Counted(-self.0)
    }
}

impl AddAssign for Counted {
    fn add_assign(&mut self, other: Counted) {
        *self = *self + other;
    }
}

impl SubAssign for Counted {
    fn sub_assign(&mut self, other: Counted) {
        *self = *self - other;
    }
}

impl MulAssign for Counted {
    fn mul_assign(&mut self, other: Counted) {
        *self = *self * other;
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Counted) -> Option<std::cmp::Ordering> {
        one_more();
        self.0.partial_cmp(&other.0)
    }
}

impl Zero for Counted {
    fn zero() -> Self {
        Counted(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Counted {
    fn one() -> Self {
        Counted(1.0)
    }
}

impl fmt::Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Subscript for Counted {
    fn at(self) -> usize {
        self.0.at()
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
