//! What pairs join, directly or over others.

/// Returns, for each of `count` things, the lowest of those that `pairs` join it to, itself among them.
pub fn joined(count: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Vec<usize> {
    let mut lower: Vec<usize> = (0..count).collect();
    fn lowest(lower: &mut [usize], mut k: usize) -> usize {
        while lower[k] != k {
            lower[k] = lower[lower[k]];
            k = lower[k];
        }
        k
    }
    for (a, b) in pairs {
        let [a, b] = [a, b].map(|k| lowest(&mut lower, k));
        lower[a.max(b)] = a.min(b);
    }
    (0..count).map(|k| lowest(&mut lower, k)).collect()
}
