//! Numbers that matrices are eliminated in: each scalar, and rational numbers themselves. Operands come by
//! reference, as rational numbers are not `Copy`.

use dashu_ratio::RBig;

use crate::scalar::number::Scalar;

/// A number that matrices are eliminated in.
pub trait Field: Clone {
    /// The distance of 1 from the next larger number; 0 where arithmetic is exact.
    const EPSILON: f64;

    /// Returns 0, the neutral element of sums.
    fn zero() -> Self;

    /// Returns the `f64` nearest to |x|.
    fn size(&self) -> f64;

    /// Returns whether the number is exactly 0.
    fn vanishes(&self) -> bool;

    /// Returns the quotient self / other, `other` not being 0.
    fn over(&self, other: &Self) -> Self;

    /// Assigns self − a · b to self.
    fn subtract_product(&mut self, a: &Self, b: &Self);
}

impl<T: Scalar> Field for T {
    const EPSILON: f64 = <T as Scalar>::EPSILON;

    fn zero() -> Self {
        num_traits::Zero::zero()
    }
    fn size(&self) -> f64 {
        Scalar::abs(*self).to_f64()
    }
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
    fn over(&self, other: &Self) -> Self {
        *self / *other
    }
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        *self -= *a * *b;
    }
}

impl Field for RBig {
    const EPSILON: f64 = 0.0;

    fn zero() -> Self {
        RBig::ZERO
    }
    fn size(&self) -> f64 {
        self.to_f64().value().abs()
    }
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
    fn over(&self, other: &Self) -> Self {
        self / other
    }
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        *self -= a * b;
    }
}
