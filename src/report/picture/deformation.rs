//! The deformed mesh: how much its deformation is enlarged, and which edges bound it.

use std::collections::BTreeMap;

use super::view::Bounds;
use crate::report::numbers::Decimal;

/// The largest displacement as it is drawn, about, as a part of the picture's size.
const DRAWN_DISPLACEMENT: f64 = 0.035;

/// Returns how many times the deformation is enlarged: the largest displacement comes to about
/// 3.5 % of the picture's size.
pub fn magnification(points: &[[f64; 2]], displacement: &[[f64; 2]]) -> Decimal {
    let largest = largest_displacement(displacement);
    if largest == 0.0 {
        return Decimal::ONE;
    }
    let ratio = Bounds::of(points).larger_side() / largest * DRAWN_DISPLACEMENT;
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
    let mut owners = BTreeMap::new();
    for &[a, b, c] in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *owners.entry([from.min(to), from.max(to)]).or_insert(0) += 1;
        }
    }
    owners.into_iter().filter(|&(_, count)| count == 1).map(|(edge, _)| edge).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];

    /// Nine squares without the one in the middle, two triangles each.
    ///
    /// ```text
    /// 12--13--14--15
    ///  |   |   |   |
    ///  8---9--10--11
    ///  |   | O |   |
    ///  4---5---6---7
    ///  |   |   |   |
    ///  0---1---2---3
    /// ```
    #[test]
    fn rim_of_a_hole_is_boundary() {
        let corners = (0..11).filter(|corner| corner % 4 != 3 && *corner != 5);
        let triangles: Vec<_> =
            corners.flat_map(|a| [[a, a + 1, a + 5], [a, a + 5, a + 4]]).collect();
        let edges = boundary_edges(&triangles);
        assert_eq!(edges.len(), 12 + 4);
        let rim = [[5, 6], [5, 9], [6, 10], [9, 10]];
        assert!(rim.iter().all(|edge| edges.contains(edge)), "{edges:?}");
    }

    #[test]
    fn magnification_is_round() {
        let scaled = [0.0, 0.0035, 0.003, 0.35, 7.0, 1e-299]
            .map(|largest| magnification(&SQUARE, &[[0.0, 0.0], [0.0, -largest]]).value());
        assert_eq!(scaled, [1.0, 100.0, 100.0, 1.0, 0.05, 5e298]);
    }

    #[test]
    fn drawn_displacement_is_a_few_per_cent() {
        for thousandths in 1..1000 {
            let displacement = [[f64::from(thousandths) / 1000.0, 0.0]];
            let drawn = displacement[0][0] * magnification(&SQUARE, &displacement).value() / 10.0;
            assert!((0.02..0.06).contains(&drawn), "{drawn}");
        }
    }
}
