//! SOURCE: G. Kirsch, 1898; S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 35.
//!
//! GOAL: a circular hole in an infinite sheet under unit tension in x: sigma_x = 3 at (0, 1),
//! sigma_y = -1 at (1, 0).
//!
//! MESH: a quarter from the hole of radius 1 to radius 5, n cells around, near square, each cut
//! into two triangles; n = 16, 32, 64.
//!
//! BOUNDARY CONDITIONS: the closed form's traction at the middle of each outer edge, the axes held
//! across themselves. E = 1000, nu = 0.3, plane stress.
//!
//! Stresses: extrapolated (`common::recovery`).

use crate::common::recovery::{extrapolated, node_at, solved};
use crate::common::tolerances::{KIRSCH, assert_near};
use plane_contact::studies::benchmark::Hole;

/// sigma_x at (0, 1) and sigma_y at (1, 0).
fn at_the_hole(around: usize, outer: f64) -> [f64; 2] {
    let solution = solved(Hole { around, outer }.generate());
    let [top, side] = [[0.0, 1.0], [1.0, 0.0]].map(|place| node_at(&solution.model, place));
    [extrapolated(&solution, top)[0], extrapolated(&solution, side)[1]]
}

#[test]
fn the_hole_concentrates_stress_three_times() {
    let [top, side] = at_the_hole(64, 5.0);
    assert_near("sigma_x at the top", top, 3.0, 3.0, &KIRSCH);
    assert_near("sigma_y at the side", side, -1.0, 1.0, &KIRSCH);
}

#[test]
fn the_error_shrinks_with_the_mesh() {
    let [coarse, middle, fine] = [16, 32, 64].map(|n| at_the_hole(n, 5.0));
    for (k, exact) in [3.0, -1.0].into_iter().enumerate() {
        let [coarse, middle, fine] = [coarse, middle, fine].map(|s| (s[k] - exact).abs());
        assert!(middle < coarse / 2.0 && fine < middle / 2.0, "{coarse} {middle} {fine}");
    }
}

#[test]
fn the_radius_at_which_the_sheet_is_cut_does_not_matter() {
    let [near, far] = [3.0, 20.0].map(|outer| at_the_hole(64, outer));
    assert_near("sigma_x at the top", near[0], far[0], 3.0, &KIRSCH);
    assert_near("sigma_y at the side", near[1], far[1], 1.0, &KIRSCH);
}

#[test]
fn the_closed_form_has_its_known_values_at_the_hole_and_far_away() {
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-8);
    assert!(near(Hole::stress([0.0, 1.0]), [3.0, 0.0, 0.0]));
    assert!(near(Hole::stress([1.0, 0.0]), [0.0, -1.0, 0.0]));
    assert!(near(Hole::stress([3e5, 4e5]), [1.0, 0.0, 0.0]));
}
