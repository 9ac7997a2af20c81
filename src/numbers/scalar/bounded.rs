//! An `f64` that carries a bound on its error: the mirror, run in it, tells how far rounding may
//! have led.
//!
//! Each operation adds its own rounding error to what it passes on of its operands' errors. The
//! rounding error is computed and not estimated: of a sum and a product it is itself an `f64`, of a
//! quotient the remainder over the divisor. Source: J. H. Wilkinson's running error analysis, as in
//! N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., section 3.3.

use std::fmt;

use num_traits::Zero;

use super::number::{Scalar, Subscript};
use super::operators::operators;

/// A number within `error` of `value`. It compares as its value, so that what runs in it takes the
/// same turns as in `f64`.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    value: f64,
    error: f64,
}

/// Covers the roundings of an error's own few operations.
const ROUNDED_UP: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Below `SMALL` a product's or quotient's rounding error may itself underflow, by less than
/// `SMALL_ERROR`; both are far above the smallest numbers.
const SMALL: f64 = 1e-280;
const SMALL_ERROR: f64 = 1e-300;

impl Bounded {
    const ZERO: Self = Bounded { value: 0.0, error: 0.0 };
    const ONE: Self = Bounded { value: 1.0, error: 0.0 };

    /// Makes a number within `error` of `value`.
    pub fn new(value: f64, error: f64) -> Self {
        // A NaN, as of 0 times an infinite error, bounds nothing.
        Bounded { value, error: if error.is_nan() { f64::INFINITY } else { error * ROUNDED_UP } }
    }

    /// Returns the bound on |value − the number without rounding|, infinite where there is none.
    pub fn error(self) -> f64 {
        self.error
    }

    fn sum(x: Self, y: Self) -> Self {
        let value = x.value + y.value;
        let of_y = value - x.value;
        let rounding = (x.value - (value - of_y)) + (y.value - of_y);
        Bounded::new(value, x.error + y.error + rounding.abs())
    }

    fn difference(x: Self, y: Self) -> Self {
        x + -y
    }

    fn product(x: Self, y: Self) -> Self {
        let value = x.value * y.value;
        if x.is_zero() || y.is_zero() {
            return Bounded { value, error: 0.0 };
        }
        let passed = x.value.abs() * y.error + y.value.abs() * x.error + x.error * y.error;
        Bounded::new(value, passed + own(value, x.value.mul_add(y.value, -value)))
    }

    fn quotient(x: Self, y: Self) -> Self {
        let (value, least) = (x.value / y.value, y.value.abs() - y.error);
        if x.is_zero() && least > 0.0 {
            return Bounded { value, error: 0.0 };
        }
        if least.is_nan() || least <= 0.0 {
            return Bounded { value, error: f64::INFINITY };
        }
        let rounding = (-value).mul_add(y.value, x.value) / y.value;
        let passed = (x.error + value.abs() * y.error) / (least / ROUNDED_UP);
        Bounded::new(value, passed + own(value, rounding))
    }

    fn negative(x: Self) -> Self {
        Bounded { value: -x.value, ..x }
    }

    /// Returns whether the number is known to be 0.
    fn vanishes(x: Self) -> bool {
        x.value == 0.0 && x.error == 0.0
    }
}

operators!(Bounded);

/// Returns the error of a product or quotient from its own rounding.
fn own(value: f64, rounding: f64) -> f64 {
    if value.abs() < SMALL { rounding.abs() + SMALL_ERROR } else { rounding.abs() }
}

impl PartialEq for Bounded {
    fn eq(&self, y: &Self) -> bool {
        self.value == y.value
    }
}

impl PartialOrd for Bounded {
    fn partial_cmp(&self, y: &Self) -> Option<std::cmp::Ordering> {
        self.value.partial_cmp(&y.value)
    }
}

impl Subscript for Bounded {
    fn at(self) -> usize {
        self.value.at()
    }
}

impl Scalar for Bounded {
    fn from_f64(x: f64) -> Self {
        Bounded { value: x, error: 0.0 }
    }
    fn to_f64(self) -> f64 {
        self.value
    }
    /// The decimal is within half a unit in the last place of `x`.
    fn from_decimal(x: f64) -> Self {
        let whole = x.fract() == 0.0 && x.abs() < 1e15;
        Bounded { value: x, error: if whole { 0.0 } else { x.abs() * f64::EPSILON / 2.0 + 5e-324 } }
    }
    fn same(self, other: Self) -> bool {
        self.value == other.value && self.error == other.error
    }
    fn error_bound(self) -> Option<f64> {
        Some(self.error)
    }
    fn scaled_root(factor: Self, scale: Self, square: Self) -> f64 {
        f64::scaled_root(factor.value, scale.value, square.value)
    }
    fn hypot(self, other: Self) -> f64 {
        self.value.hypot(other.value)
    }
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }
}

impl fmt::Display for Bounded {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.value)
    }
}
