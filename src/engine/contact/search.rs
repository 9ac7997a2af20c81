//! The search for the point of a surface that is closest to a given point, in any scalar.
//!
//! ```text
//!        normal ^         o p            side < 0: p is outside the body, which lies on the left
//!               |         :              from a to b
//!     b *-------+---------x------* a     x: the point closest to p; xi counts from a to b
//!        . . . . body . . . .
//!
//!     convex corner   o p          concave corner      \ o p /
//!                    :                                  \ : /
//!               ----*               it is on             \:/
//!             . . . .\              either edge           *
//!             . body .\                                  body
//! ```
//!
//! At a corner both edges are equally near. The edge whose line is farther from p is taken: its
//! side has the right sign, because the sum of the two normals has it (Bærentzen and Aanæs, IEEE
//! TVCG 11:243, 2005).
//!
//! No square root is taken: distances are compared as squares, so that exact numbers can be used.

use numbers::scalar::Scalar;

/// Returns whether a point lies in a triangle or on a side of it; the corners run anticlockwise.
pub fn is_in_triangle([a, b, c]: [[f64; 2]; 3], p: [f64; 2]) -> bool {
    [[a, b], [b, c], [c, a]].iter().all(|[from, to]| f64::orientation(*from, *to, p) >= 0.0)
}

/// Returns whether a point lies inside closed outlines, given by their sides: a line from it upwards crosses
/// an odd number.
pub fn is_inside(sides: impl Iterator<Item = [[f64; 2]; 2]>, p: [f64; 2]) -> bool {
    let is_above = |[a, b]: &[[f64; 2]; 2]| {
        (a[0] > p[0]) != (b[0] > p[0]) && (f64::orientation(*a, *b, p) > 0.0) == (b[0] < a[0])
    };
    !sides.filter(is_above).count().is_multiple_of(2)
}

/// Returns the square of the distance of `p` from the segment between two ends, length².
pub(super) fn distance_square<T: Scalar>([a, b]: [[T; 2]; 2], p: [T; 2]) -> T {
    let (along, square) = (minus(b, a), |v: [T; 2]| dot(v, v));
    let xi = dot(along, minus(p, a)) / square(along);
    if xi < T::zero() {
        square(minus(p, a))
    } else if xi > T::one() {
        square(minus(p, b))
    } else {
        line_square([a, b], p)
    }
}

/// Returns the square of the distance of `p` from the line through two points, length².
fn line_square<T: Scalar>([a, b]: [[T; 2]; 2], p: [T; 2]) -> T {
    let (along, side) = (minus(b, a), T::orientation(a, b, p));
    side * side / dot(along, along)
}

/// Returns the index of the segment, given by its two ends, that is closest to `p`.
pub fn closest<T: Scalar>(segments: &[[[T; 2]; 2]], p: [T; 2]) -> Option<usize> {
    let squares = |ends: &[[T; 2]; 2]| [distance_square(*ends, p), line_square(*ends, p)];
    let nearest = segments.iter().map(squares).enumerate().reduce(|best, next| {
        let ([own, line], [other, farther]) = (best.1, next.1);
        if other < own || other == own && farther > line { next } else { best }
    });
    nearest.map(|(k, _)| k)
}

pub(super) fn minus<T: Scalar>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn dot<T: Scalar>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[0] + a[1] * b[1]
}
