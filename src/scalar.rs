//! The number type of the mirror, and what may stand in its subscripts.

use std::fmt::{Debug, Display};
use std::ops::{Add, Div, Mul, Neg, Sub};

use nalgebra::{ClosedAddAssign, ClosedMulAssign};
use num_traits::{One, Zero};

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
/// transcendental, so that `f32`, `f64` and exact rationals all serve.
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
    + ClosedMulAssign
    + nalgebra::Scalar
{
    /// The scalar nearest to `x`.
    fn from_f64(x: f64) -> Self;

    /// The `f64` nearest to the scalar.
    fn to_f64(self) -> f64;

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
}

impl Scalar for f32 {
    fn from_f64(x: f64) -> Self {
        x as f32
    }
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}
