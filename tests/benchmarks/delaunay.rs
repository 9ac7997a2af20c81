//! Delaunay triangulations of polygons.

use plane_contact::studies::benchmark::delaunay::{contains, triangulate};

/// An L: the unit square's double, without its upper right quarter.
const L: [[f64; 2]; 6] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];

#[test]
fn a_point_is_inside_a_polygon_or_not() {
    let points = [[0.5, 0.5], [0.5, 1.5], [1.5, 1.5], [-1.0, 0.5], [0.5, 3.0]];
    assert_eq!(points.map(|p| contains(&L, p)), [true, true, false, false, false]);
}

#[test]
fn the_sides_are_kept_and_the_area_is_filled() {
    let patch = triangulate(&L, |_| 0.3);
    assert_eq!(patch.nodes[..6], L);
    assert!(patch.nodes[6..].iter().all(|&p| contains(&L, p)));
    let areas = patch.triangles.iter().map(|t| {
        let [a, b, c] = t.map(|node| patch.nodes[node]);
        ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2.0
    });
    let areas: Vec<f64> = areas.collect();
    assert!(areas.iter().all(|&area| area > 0.0), "counter-clockwise");
    assert!((areas.iter().sum::<f64>() - 3.0).abs() < 1e-14);
}

#[test]
fn smaller_triangles_where_a_smaller_size_is_asked_for() {
    let quarter = |k: usize, part: usize| {
        let ([ax, ay], [bx, by], t) = (L[k], L[(k + 1) % 6], part as f64 / 8.0);
        [ax + t * (bx - ax), ay + t * (by - ay)]
    };
    let sides: Vec<[f64; 2]> =
        (0..6).flat_map(|k| (0..8).map(move |part| quarter(k, part))).collect();
    let count = |size: f64| triangulate(&sides, |_| size).triangles.len();
    assert!(count(0.3) < count(0.15), "{} {}", count(0.3), count(0.15));
}
