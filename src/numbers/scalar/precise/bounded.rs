//! A number that carries a bound on its error: the mirror, run in it, tells how far rounding may
//! have led.
//!
//! Each operation adds its own rounding error to what it passes on of its operands' errors. In `f64`
//! the rounding error is computed and not estimated: of a sum and a product it is itself an `f64`,
//! of a quotient the remainder over the divisor. In [`F64x2`] it is what is proven of the operation.
//! Source: J. H. Wilkinson's running error analysis, as in N. J. Higham, *Accuracy and Stability of
//! Numerical Algorithms*, 2nd ed., section 3.3.

use std::cell::RefCell;
use std::fmt;

use dashu_ratio::RBig;
use num_traits::Zero;

use super::f64x2::F64x2;
use crate::operators;
use crate::scalar::number::{Scalar, Subscript};

/// A number within `error` of `value`. It compares as its value, so that what runs in it takes the
/// same turns as in V.
#[derive(Clone, Copy, Debug)]
pub struct WithBound<V> {
    value: V,
    error: f64,
}

/// A comparison of two numbers that rounding may have decided: the size of their difference and the
/// bound on its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unsure {
    /// The absolute difference of the two numbers.
    pub margin: f64,
    /// The bound on the rounding error of the difference.
    pub bound: f64,
}

impl Unsure {
    /// Returns what leaves the comparison of two numbers with bounds to rounding; None where it is sure.
    pub fn from_comparison<T: Scalar>(x: T, y: T) -> Option<Self> {
        let difference = x + -y;
        let (margin, bound) = (difference.to_f64().abs(), difference.error_bound().unwrap_or(0.0));
        // Where both are exact, so is the comparison, also of equal ones.
        (bound > 0.0 && margin <= bound).then_some(Unsure { margin, bound })
    }
}

thread_local! {
    static UNSURE: RefCell<Option<Vec<Unsure>>> = const { RefCell::new(None) };
}

/// Does `work`; returns its result and, of numbers with a bound, every comparison that rounding may
/// have decided in it.
pub fn compared<R>(work: impl FnOnce() -> R) -> (R, Vec<Unsure>) {
    let before = UNSURE.replace(Some(Vec::new()));
    let result = work();
    (result, UNSURE.replace(before).unwrap_or_default())
}

/// An `f64` with a bound on its error.
pub type Bounded = WithBound<f64>;

/// A double-double number with a bound on its error.
pub type BoundedDouble = WithBound<F64x2>;

/// A number whose operations have rounding errors that are known, or bounded.
pub trait Rounded: Scalar {
    /// The number 0.
    const ZERO: Self;

    /// The number 1.
    const ONE: Self;

    /// Returns a bound on the rounding error of `sum`, which is `x` + `y`.
    fn of_sum(x: Self, y: Self, sum: Self) -> f64;

    /// Returns a bound on the rounding error of `product`, which is `x` · `y`.
    fn of_product(x: Self, y: Self, product: Self) -> f64;

    /// Returns a bound on the rounding error of `quotient`, which is `x` / `y`.
    fn of_quotient(x: Self, y: Self, quotient: Self) -> f64;

    /// Returns a bound on the distance of the number made of a decimal from that decimal.
    fn of_decimal(self) -> f64;

    /// Returns the same number in double-double.
    fn double(self) -> F64x2;

    /// Returns how far the number is from its `f64`.
    fn beyond_f64(self) -> f64;
}

/// Covers the roundings of an error's own few operations.
const ROUNDED_UP: f64 = 1.0 + 8.0 * f64::EPSILON;

/// Below `SMALL` a product's or quotient's rounding error may itself underflow, by less than
/// `SMALL_ERROR`; both are far above the smallest numbers.
const SMALL: f64 = 1e-280;
const SMALL_ERROR: f64 = 1e-300;

impl Rounded for f64 {
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;

    fn of_sum(x: f64, y: f64, sum: f64) -> f64 {
        let of_y = sum - x;
        ((x - (sum - of_y)) + (y - of_y)).abs()
    }
    fn of_product(x: f64, y: f64, product: f64) -> f64 {
        underflowing(product, x.mul_add(y, -product))
    }
    fn of_quotient(x: f64, y: f64, quotient: f64) -> f64 {
        underflowing(quotient, (-quotient).mul_add(y, x) / y)
    }
    fn of_decimal(self) -> f64 {
        self.abs() * f64::EPSILON / 2.0 + 5e-324
    }
    fn double(self) -> F64x2 {
        F64x2::from_f64(self)
    }
    fn beyond_f64(self) -> f64 {
        0.0
    }
}

/// u² of double-double, 2^-106.
const SQUARE_UNIT: f64 = f64::EPSILON * f64::EPSILON / 4.0;

