//! The operators of a scalar that is not the machine's own.

/// Implements `+ − · /`, the sign, `+= −= ·=`, 0 and 1 for a type by its own functions `sum`,
/// `difference`, `product`, `quotient`, `negative` and `vanishes`, and its constants `ZERO` and
/// `ONE`.
#[macro_export]
macro_rules! operators {
    ($scalar:ident) => {
        $crate::operators!(@plain $scalar: Add add sum, Sub sub difference, Mul mul product, Div div quotient);
        $crate::operators!(@assigning $scalar: AddAssign add_assign sum, SubAssign sub_assign difference,
            MulAssign mul_assign product);
        impl std::ops::Neg for $scalar {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self {
                <$scalar>::negative(self)
            }
        }
        impl num_traits::Zero for $scalar {
            fn zero() -> Self {
                <$scalar>::ZERO
            }
            fn is_zero(&self) -> bool {
                <$scalar>::vanishes(*self)
            }
        }
        impl num_traits::One for $scalar {
            fn one() -> Self {
                <$scalar>::ONE
            }
        }
    };
    (@plain $scalar:ident: $($operator:ident $method:ident $function:ident),+) => {$(
        impl std::ops::$operator for $scalar {
            type Output = Self;
            #[inline]
            fn $method(self, other: Self) -> Self {
                <$scalar>::$function(self, other)
            }
        }
    )+};
    (@assigning $scalar:ident: $($operator:ident $method:ident $function:ident),+) => {$(
        impl std::ops::$operator for $scalar {
            #[inline]
            fn $method(&mut self, other: Self) {
                *self = <$scalar>::$function(*self, other);
            }
        }
    )+};
}
