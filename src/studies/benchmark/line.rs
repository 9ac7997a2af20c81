//! Points along lines and arcs.

use std::f64::consts::FRAC_PI_2;

/// Point k of n equal parts from `a` to `b`; both ends exact.
pub fn part(a: f64, b: f64, k: usize, n: usize) -> f64 {
    if k == n { b } else { a + (b - a) * (k as f64 / n as f64) }
}

/// Cosine and sine at k of n equal parts of a right angle; both ends exact.
pub fn quarter(k: usize, n: usize) -> [f64; 2] {
    if k == 0 {
        return [1.0, 0.0];
    }
    if k == n {
        return [0.0, 1.0];
    }
    let angle = FRAC_PI_2 * (k as f64 / n as f64);
    [angle.cos(), angle.sin()]
}

/// The point between `a` and `b` at `s` from 0 to 1; both ends exact.
pub fn between(a: [f64; 2], b: [f64; 2], s: f64) -> [f64; 2] {
    [0, 1].map(|k| a[k] * (1.0 - s) + b[k] * s)
}

/// k of n steps of a quantity that grows by the same factor from `a` to `b`; both ends exact.
pub fn geometric(a: f64, b: f64, k: usize, n: usize) -> f64 {
    match k {
        0 => a,
        _ if k == n => b,
        _ => a * (b / a).powf(k as f64 / n as f64),
    }
}
