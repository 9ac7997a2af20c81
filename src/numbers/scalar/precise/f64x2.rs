//! Double-double numbers: the unevaluated sum of two `f64`, about 31 digits.
//!
//! Source: M. Joldes, J.-M. Muller, V. Popescu, *Tight and rigorous error bounds for basic building
//! blocks of double-word arithmetic*, ACM TOMS 44(2), 2017: algorithms 6 (sum), 12 (product), 17
//! (quotient). Root: V. Lefèvre, N. Louvet, J.-M. Muller, J. Picot, L. Rideau, *Accurate
//! calculation of Euclidean norms using double-word arithmetic*, ACM TOMS 49(1), 2023. Relative
//! errors, u = 2^-53: sum 3 u², product 4 u², quotient 9.8 u², root 3.125 u², while nothing
//! underflows.

use std::fmt;

use dashu_ratio::RBig;

use super::rational;
use crate::operators;
use crate::scalar::number::{Scalar, Subscript};

/// hi + lo, hi being the `f64` nearest to the sum. An overflow or NaN stands in hi; lo is then 0.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct F64x2 {
    hi: f64,
    lo: f64,
}

impl F64x2 {
    pub(super) const ZERO: Self = F64x2 { hi: 0.0, lo: 0.0 };
    pub(super) const ONE: Self = F64x2 { hi: 1.0, lo: 0.0 };

    /// Returns the number nearest to `x`.
    pub fn nearest(x: &RBig) -> Self {
        let hi = rational::nearest(x);
        match RBig::try_from(hi) {
            Ok(exact) => F64x2 { hi, lo: rational::nearest(&(x - exact)) },
            // Beyond the range of an f64 it is infinite, and has no rest.
            Err(_) => F64x2 { hi, lo: 0.0 },
        }
    }

    /// Returns the two numbers whose sum it is, the larger first.
    pub fn halves(self) -> [f64; 2] {
        [self.hi, self.lo]
    }

    #[inline]
    fn sum(x: Self, y: Self) -> Self {
        let [high, high_error] = two_sum(x.hi, y.hi);
        let [low, low_error] = two_sum(x.lo, y.lo);
        let [sum, error] = fast_two_sum(high, high_error + low);
        F64x2::settled(fast_two_sum(sum, low_error + error), x.hi + y.hi)
    }

    #[inline]
    fn difference(x: Self, y: Self) -> Self {
        x + -y
    }

    #[inline]
    fn product(x: Self, y: Self) -> Self {
        let [product, error] = two_product(x.hi, y.hi);
        // Where x is an f64 the rest is one product, of the same digits.
        let low = match x.lo == 0.0 {
            true => x.hi * y.lo,
            false => x.lo.mul_add(y.hi, x.hi.mul_add(y.lo, x.lo * y.lo)),
        };
        F64x2::settled(fast_two_sum(product, error + low), product)
    }

    fn quotient(x: Self, y: Self) -> Self {
        let quotient = x.hi / y.hi;
        let [product, error] = two_product(y.hi, quotient);
        let [high, low] = fast_two_sum(product, y.lo.mul_add(quotient, error));
        let rest = (x.hi - high) + (x.lo - low);
        F64x2::settled(fast_two_sum(quotient, rest / y.hi), quotient)
    }

    fn negative(x: Self) -> Self {
        F64x2 { hi: -x.hi, lo: -x.lo }
    }

    fn vanishes(x: Self) -> bool {
        x.hi == 0.0
    }

    /// Returns `sum`, or where it is not finite what `plain`, the same operation in `f64`, says.
    #[inline]
    fn settled([hi, lo]: [f64; 2], plain: f64) -> Self {
        match (hi.is_finite() && lo.is_finite(), plain.is_finite()) {
            (true, _) => F64x2 { hi, lo },
            // The last rounding passed the largest f64.
            (false, true) if plain != 0.0 => F64x2 { hi: f64::INFINITY.copysign(plain), lo: 0.0 },
            // Also where f64 has the result and the way to its error does not: x / ∞ is 0.
            (false, _) => F64x2 { hi: plain, lo: 0.0 },
        }
    }
}

operators!(F64x2);

/// Returns a + b and its rounding error.
#[inline]
fn two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    let of_b = sum - a;
    [sum, (a - (sum - of_b)) + (b - of_b)]
}

/// Returns a + b and its rounding error, where |a| >= |b| or a is 0.
#[inline]
fn fast_two_sum(a: f64, b: f64) -> [f64; 2] {
    let sum = a + b;
    [sum, b - (sum - a)]
}

/// Returns a · b and its rounding error.
#[inline]
fn two_product(a: f64, b: f64) -> [f64; 2] {
    let product = a * b;
    [product, a.mul_add(b, -product)]
}

impl Subscript for F64x2 {
    fn index(self) -> usize {
        assert!(self.lo == 0.0, "{self} is no subscript");
        self.hi.index()
    }
}

impl Scalar for F64x2 {
    const EPSILON: f64 = f64::EPSILON * f64::EPSILON;

    fn from_f64(x: f64) -> Self {
        F64x2 { hi: x, lo: 0.0 }
    }
    fn to_f64(self) -> f64 {
        self.hi
    }
    fn from_decimal(x: f64) -> Self {
        rational::of_decimal(x).map_or(F64x2::from_f64(x), |x| F64x2::nearest(&x))
    }
    fn to_rational(self) -> Option<RBig> {
        Some(RBig::try_from(self.hi).ok()? + RBig::try_from(self.lo).ok()?)
    }
    fn digits(self) -> Option<String> {
        Some(self.to_string())
    }
    /// NaN of a negative number.
    fn root(self) -> Self {
        let plain = self.hi.sqrt();
        if plain == 0.0 {
            return F64x2 { hi: plain, lo: 0.0 };
        }
        let rest = self.lo + (-plain).mul_add(plain, self.hi);
        F64x2::settled(fast_two_sum(plain, rest / (2.0 * plain)), plain)
    }
    fn length(x: Self, y: Self) -> Self {
        let largest = Scalar::max(Scalar::abs(x), Scalar::abs(y));
        let (x, y) = (x / largest, y / largest);
        largest * (x * x + y * y).root()
    }
    fn scaled_root(factor: Self, scale: Self, square: Self) -> f64 {
        (factor.root() * (scale * square.root())).hi
    }
}

impl fmt::Display for F64x2 {
    /// Writes 32 significant digits, or fewer where fewer say it exactly.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.to_rational() {
            Some(x) => f.write_str(&rational::decimal(&x, 32)),
            None => write!(f, "{}", self.hi),
        }
    }
}
