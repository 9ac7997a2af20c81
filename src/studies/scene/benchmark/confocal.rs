//! Half planes meshed along confocal ellipses: fine at a contact face, coarse far away, near
//! squares everywhere.
//!
//! ```text
//!   z = c cosh(xi + i eta)      |            xi = 0: the face, 0 <= x <= c, nodes closer towards c
//!                              .-+--.        eta = 0: the surface beyond it
//!   eta = pi/2: x = 0         /  |    \      eta = pi/2: the axis of symmetry
//!                            | .-+-.   \     cells are square, for the map is conformal
//!                            ||==+==|---|
//!                                0  c   c cosh xi
//! ```

use std::f64::consts::FRAC_PI_2;

use super::line::quarter;
use super::rows::Rows;
use problem::scene::MeshBuilder;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// The ellipse's number; 0 is the face.
    pub xi: f64,
    pub segments: usize,
}

/// The xi at which the segments are halved: the field is smooth there.
const HALVED_AT: [f64; 2] = [0.5, 1.25];

/// Rings of square cells from the face, with `segments`, to the ellipse `end`.
pub fn rings(segments: usize, end: f64) -> Vec<Ring> {
    let mut rings = vec![Ring { xi: 0.0, segments }];
    let mut last = rings[0];
    while last.xi < end {
        let step = FRAC_PI_2 / last.segments as f64;
        let halvings = HALVED_AT.iter().filter(|&&at| last.xi >= at).count();
        last = Ring { xi: last.xi + step, segments: segments.div_ceil(1 << halvings) };
        rings.push(last);
    }
    let stretch = end / last.xi;
    rings.iter().map(|ring| Ring { xi: ring.xi * stretch, ..*ring }).collect()
}

/// Adds the nodes of rings of focus `c`, length: a row for each ring, from the surface to the axis.
/// `map` places them from the upper half plane.
pub fn rows(
    mesh: &mut MeshBuilder,
    c: f64,
    rings: &[Ring],
    map: impl Fn([f64; 2]) -> [f64; 2],
) -> Rows {
    let row = |ring: &Ring| {
        let (a, b, n) = (c * ring.xi.cosh(), c * ring.xi.sinh(), ring.segments);
        let points = (0..=n).map(|k| {
            let [cos, sin] = quarter(k, n);
            map([a * cos, b * sin])
        });
        mesh.row(points)
    };
    Rows(rings.iter().map(row).collect())
}

/// The nodes of the surface from the axis outwards: the face, then the first node of each further
/// ring as far as x = `end`, length.
pub fn surface(mesh: &MeshBuilder, rows: &Rows, end: f64) -> Vec<usize> {
    let beyond = rows.starts().into_iter().skip(1).take_while(|&n| mesh.xy(n)[0] <= end);
    rows.first().iter().rev().copied().chain(beyond).collect()
}
