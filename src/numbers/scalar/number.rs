//! What the mirror asks of a number.

use std::fmt::{Debug, Display};
use std::ops::{Add, Div, Mul, Neg, Sub};

use nalgebra::{ClosedAddAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{One, Zero};

/// What may stand in a subscript: a whole number, or a number of a table that contains one
/// (`k_cnt` has node numbers beside weights).
pub trait Subscript: Copy {
    /// Returns the subscript as a whole number.
    fn index(self) -> usize;
}

/// What the listings ask of a number: `+ − · /`, comparison, absolute value, min and max. They
/// ask for no root and nothing transcendental, so that `f32`, `f64` and exact rationals all serve; roots, as
/// of norms, are for what stands around the listings.
pub trait Scalar:
    Subscript
    + Debug
    + Display
    + PartialOrd
    + Zero
    + One
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + nalgebra::Scalar
{
    /// The distance of 1 from the next larger number; 0 where arithmetic is exact.
    const EPSILON: f64 = f64::EPSILON;

    /// Returns the scalar nearest to `x`.
    fn from_f64(x: f64) -> Self;

    /// Returns the `f64` nearest to the scalar.
    fn to_f64(self) -> f64;

    /// Returns the scalar nearest to the shortest decimal that reads back to `x`: 0.1 for 0.1, not
    /// the dyadic number beside it.
    fn from_decimal(x: f64) -> Self {
        Self::from_f64(x)
    }

    /// Returns the exact value, or nothing for an infinity or NaN.
    #[cfg(feature = "precise")]
    fn to_rational(self) -> Option<dashu_ratio::RBig> {
        dashu_ratio::RBig::try_from(self.to_f64()).ok()
    }

    /// Returns `values` as numerators over one common denominator, where that is cheaper to
    /// compute with; otherwise themselves, over 1.
    fn over_common(values: Vec<Self>) -> (Vec<Self>, Self) {
        (values, Self::one())
    }

    /// Returns the number in decimal with all the digits that are worth having, or nothing where
    /// its `f64` has them.
    fn digits(self) -> Option<String> {
        None
    }

    /// Returns what numbers up to `largest` are divided by before they are squared: 1 where no
    /// square overflows.
    fn scale(largest: Self) -> Self {
        largest
    }

    /// Returns sqrt(factor) · scale · sqrt(square), as near as the scalar allows; `scale` keeps
    /// `square` from overflow.
    fn scaled_root(factor: Self, scale: Self, square: Self) -> f64;

    /// Returns sqrt(self² + other²), as near as the scalar allows.
    fn hypot(self, other: Self) -> f64 {
        let largest = Scalar::max(Scalar::abs(self), Scalar::abs(other));
        if largest == Self::zero() {
            return 0.0;
        }
        let scale = Self::scale(largest);
        let (a, b) = (self / scale, other / scale);
        Self::scaled_root(Self::one(), scale, a * a + b * b)
    }

    /// Returns the square root in the scalar's own digits; of exact numbers, one that is not
    /// rational to 100 digits.
    fn root(self) -> Self {
        Self::from_f64(self.to_f64().sqrt())
    }

    /// Returns sqrt(x² + y²) in the scalar's own digits; of exact numbers, a root that is not
    /// rational to 100 digits.
    fn length(x: Self, y: Self) -> Self {
        Self::from_f64(x.to_f64().hypot(y.to_f64()))
    }

    /// Returns a whole number of the paper's tables (of a node, or a restraint) as a scalar.
    fn from_number(n: usize) -> Self {
        Self::from_f64(n as f64)
    }

    /// Twice the area of the triangle a, b, c: > 0 where c lies on the left of the way from a to b.
    /// Of a float of the machine the sign is exact.
    fn orientation(a: [Self; 2], b: [Self; 2], c: [Self; 2]) -> Self {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    /// Returns |x|, which is 0 for −0.
    fn abs(self) -> Self {
        if self > Self::zero() { self } else { Self::zero() - self }
    }

    /// Returns the smaller of the two, and `self` where one is NaN.
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// Returns the larger of the two, and `self` where one is NaN.
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// Returns false for an overflow (∞ − ∞ is not 0) and for NaN.
    #[allow(clippy::eq_op, reason = "∞ − ∞ and NaN − NaN are the test")]
    fn is_finite(self) -> bool {
        self - self == Self::zero()
    }
}
