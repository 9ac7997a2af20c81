//! The operators of a scalar that is not the machine's own.

/// Implements `+ − · /`, the sign, and `+= −= ·=` for a type by its own functions `sum`,
/// `difference`, `product`, `quotient` and `negative`.
macro_rules! operators {
    ($scalar:ident) => {
        operators!(@plain $scalar: Add add sum, Sub sub difference, Mul mul product,
            Div div quotient);
        operators!(@assigning $scalar: AddAssign add_assign sum, SubAssign sub_assign difference,
            MulAssign mul_assign product);
        impl std::ops::Neg for $scalar {
            type Output = Self;
            fn neg(self) -> Self {
                $scalar::negative(self)
            }
        }
    };
    (@plain $scalar:ident: $($operator:ident $method:ident $function:ident),+) => {
        $(impl std::ops::$operator for $scalar {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                $scalar::$function(self, other)
            }
        })+
    };
    (@assigning $scalar:ident: $($operator:ident $method:ident $function:ident),+) => {
        $(impl std::ops::$operator for $scalar {
            fn $method(&mut self, other: Self) {
                *self = $scalar::$function(*self, other);
            }
        })+
    };
}
pub(crate) use operators;
