//! Points along lines and arcs.

use std::f64::consts::FRAC_PI_2;

/// Point k of n equal parts from `a` to `b`; both ends exact.
pub fn part(a: f64, b: f64, k: usize, n: usize) -> f64 {
    if k == n { b } else { a + (b - a) * (k as f64 / n as f64) }
}

/// Cosine and sine at k of n equal parts of a right angle; both ends exact.
pub fn quarter(k: usize, n: usize) -> [f64; 2] {
    cos_sin(k as f64 / n as f64)
}

/// Cosine and sine at `s` from 0 to 1 of a right angle; both ends exact.
pub fn cos_sin(s: f64) -> [f64; 2] {
    if s == 1.0 { [0.0, 1.0] } else { [(FRAC_PI_2 * s).cos(), (FRAC_PI_2 * s).sin()] }
}

/// The point between `a` and `b` at `s` from 0 to 1; both ends exact.
pub fn between(a: [f64; 2], b: [f64; 2], s: f64) -> [f64; 2] {
    [0, 1].map(|k| a[k] * (1.0 - s) + b[k] * s)
}

/// Steps by which a curve's length is measured.
const STEPS: usize = 1000;

/// Points along a curve `at(s)`, s from 0 to 1, whose distances follow `size`, the target edge
/// length at a place; both ends exact. Each edge has the same integral of ds / size.
pub fn graded(at: impl Fn(f64) -> [f64; 2], size: impl Fn([f64; 2]) -> f64) -> Vec<[f64; 2]> {
    let mut edges = vec![0.0];
    for k in 0..STEPS {
        let [a, middle, b] = [0.0, 0.5, 1.0].map(|half| at((k as f64 + half) / STEPS as f64));
        edges.push(edges[k] + (b[0] - a[0]).hypot(b[1] - a[1]) / size(middle));
    }
    let n = edges[STEPS].round().max(1.0) as usize;
    let inner = (1..n).map(|i| {
        let wanted = edges[STEPS] * (i as f64 / n as f64);
        let k = edges.partition_point(|&e| e <= wanted);
        let rest = (wanted - edges[k - 1]) / (edges[k] - edges[k - 1]);
        at((k as f64 - 1.0 + rest) / STEPS as f64)
    });
    [at(0.0)].into_iter().chain(inner).chain([at(1.0)]).collect()
}
