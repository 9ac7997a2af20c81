//! The machine's own numbers as scalars and subscripts.

use robust::{Coord, orient2d};

use super::number::{Scalar, Subscript};

impl Subscript for usize {
    fn index(self) -> usize {
        self
    }
}

impl Subscript for f64 {
    fn index(self) -> usize {
        assert!(self >= 0.0 && self.fract() == 0.0, "{self} is no subscript");
        self as usize
    }
}

impl Subscript for f32 {
    fn index(self) -> usize {
        f64::from(self).index()
    }
}

/// Implements [`Scalar`] for a float of the machine.
macro_rules! native {
    ($($float:ident),+) => {
        $(impl Scalar for $float {
            const EPSILON: f64 = $float::EPSILON as f64;

            fn from_f64(x: f64) -> Self {
                x as $float
            }
            fn to_f64(self) -> f64 {
                self.into()
            }
            fn scaled_root(factor: Self, scale: Self, square: Self) -> f64 {
                (factor.sqrt() * (scale * square.sqrt())).into()
            }
            fn orientation(a: [Self; 2], b: [Self; 2], c: [Self; 2]) -> Self {
                let place = |[x, y]: [Self; 2]| Coord { x: f64::from(x), y: f64::from(y) };
                orient2d(place(a), place(b), place(c)) as $float
            }
            fn hypot(self, other: Self) -> f64 {
                $float::hypot(self, other).into()
            }
        })+
    };
}

native!(f32, f64);