impl Rounded for F64x2 {
    const ZERO: F64x2 = F64x2::ZERO;
    const ONE: F64x2 = F64x2::ONE;

    fn of_sum(_: Self, _: Self, sum: Self) -> f64 {
        3.0 * SQUARE_UNIT * sum.to_f64().abs()
    }
    fn of_product(_: Self, _: Self, product: Self) -> f64 {
        underflowing(product.to_f64(), 4.0 * SQUARE_UNIT * product.to_f64())
    }
    fn of_quotient(x: Self, y: Self, quotient: Self) -> f64 {
        let size = x.to_f64().abs().min(quotient.to_f64().abs());
        let underflow =
            if size < SMALL { SMALL_ERROR.max(SMALL_ERROR / y.to_f64().abs()) } else { 0.0 };
        9.8 * SQUARE_UNIT * quotient.to_f64().abs() + underflow
    }
    fn of_decimal(self) -> f64 {
        SQUARE_UNIT * self.to_f64().abs() + SMALL_ERROR
    }
    fn double(self) -> F64x2 {
        self
    }
    fn beyond_f64(self) -> f64 {
        self.halves()[1].abs()
    }
}

/// Returns the size of the rounding error of a product or quotient.
fn underflowing(value: f64, rounding: f64) -> f64 {
    if value.abs() < SMALL { rounding.abs() + SMALL_ERROR } else { rounding.abs() }
}

impl<V: Rounded> WithBound<V> {
    /// Returns the same number and bound in double-double.
    pub fn in_double(self) -> BoundedDouble {
        WithBound { value: self.value.double(), error: self.error }
    }

    /// Returns how far its value, rounded to `f64`, may be from the true one.
    pub fn off(self) -> f64 {
        self.error + self.value.beyond_f64()
    }

    const ZERO: Self = WithBound { value: V::ZERO, error: 0.0 };
    const ONE: Self = WithBound { value: V::ONE, error: 0.0 };

    /// Makes a number within `error` of `value`.
    pub fn new(value: V, error: f64) -> Self {
        // A NaN, as of 0 times an infinite error, bounds nothing.
        WithBound { value, error: if error.is_nan() { f64::INFINITY } else { error * ROUNDED_UP } }
    }

    /// Returns the number without its bound.
    pub fn value(self) -> V {
        self.value
    }

    /// Returns the bound on |value − the number without rounding|, infinite where there is none.
    pub fn error(self) -> f64 {
        self.error
    }

    fn exactly(value: V) -> Self {
        WithBound { value, error: 0.0 }
    }

    fn size(self) -> f64 {
        self.value.to_f64().abs()
    }

    /// Notes the comparison with `y` where it is watched ([`compared`]) and not sure.
    fn note(self, y: Self) {
        UNSURE.with_borrow_mut(|unsure| {
            if let Some(unsure) = unsure {
                unsure.extend(Unsure::from_comparison(self, y));
            }
        });
    }

    fn sum(x: Self, y: Self) -> Self {
        let value = x.value + y.value;
        Self::new(value, x.error + y.error + V::of_sum(x.value, y.value, value))
    }

    fn difference(x: Self, y: Self) -> Self {
        x + -y
    }

    fn product(x: Self, y: Self) -> Self {
        let value = x.value * y.value;
        if x.is_zero() || y.is_zero() {
            return Self::exactly(value);
        }
        let passed = x.size() * y.error + y.size() * x.error + x.error * y.error;
        Self::new(value, passed + V::of_product(x.value, y.value, value))
    }

    fn quotient(x: Self, y: Self) -> Self {
        let value = x.value / y.value;
        let least = (Scalar::abs(y.value) - V::from_f64(y.error)).to_f64();
        if x.is_zero() && least > 0.0 {
            return Self::exactly(value);
        }
        if least.is_nan() || least <= 0.0 {
            return WithBound { value, error: f64::INFINITY };
        }
        let passed = (x.error + value.to_f64().abs() * y.error) / (least / ROUNDED_UP);
        Self::new(value, passed + V::of_quotient(x.value, y.value, value))
    }

    fn negative(x: Self) -> Self {
        WithBound { value: -x.value, ..x }
    }

    /// Returns whether the number is known to be 0.
    fn vanishes(x: Self) -> bool {
        x.value.is_zero() && x.error == 0.0
    }
}

/// A sum of products of double-doubles. What rounding does to it is bounded at the end, of all terms at
/// once: the sum of the same products and bounds one by one takes several times as long.
///
/// Source: T. Ogita, S. M. Rump, S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26(6),
/// 2005, algorithm 5.3; its two parts are both kept.
#[derive(Clone, Copy, Debug)]
pub struct SumOfProducts {
    /// The sum in `f64`, and what that rounds away.
    parts: [f64; 2],
    terms: f64,
    /// The sum of the products' sizes.
    size: f64,
    /// What the bounds of the factors come to.
    passed: f64,
}

