//! Mapped grids, of which benchmarks without contact are made.

use plane_contact::problem::scene::MeshBuilder;

/// Adds `columns` x `rows` cells to a mesh, their triangles to the group `body`; `at(s, t)` places a node,
/// s and t from 0 to 1. Returns the rows of nodes.
pub fn grid(
    mesh: &mut MeshBuilder,
    body: &str,
    [columns, rows]: [usize; 2],
    at: impl Fn(f64, f64) -> [f64; 2],
) -> Vec<Vec<usize>> {
    let part = |k: usize, n: usize| k as f64 / n as f64;
    let row = |j: usize| (0..=columns).map(|i| at(part(i, columns), part(j, rows))).collect();
    let places: Vec<Vec<[f64; 2]>> = (0..=rows).map(row).collect();
    let nodes: Vec<Vec<usize>> = places.into_iter().map(|row| mesh.row(row)).collect();
    mesh.join_all(body, &nodes);
    nodes
}

/// The first node of each row, and the last one.
pub fn ends(rows: &[Vec<usize>]) -> [Vec<usize>; 2] {
    [0, rows[0].len() - 1].map(|k| rows.iter().map(|row| row[k]).collect())
}

/// Cosine and sine at `s` from 0 to 1 of a right angle; both ends exact.
pub fn quarter(s: f64) -> [f64; 2] {
    let (sin, cos) = (std::f64::consts::FRAC_PI_2 * s).sin_cos();
    if s == 1.0 { [0.0, 1.0] } else { [cos, sin] }
}

/// The point between `a` and `b` at `s` from 0 to 1; both ends exact.
pub fn between(a: [f64; 2], b: [f64; 2], s: f64) -> [f64; 2] {
    [0, 1].map(|k| a[k] * (1.0 - s) + b[k] * s)
}
