//! The order of convergence, from meshes each of half the element size of the one before, the true
//! answer being unknown.
//!
//! Where the error is C·h^p, differences between neighbours d_l = |q_l − q_(l+1)| fall by 2^p from
//! mesh to mesh, whatever the truth: p is the slope of a line fitted to log2 d_l. Continued beyond
//! the finest mesh they add up to the distance from the limit, by their powers k:
//!
//! ```text
//!  e_l^k = d_l^k + d_(l+1)^k + ... + e_finest^k,     e_finest = d_last / (2^(k·p) − 1)^(1/k)
//! ```
//!
//! k = 1 for a number that approaches its limit from one side. k = 2 for the energy norm of
//! displacements on nested meshes under one load: u_(l+1) − u_l is orthogonal to all that mesh l
//! can do, so that squares add, as Pythagoras has it. Contact makes this approximate, because the
//! bodies' surfaces meet otherwise on each mesh.

use serde::Serialize;

/// An order of convergence and its fit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Order {
    /// The quantity whose error it is.
    pub quantity: &'static str,
    /// Differences between neighbouring meshes, over the finest one's value, the coarsest first.
    pub differences: Vec<f64>,
    /// p; nothing where differences do not fall, or are fewer than two.
    pub order: Option<f64>,
    /// How far the farthest difference lies from the fitted line, as a factor; nothing of two,
    /// which a line always passes through.
    pub scatter: Option<f64>,
    /// Estimated relative error of each mesh, the coarsest first; nothing without an order.
    pub errors: Option<Vec<f64>>,
}

impl Order {
    /// Fits p to `differences` of the quantity between neighbouring meshes, whose powers `k` add.
    pub fn fit(quantity: &'static str, differences: Vec<f64>, k: i32) -> Self {
        let falling = differences.len() > 1
            && differences.windows(2).all(|d| d[1] < d[0])
            && differences.iter().all(|d| *d > 0.0);
        if !falling {
            return Order { quantity, differences, order: None, scatter: None, errors: None };
        }
        let logs: Vec<f64> = differences.iter().map(|d| d.log2()).collect();
        let (slope, start) = line(&logs);
        let apart = logs.iter().enumerate().map(|(l, y)| (y - start - slope * l as f64).abs());
        let scatter = (logs.len() > 2).then(|| apart.fold(0.0, f64::max).exp2());
        let root = |x: f64| x.powf(1.0 / f64::from(k));
        let last = differences[differences.len() - 1];
        let mut errors = vec![last / root((f64::from(k) * -slope).exp2() - 1.0)];
        for d in differences.iter().rev() {
            errors.push(root(errors[errors.len() - 1].powi(k) + d.powi(k)));
        }
        errors.reverse();
        Order { quantity, differences, order: Some(-slope), scatter, errors: Some(errors) }
    }
}

/// Slope and start of the line through (0, y_0), (1, y_1), ..., by least squares.
fn line(y: &[f64]) -> (f64, f64) {
    let n = y.len() as f64;
    let (mean_x, mean_y) = ((n - 1.0) / 2.0, y.iter().sum::<f64>() / n);
    let along = |l: usize| l as f64 - mean_x;
    let top: f64 = y.iter().enumerate().map(|(l, y)| along(l) * (y - mean_y)).sum();
    let bottom: f64 = (0..y.len()).map(|l| along(l).powi(2)).sum();
    let slope = top / bottom;
    (slope, mean_y - slope * mean_x)
}
