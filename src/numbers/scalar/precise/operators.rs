//! The operators of a scalar that is not the machine's own.

/// Implements `+ − · /`, the sign, `+= −= ·=`, 0 and 1 for a type by its own functions `sum`,
/// `difference`, `product`, `quotient`, `negative` and `vanishes`, and its constants `ZERO` and
/// `ONE`.
#[macro_export]
macro_rules! operators {
    ($scalar:ident) => {
        $crate::operators!(@all [] $scalar);
    };
    (<$v:ident: $bound:ident> $scalar:ty) => {
        $crate::operators!(@all [<$v: $bound>] $scalar);
    };
    (@all [$($generics:tt)*] $scalar:ty) => {
        $crate::operators!(@plain [$($generics)*] $scalar: Add add sum, Sub sub difference,
            Mul mul product, Div div quotient);
        $crate::operators!(@assigning [$($generics)*] $scalar: AddAssign add_assign sum,
            SubAssign sub_assign difference, MulAssign mul_assign product);
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
    (@plain $generics:tt $scalar:ty: $($operator:ident $method:ident $function:ident),+) => {
        $($crate::operators!(@one $generics $scalar: $operator $method $function);)+
    };
    (@one [$($generics:tt)*] $scalar:ty: $operator:ident $method:ident $function:ident) => {
        impl $($generics)* std::ops::$operator for $scalar {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                <$scalar>::$function(self, other)
            }
        }
    };
    (@assigning $generics:tt $scalar:ty: $($operator:ident $method:ident $function:ident),+) => {
        $($crate::operators!(@one_assigning $generics $scalar: $operator $method $function);)+
    };
    (@one_assigning [$($generics:tt)*] $scalar:ty:
        $operator:ident $method:ident $function:ident) => {
        impl $($generics)* std::ops::$operator for $scalar {
            fn $method(&mut self, other: Self) {
                *self = <$scalar>::$function(*self, other);
            }
        }
    };
}
