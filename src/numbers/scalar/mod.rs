//! The number types of the mirror, and what may stand in their subscripts.
//!
//! | scalar | digits | what it is for |
//! |---|---|---|
//! | `f32` | 7 | how much the answer hangs on the precision |
//! | `f64` | 16 | Mathcad's own |
//! | [`Bounded`] | 16 | `f64` with a bound on its error |
//! | [`F64x2`] | 31 | a reference for scenes of any size |
//! | [`Exact`] | all | rational numbers: a reference without doubt, for small scenes |

mod bounded;
mod exact;
mod f64x2;
pub mod rational;

use std::fmt::{Debug, Display};
use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_ratio::RBig;
use nalgebra::{ClosedAddAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{One, Zero};

pub use bounded::Bounded;
pub use exact::{Exact, scope};
pub use f64x2::F64x2;

/// What may stand in a subscript: a whole number, or a number of a table that holds one (`k_cnt` holds node numbers
/// beside weights).
pub trait Subscript: Copy {
    /// The subscript as a whole number.
    fn at(self) -> usize;
}

impl Subscript for usize {
    fn at(self) -> usize {
        self
    }
}

impl Subscript for f64 {
    fn at(self) -> usize {
        debug_assert!(self >= 0.0 && self.fract() == 0.0, "{self} is no subscript");
        self as usize
    }
}

impl Subscript for f32 {
    fn at(self) -> usize {
        f64::from(self).at()
    }
}

/// What the listings ask of a number: `+ − · /`, comparison, absolute value, min and max. No square root and nothing
/// transcendental, so that `f32`, `f64` and exact rationals all serve. The square roots of norms are taken on the way out, to `f64`.
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
    /// The scalar nearest to `x`.
    fn from_f64(x: f64) -> Self;

    /// The `f64` nearest to the scalar.
    fn to_f64(self) -> f64;

    /// The scalar nearest to the shortest decimal that reads back to `x`: 0.1 for 0.1, not the dyadic number beside it.
    fn from_decimal(x: f64) -> Self {
        Self::from_f64(x)
    }

    /// The exact value; nothing for an infinity or NaN.
    fn to_rational(self) -> Option<RBig> {
        RBig::try_from(self.to_f64()).ok()
    }

    /// `values` as numerators over one common denominator, where that is cheaper to compute with; otherwise themselves, over 1.
    fn over_common(values: Vec<Self>) -> (Vec<Self>, Self) {
        (values, Self::one())
    }

    /// Whether the two are the same in all that comes of them.
    fn same(self, other: Self) -> bool {
        self == other
    }

    /// The number in decimal with all the digits that are worth having; nothing where its `f64` has them.
    fn digits(self) -> Option<String> {
        None
    }

    /// A bound on the error of the number; nothing where none is kept.
    fn error_bound(self) -> Option<f64> {
        None
    }

    /// What numbers up to `largest` are divided by before they are squared: 1 where no square overflows.
    fn scale(largest: Self) -> Self {
        largest
    }

    /// sqrt(factor) · scale · sqrt(square), as near as the scalar allows; `scale` keeps `square` from overflow.
    fn scaled_root(factor: Self, scale: Self, square: Self) -> f64;

    /// sqrt(self² + other²), as near as the scalar allows.
    fn hypot(self, other: Self) -> f64 {
        let largest = Scalar::max(Scalar::abs(self), Scalar::abs(other));
        if largest == Self::zero() {
            return 0.0;
        }
        let scale = Self::scale(largest);
        let (a, b) = (self / scale, other / scale);
        Self::scaled_root(Self::one(), scale, a * a + b * b)
    }

    /// A whole number of the paper's tables (a node or element number, a restraint) as a scalar.
    fn from_number(n: usize) -> Self {
        Self::from_f64(n as f64)
    }

    /// |x|; of −0 it is 0.
    fn abs(self) -> Self {
        if self > Self::zero() { self } else { Self::zero() - self }
    }

    /// The smaller of the two.
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of the two.
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// False for an overflow (∞ − ∞ is not 0) and for NaN.
    #[allow(clippy::eq_op, reason = "∞ − ∞ and NaN − NaN are the test")]
    fn is_finite(self) -> bool {
        self - self == Self::zero()
    }
}

impl Scalar for f64 {
    fn from_f64(x: f64) -> Self {
        x
    }
    fn to_f64(self) -> f64 {
        self
    }
    fn scaled_root(factor: Self, scale: Self, square: Self) -> f64 {
        factor.sqrt() * (scale * square.sqrt())
    }
    fn hypot(self, other: Self) -> f64 {
        f64::hypot(self, other)
    }
}

impl Scalar for f32 {
    fn from_f64(x: f64) -> Self {
        x as f32
    }
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    fn scaled_root(factor: Self, scale: Self, square: Self) -> f64 {
        f64::from(factor.sqrt() * (scale * square.sqrt()))
    }
    fn hypot(self, other: Self) -> f64 {
        f64::from(f32::hypot(self, other))
    }
}
