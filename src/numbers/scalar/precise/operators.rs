//! The operators of a scalar that is not the machine's own.

/// Implements `+ − · /`, the same with `=`, the sign, 0 and 1 for a type by its own functions `sum`,
/// `difference`, `product`, `quotient`, `negative` and `vanishes`, and its constants `ZERO` and
/// `ONE`. In brackets before the type stand its parameters.
macro_rules! operators {
    ([$($generics:tt)*] $scalar:ty) => {
        operators!([$($generics)*] $scalar: Add add sum, AddAssign add_assign);
        operators!([$($generics)*] $scalar: Sub sub difference, SubAssign sub_assign);
        operators!([$($generics)*] $scalar: Mul mul product, MulAssign mul_assign);
        operators!([$($generics)*] $scalar: Div div quotient, DivAssign div_assign);
        impl $($generics)* std::ops::Neg for $scalar {
            type Output = Self;
            fn neg(self) -> Self {
                <$scalar>::negative(self)
            }
        }
        impl $($generics)* num_traits::Zero for $scalar {
            fn zero() -> Self {
                <$scalar>::ZERO
            }
            fn is_zero(&self) -> bool {
                <$scalar>::vanishes(*self)
            }
        }
        impl $($generics)* num_traits::One for $scalar {
            fn one() -> Self {
                <$scalar>::ONE
            }
        }
    };
    ([$($generics:tt)*] $scalar:ty: $operator:ident $method:ident $function:ident, $assigning:ident $assign:ident) => {
        impl $($generics)* std::ops::$operator for $scalar {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                <$scalar>::$function(self, other)
            }
        }
        impl $($generics)* std::ops::$assigning for $scalar {
            fn $assign(&mut self, other: Self) {
                *self = <$scalar>::$function(*self, other);
            }
        }
    };
}

pub(crate) use operators;
