//! The Pareto front: what nothing else beats in both time and error.

/// Whether each point of (time, error) is on the front: no other is better in one and at least as
/// good in the other.
pub fn pareto(points: &[[f64; 2]]) -> Vec<bool> {
    let beats =
        |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[0] && a[1] <= b[1] && (a[0] < b[0] || a[1] < b[1]);
    points.iter().map(|b| !points.iter().any(|a| beats(a, b))).collect()
}