impl SumOfProducts {
    /// The sum of none.
    pub const ZERO: Self = SumOfProducts { parts: [0.0; 2], terms: 0.0, size: 0.0, passed: 0.0 };

    /// Adds x · y.
    pub fn add(&mut self, x: BoundedDouble, y: BoundedDouble) {
        if x.is_zero() || y.is_zero() {
            return;
        }
        let size = x.size() * y.size();
        self.parts = F64x2::gather(self.parts, x.value, y.value);
        self.terms += 1.0;
        self.size += size;
        self.passed += x.size() * y.error + y.size() * x.error + x.error * y.error;
        if size < SMALL {
            self.passed += SMALL_ERROR;
        }
    }

    /// Adds the terms of another sum.
    pub fn join(&mut self, other: &Self) {
        self.parts = F64x2::gathered(self.parts, other.parts);
        self.terms += other.terms + 2.0;
        self.size += other.size;
        self.passed += other.passed;
    }

    /// Returns the sum within its bound.
    pub fn total(&self) -> BoundedDouble {
        let (n, of_f64) = (self.terms, 1.0 + 4.0 * self.terms * f64::EPSILON);
        // With S the size of all terms and P that of one: of a term the second part takes up u S from the
        // sum and 3 u P from the product, and rounds by 11 u² P and u² S beside u of itself, which by the
        // k-th term has grown to (k + 3) u S.
        let rounding = (n * (n + 1.0) / 2.0 + 4.0 * n + 11.0) * SQUARE_UNIT * self.size;
        BoundedDouble::new(F64x2::of_parts(self.parts), (self.passed + rounding) * of_f64)
    }
}

operators!(<V: Rounded> WithBound<V>);

impl<V: Rounded> PartialEq for WithBound<V> {
    fn eq(&self, y: &Self) -> bool {
        self.note(*y);
        self.value == y.value
    }
}

impl<V: Rounded> PartialOrd for WithBound<V> {
    fn partial_cmp(&self, y: &Self) -> Option<std::cmp::Ordering> {
        self.note(*y);
        self.value.partial_cmp(&y.value)
    }
}

impl<V: Rounded> Subscript for WithBound<V> {
    fn index(self) -> usize {
        self.value.index()
    }
}

impl<V: Rounded> Scalar for WithBound<V> {
    const EPSILON: f64 = V::EPSILON;

    fn from_f64(x: f64) -> Self {
        Self::exactly(V::from_f64(x))
    }
    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }
    fn from_decimal(x: f64) -> Self {
        let (whole, value) = (x.fract() == 0.0 && x.abs() < 1e15, V::from_decimal(x));
        WithBound { value, error: if whole { 0.0 } else { value.of_decimal() } }
    }
    fn to_rational(self) -> Option<RBig> {
        self.value.to_rational()
    }
    fn digits(self) -> Option<String> {
        self.value.digits()
    }
    fn same(self, other: Self) -> bool {
        self.value == other.value && self.error == other.error
    }
    fn error_bound(self) -> Option<f64> {
        Some(self.error)
    }
    // |x|, the smaller and the larger of two numbers pass through a tie without a jump: these are no
    // decisions.
    fn abs(self) -> Self {
        if self.value > V::ZERO { self } else { Self::ZERO - self }
    }
    fn min(self, other: Self) -> Self {
        let value = Scalar::min(self.value, other.value);
        WithBound { value, error: self.error.max(other.error) }
    }
    fn max(self, other: Self) -> Self {
        let value = Scalar::max(self.value, other.value);
        WithBound { value, error: self.error.max(other.error) }
    }
    fn root(self) -> Self {
        let value = V::root(self.value);
        // |√a − √b| = |a − b| / (√a + √b)
        let passed = if self.error == 0.0 { 0.0 } else { self.error / value.to_f64() };
        Self::new(value, passed * ROUNDED_UP + 32.0 * value.of_decimal())
    }
    /// The root passes on the errors of x and y at most, and adds some roundings of its own.
    fn length(x: Self, y: Self) -> Self {
        let value = V::length(x.value, y.value);
        Self::new(value, x.error + y.error + 32.0 * value.of_decimal())
    }
    fn scaled_root(factor: Self, scale: Self, square: Self) -> f64 {
        V::scaled_root(factor.value, scale.value, square.value)
    }
    fn hypot(self, other: Self) -> f64 {
        Scalar::hypot(self.value, other.value)
    }
    fn is_finite(self) -> bool {
        Scalar::is_finite(self.value)
    }
}

impl<V: Rounded> fmt::Display for WithBound<V> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.value)
    }
}
