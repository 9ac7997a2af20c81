//! SOURCE: A. Persson, On the stress distribution of cylindrical elastic bodies in contact, 1964; M. Ciavarella
//! and P. Decuzzi, The state of stress induced by the plane frictionless cylindrical contact, 2001; K. L.
//! Johnson, Contact Mechanics, section 4.2.
//!
//! GOAL: the pressure of a disc in a hole solves the integral equation of both bodies.
//!
//! MESH: none.
//!
//! BOUNDARY CONDITIONS: a disc of radius r, loaded at its centre, in a hole of an unbounded plane, frictionless.
//!
//! The equation, derived anew: pressure p = Σ p_n cos nφ moves the disc's boundary (Michell, n ≥ 2) by
//! −r p_n/4μ (1/(n − 1) + κ/(n + 1)) and the hole's by r p_n/4μ (1/(n + 1) + κ/(n − 1)), n = 0 by
//! −r p_0 (κ − 1)/4μ and r p_0/2μ, and n = 1 by what a rigid motion is too. Where they touch, the hole's less
//! the disc's is −ΔR + C cos φ. Applying 1 + d²/dφ² leaves, without Dundurs' β and with c = (κ + 1)/8μ,
//!
//! ```text
//!   Σ n p_n cos nφ = ΔR E*/2r + c2 E* p_0 + p_1 cos φ,      p_1 = P/(π r)
//!   Σ n p_n cos nφ = 1/4π ∫ (2 p(φ) − p(φ + s) − p(φ − s)) / sin²(s/2) ds   over 0 < s < π
//! ```

use std::f64::consts::PI;

use crate::common::conforming::Conforming;
use crate::common::tolerances::{HERTZ_PRINTED, assert_near};

testing::tolerances! {
    /// Persson's half width and peak over Hertz's where the arc is small, relative.
    SMALL_ARC = 1e-3, "an arc of 0.01 radians: they part by its square";
    /// Persson's pressure in the integral equation that it solves, relative to the equation's right side.
    INTEGRAL_EQUATION = 1e-4, "20,000 points of the midpoint rule, next to roots: measured 3e-5";
}

#[test]
fn persson_solves_the_integral_equation() {
    const POINTS: usize = 20_000;
    let step = PI / POINTS as f64;
    let integral = |f: &dyn Fn(f64) -> f64| -> f64 {
        (0..POINTS).map(|k| f((k as f64 + 0.5) * step) * step).sum()
    };
    let circles = Conforming { radii: [1.0; 2], compliances: [0.3, 0.7], load: 1.0 };
    for half_angle in [0.1, 0.6, 1.2] {
        let pressure = |angle: f64| match angle.abs() < half_angle {
            true => circles.pressure(half_angle, angle),
            false => 0.0,
        };
        let mean = integral(&pressure) / PI;
        let first = integral(&|s| pressure(s) * s.cos()) * 2.0 / PI;
        assert_near("load", PI * first, 1.0, 1.0, &INTEGRAL_EQUATION);
        let constant = circles.relative_clearance(half_angle) / 2.0 + 0.7 * mean;
        for angle in [0.0, 0.3 * half_angle, 0.6 * half_angle] {
            let difference = |s| 2.0 * pressure(angle) - pressure(angle + s) - pressure(angle - s);
            let left = integral(&|s| difference(s) / (s / 2.0).sin().powi(2)) / (4.0 * PI);
            let right = constant + first * angle.cos();
            assert_near("equation", left, right, right, &INTEGRAL_EQUATION);
        }
    }
}

#[test]
fn a_small_arc_is_hertz() {
    let circles = Conforming { radii: [1.0, 1.001], compliances: [0.3, 0.7], load: 7.85e-8 };
    let (hertz, persson) = (circles.hertz().expect("a clearance"), circles.persson());
    let (half_width, peak) = (hertz.half_width, hertz.peak_pressure);
    assert_near("half width", persson.half_width, half_width, half_width, &SMALL_ARC);
    assert_near("peak", persson.peak_pressure, peak, peak, &SMALL_ARC);
}

/// The strand's, as computed by hand.
#[test]
fn hertz_is_as_computed_by_hand() {
    let compliances = [0.91 / 210_000.0, 0.96 / 30_000.0];
    let strand = Conforming { radii: [7.6, 7.7], compliances, load: 6.3 * 15.2 };
    let hertz = strand.hertz().expect("a clearance");
    assert_near("half width", hertz.half_width, 1.61010, 1.61010, &HERTZ_PRINTED);
    assert_near("peak", hertz.peak_pressure, 37.8628, 37.8628, &HERTZ_PRINTED);
    assert_eq!(Conforming { radii: [7.6, 7.6], ..strand }.hertz(), None);
}
