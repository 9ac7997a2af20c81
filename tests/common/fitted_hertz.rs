//! Half width and peak of Hertz's contact: those of the best p² = p0² (1 − (s/a)²) through the
//! pressures, for a node resolves either to an edge length only.
//!
//! The node on the axis is left out: the triangles that meet there stand for half of a symmetric
//! patch whose diagonals do not mirror. So is the last tenth: the contact ends between two nodes,
//! and the last one or two share what lies between.

use std::f64::consts::PI;

use super::recovery::solved_by;
use plane_contact::engine::Solution;
use plane_contact::problem::modelling::ContactModel;
use plane_contact::studies::benchmark::Hertz;

/// The part of the half width whose pressures are fitted.
const INNER: f64 = 0.9;

/// Half width and peak by least squares of p² over s².
fn fitted(solution: &Solution) -> [f64; 2] {
    let edge = solution.in_contact().map(|c| c.arc).fold(0.0, f64::max);
    let pressing = solution.contact.iter().filter(|c| 0.0 < c.arc && c.arc < INNER * edge);
    let points: Vec<[f64; 2]> =
        pressing.map(|c| [c.arc.powi(2), c.pressure.unwrap().powi(2)]).collect();
    let count = points.len() as f64;
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let above: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    let below: f64 = points.iter().map(|p| (p[0] - x).powi(2)).sum();
    let slope = above / below;
    let square = y - slope * x;
    [(-square / slope).sqrt(), square.sqrt()]
}

/// Peak pressure by the closed form, stress.
pub fn peak_pressure(hertz: &Hertz) -> f64 {
    2.0 * hertz.load / (PI * hertz.half_width())
}

/// Half width and peak over Hertz's at `load`, N/mm.
pub fn over_hertz(size: usize, load: f64, change: impl Fn(&mut ContactModel)) -> [f64; 2] {
    let hertz = Hertz { size, load, ..Hertz::default() };
    let [half_width, peak] = fitted(&solved_by(hertz.generate().expect("in range"), change));
    [half_width / hertz.half_width(), peak / peak_pressure(&hertz)]
}
