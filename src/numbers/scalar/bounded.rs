//! An `f64` that carries a bound on its error: the mirror, run in it, tells how far rounding may have led.
//!
//! Each operation adds its own rounding error, which is computed and not estimated (of a sum and a product it is itself an `f64`, of
//! a quotient the remainder over the divisor), to what it passes on of its operands' errors. Source: J. H. Wilkinson's running error
//! analysis, as in N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., section 3.3.

use std::fmt;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use super::{Scalar, Subscript};

/// A number within `error` of `value`. It compares as its value, so that what runs in it takes the same turns as in `f64`.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    value: f64,
    error: f64,
}

/// Covers the roundings of an error's own few operations.
const ROUNDED_UP: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Below it a product's or quotient's rounding error may itself underflow; both far above the smallest numbers.
const SMALL: f64 = 1e-280;
const SMALL_ERROR: f64 = 1e-300;

impl Bounded {
    /// A number within `error` of `value`.
    pub fn new(value: f64, error: f64) -> Self {
        // A NaN, as of 0 times an infinite error, bounds nothing.
        Bounded { value, error: if error.is_nan() { f64::INFINITY } else { error * ROUNDED_UP } }
    }

    /// The bound on |value − the number without rounding|; infinite where there is none.
    pub fn error(self) -> f64 {
        self.error
    }
}

/// The error of a product or quotient from its own rounding.
fn own(value: f64, rounding: f64) -> f64 {
    if value.abs() < SMALL { rounding.abs() + SMALL_ERROR } else { rounding.abs() }
}

impl Add for Bounded {
    type Output = Self;
    fn add(self, y: Self) -> Self {
        let value = self.value + y.value;
        let of_y = value - self.value;
        let rounding = (self.value - (value - of_y)) + (y.value - of_y);
        Bounded::new(value, self.error + y.error + rounding.abs())
    }
}

impl Sub for Bounded {
    type Output = Self;
    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

impl Mul for Bounded {
    type Output = Self;
    fn mul(self, y: Self) -> Self {
        let value = self.value * y.value;
        if (self.value == 0.0 && self.error == 0.0) || (y.value == 0.0 && y.error == 0.0) {
            return Bounded { value, error: 0.0 };
        }
        let passed = self.value.abs() * y.error + y.value.abs() * self.error + self.error * y.error;
        Bounded::new(value, passed + own(value, self.value.mul_add(y.value, -value)))
    }
}

impl Div for Bounded {
    type Output = Self;
    fn div(self, y: Self) -> Self {
        let (value, least) = (self.value / y.value, y.value.abs() - y.error);
        if self.value == 0.0 && self.error == 0.0 && least > 0.0 {
            return Bounded { value, error: 0.0 };
        }
        if least.is_nan() || least <= 0.0 {
            return Bounded { value, error: f64::INFINITY };
        }
        let rounding = (-value).mul_add(y.value, self.value) / y.value;
        let passed = (self.error + value.abs() * y.error) / (least / ROUNDED_UP);
        Bounded::new(value, passed + own(value, rounding))
    }
}

impl Neg for Bounded {
    type Output = Self;
    fn neg(self) -> Self {
        Bounded { value: -self.value, ..self }
    }
}

impl AddAssign for Bounded {
    fn add_assign(&mut self, y: Self) {
        *self = *self + y;
    }
}

impl SubAssign for Bounded {
    fn sub_assign(&mut self, y: Self) {
        *self = *self - y;
    }
}

impl MulAssign for Bounded {
    fn mul_assign(&mut self, y: Self) {
        *self = *self * y;
    }
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

impl Zero for Bounded {
    fn zero() -> Self {
        Bounded { value: 0.0, error: 0.0 }
    }
    /// Known to be 0.
    fn is_zero(&self) -> bool {
        self.value == 0.0 && self.error == 0.0
    }
}

impl One for Bounded {
    fn one() -> Self {
        Bounded { value: 1.0, error: 0.0 }
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
    /// The decimal is within half a unit in the last place.
    fn from_decimal(x: f64) -> Self {
        let whole = x.fract() == 0.0 && x.abs() < 1e15;
        Bounded { value: x, error: if whole { 0.0 } else { x.abs() * f64::EPSILON / 2.0 + 5e-324 } }
    }
    /// Value and bound.
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
