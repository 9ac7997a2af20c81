//! The deformed mesh: how much its deformation is enlarged, and which edges bound it.

use super::view::Bounds;
use crate::numbers::Decimal;

/// The largest displacement as it is drawn, about, as a part of the picture's size.
const DRAWN_DISPLACEMENT: f64 = 0.035;

/// Returns how many times the deformation is enlarged: the largest displacement comes to about
/// 3.5 % of the picture's size.
pub fn magnification(points: &[[f64; 2]], displacement: &[[f64; 2]]) -> Decimal {
    let largest = largest_displacement(displacement);
    if largest == 0.0 {
        return Decimal::ONE;
    }
    let ratio = Bounds::around(points).larger_side() / largest * DRAWN_DISPLACEMENT;
    Decimal::nearest_round(ratio.clamp(1e-300, 1e300))
}

/// Returns the points, displaced so many times.
pub fn deformed(points: &[[f64; 2]], displacement: &[[f64; 2]], times: Decimal) -> Vec<[f64; 2]> {
    let times = times.value();
    let moved = points.iter().zip(displacement);
    moved.map(|(point, u)| [0, 1].map(|axis| point[axis] + times * u[axis])).collect()
}

/// Returns the length of the longest displacement.
pub fn largest_displacement(displacement: &[[f64; 2]]) -> f64 {
    displacement.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max)
}

/// Returns the edges that belong to one triangle only, rims of holes too, as indices of points.
pub fn boundary_edges(triangles: &[[usize; 3]]) -> Vec<[usize; 2]> {
    let ring = |&[a, b, c]: &[usize; 3]| [[a, b], [b, c], [c, a]];
    let mut edges: Vec<_> =
        triangles.iter().flat_map(ring).map(|[from, to]| [from.min(to), from.max(to)]).collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| same[0]).collect()
}
