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

use std::f64::consts::FRAC_PI_2;

use crate::common::recovery::{extrapolated, node_at, solved};
use crate::common::tolerances::{KIRSCH, assert_near};
use crate::grid::{ends, grid, quarter};
use plane_contact::problem::element::Plane;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{Axis, MeshBuilder, SceneBuilder};

/// A quarter of the sheet, cut at the radius `outer`, near square cells, `around` of them on the hole.
pub fn sheet(around: usize, outer: f64) -> SceneBuilder {
    let radial = (outer.ln() * around as f64 / FRAC_PI_2).ceil() as usize;
    let mut mesh = MeshBuilder::default();
    let rows = grid(&mut mesh, "sheet", [around, radial], |s, t| {
        quarter(s).map(|x| x * if t == 1.0 { outer } else { outer.powf(t) })
    });
    let [x_axis, y_axis] = ends(&rows);
    mesh.edges("x_axis", &x_axis);
    mesh.edges("y_axis", &y_axis);
    let mut tractions = Vec::new();
    for (k, edge) in rows[radial].windows(2).enumerate() {
        let (group, [a, b]) = (format!("outer_{k}"), [0, 1].map(|i| mesh.xy(edge[i])));
        mesh.edges(group.as_str(), edge);
        tractions.push((group, traction(a, b)));
    }
    let scene = SceneBuilder::new("kirsch", mesh.finish(), Plane::Stress)
        .variant(Variant::Stepped)
        .material("sheet", 1000.0, 0.3)
        .restrain("x_axis", &[Axis::Y])
        .restrain("y_axis", &[Axis::X]);
    tractions.into_iter().fold(scene, |scene, (group, t)| scene.traction(group, t))
}

/// sigma_x, sigma_y, tau_xy of the closed form.
pub fn stress([x, y]: [f64; 2]) -> [f64; 3] {
    let (a2, angle) = (1.0 / (x * x + y * y), y.atan2(x));
    let a4 = 1.5 * a2 * a2;
    let ((s2, c2), (s4, c4)) = ((2.0 * angle).sin_cos(), (4.0 * angle).sin_cos());
    [
        1.0 - a2 * (1.5 * c2 + c4) + a4 * c4,
        -a2 * (0.5 * c2 - c4) - a4 * c4,
        -a2 * (0.5 * s2 + s4) + a4 * s4,
    ]
}

/// Traction of the closed form at the middle of the edge from `a` to `b`, which runs
/// counter-clockwise around the hole.
fn traction(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    let normal = [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
    let [xx, yy, xy] = stress([(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]);
    [xx * normal[0] + xy * normal[1], xy * normal[0] + yy * normal[1]]
}

/// sigma_x at (0, 1) and sigma_y at (1, 0).
fn at_the_hole(around: usize, outer: f64) -> [f64; 2] {
    let solution = solved(sheet(around, outer));
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
    assert!(near(stress([0.0, 1.0]), [3.0, 0.0, 0.0]));
    assert!(near(stress([1.0, 0.0]), [0.0, -1.0, 0.0]));
    assert!(near(stress([3e5, 4e5]), [1.0, 0.0, 0.0]));
}
