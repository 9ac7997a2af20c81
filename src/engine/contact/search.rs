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

/// Returns whether a point lies inside closed outlines, given by their sides: a line from it upwards crosses an odd number.
pub fn is_inside(sides: impl Iterator<Item = [[f64; 2]; 2]>, p: [f64; 2]) -> bool {
    let is_above = |[a, b]: &[[f64; 2]; 2]| {
        (a[0] > p[0]) != (b[0] > p[0]) && (f64::orientation(*a, *b, p) > 0.0) == (b[0] < a[0])
    };
    !sides.filter(is_above).count().is_multiple_of(2)
}

/// An edge in a shape, with its body on the left.
#[derive(Clone, Copy, Debug)]
pub struct Segment<T> {
    /// The coordinates of its two ends, length.
    pub ends: [[T; 2]; 2],
    /// The vector from its first end to its second, length.
    along: [T; 2],
    /// The square of its length, length².
    square: T,
}

/// The point of a segment that is closest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest<T> {
    /// Twice the area of the two ends and the point, length²: > 0 on the body's side of the line.
    pub side: T,
    /// The square of the segment's length, length².
    pub square: T,
    /// The square of the distance to the segment, length².
    pub distance_square: T,
}

impl<T: Scalar> Segment<T> {
    /// Returns the segment between two ends.
    pub fn new(ends: [[T; 2]; 2]) -> Self {
        let along = minus(ends[1], ends[0]);
        Segment { ends, along, square: dot(along, along) }
    }

    /// Returns its point that is closest to `p`.
    pub fn closest(&self, p: [T; 2]) -> Closest<T> {
        let xi = dot(self.along, minus(p, self.ends[0])) / self.square;
        let side = self.side(p);
        let square = |a: [T; 2]| dot(a, a);
        let distance_square = if xi < T::zero() {
            square(minus(p, self.ends[0]))
        } else if xi > T::one() {
            square(minus(p, self.ends[1]))
        } else {
            side * side / self.square
        };
        Closest { side, square: self.square, distance_square }
    }

    /// Returns a number > 0 where `p` lies on the body's side of its line, 0 on the line, else < 0;
    /// of `f64` the sign is exact.
    pub fn side(&self, p: [T; 2]) -> T {
        T::orientation(self.ends[0], self.ends[1], p)
    }
}

impl<T: Scalar> Closest<T> {
    fn is_nearer_than(&self, other: &Self) -> bool {
        let line_square = |of: &Self| of.side * of.side / of.square;
        self.distance_square < other.distance_square
            || self.distance_square == other.distance_square
                && line_square(self) > line_square(other)
    }
}

/// Returns the index of the segment that is closest to `p`.
pub fn closest<T: Scalar>(segments: &[Segment<T>], p: [T; 2]) -> Option<usize> {
    let points = segments.iter().map(|segment| segment.closest(p)).enumerate();
    let nearest =
        points.reduce(|best, next| if next.1.is_nearer_than(&best.1) { next } else { best })?;
    Some(nearest.0)
}

pub(super) fn minus<T: Scalar>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn dot<T: Scalar>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[0] + a[1] * b[1]
}
