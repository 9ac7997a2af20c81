//! The CST against what is known of it in closed form.
#![allow(non_snake_case, reason = "the paper's own names")]

use nalgebra::{Matrix3, SVector, Vector3};
use problem::element::Plane;
use problem::element::{
    B, Corners, D, State, area, gradients, out_of_plane_strain, out_of_plane_stress, stiffness,
    von_mises_strain_by_stress_formula,
};
use proptest::prelude::*;
use testing::random::fixed;
use testing::tolerances::{ELEMENT, assert_near};

testing::tolerances! {
    /// Strain of a rigid motion, relative to its largest term |B| |u|.
    RIGID = 1e-13, "a sum of six rounded products that cancel";
    /// A patch of triangles under constant strain, relative to the strain.
    PATCH = 1e-13, "a dozen roundings of 1e-16 each; the issue's own number";
}

/// Triangles in a box of size 10, counter-clockwise, not thinner than 1 in 100.
fn triangle() -> impl Strategy<Value = Corners<f64>> {
    let point = || prop::array::uniform2(-5.0..5.0);
    prop::array::uniform3(point()).prop_filter_map("a fair triangle", |p: Corners<f64>| {
        let p = if area(&p) < 0.0 { [p[0], p[2], p[1]] } else { p };
        (area(&p) > 0.05).then_some(p)
    })
}

/// Displacements u = a + G x at the three corners.
fn linear(p: &Corners<f64>, a: [f64; 2], g: [[f64; 2]; 2]) -> SVector<f64, 6> {
    SVector::from_fn(|k, _| {
        let ([x, y], row) = (p[k / 2], g[k % 2]);
        a[k % 2] + row[0] * x + row[1] * y
    })
}

proptest! {
    #![proptest_config(fixed(256))]

    /// Closed form: K of a triangle by its edge vectors, t/(4A) · (...), written out for one entry
    /// of each kind.
    #[test]
    fn stiffness_has_its_closed_form(p in triangle(), E in 1.0..1e6, nu in 0.0..0.45) {
        let d = D(Plane::Stress, E, nu);
        let k = B(&p).transpose() * d * B(&p) * area(&p);
        let b = |i: usize| p[(i + 1) % 3][1] - p[(i + 2) % 3][1];
        let c = |i: usize| p[(i + 2) % 3][0] - p[(i + 1) % 3][0];
        let factor = E / (1.0 - nu * nu) / (4.0 * area(&p));
        let shear = (1.0 - nu) / 2.0;
        let scale = k.amax();
        for (i, j) in [(0, 0), (0, 1), (1, 2), (2, 2)] {
            let xx = factor * (b(i) * b(j) + shear * c(i) * c(j));
            let xy = factor * (nu * b(i) * c(j) + shear * c(i) * b(j));
            let yy = factor * (c(i) * c(j) + shear * b(i) * b(j));
            assert_near("K xx", k[(2 * i, 2 * j)], xx, scale, &ELEMENT);
            assert_near("K xy", k[(2 * i, 2 * j + 1)], xy, scale, &ELEMENT);
            assert_near("K yy", k[(2 * i + 1, 2 * j + 1)], yy, scale, &ELEMENT);
        }
    }

    #[test]
    fn rigid_motion_gives_no_strain(
        p in triangle(),
        a in prop::array::uniform2(-1.0..1.0),
        turn in -1.0..1.0f64,
    ) {
        let u = linear(&p, a, [[0.0, -turn], [turn, 0.0]]);
        let strain = B(&p) * u;
        let scale = B(&p).abs() * u.abs();
        for k in 0..3 {
            assert_near("strain", strain[k], 0.0, scale.amax(), &RIGID);
        }
    }

    #[test]
    fn linear_displacements_give_their_constant_strain(
        p in triangle(), g in prop::array::uniform2(prop::array::uniform2(-1e-3..1e-3f64)),
    ) {
        let strain = B(&p) * linear(&p, [0.0; 2], g);
        let exact = [g[0][0], g[1][1], g[0][1] + g[1][0]];
        for k in 0..3 {
            let scale = 1e-3 * B(&p).amax().max(1.0) * 10.0;
            assert_near("strain", strain[k], exact[k], scale, &ELEMENT);
        }
    }
}

/// Four triangles about a node off the centre of a square.
#[test]
fn a_patch_under_constant_strain_is_exact() {
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    let (middle, g) = ([0.7, 1.2], [[1e-3, 2e-4], [-3e-4, -5e-4]]);
    for k in 0..4 {
        let p = [corners[k], corners[(k + 1) % 4], middle];
        let strain = B(&p) * linear(&p, [0.01, -0.02], g);
        for (value, exact) in strain.iter().zip([1e-3, -5e-4, -1e-4]) {
            assert_near("strain", *value, exact, 2e-2, &PATCH);
        }
    }
}

/// Hooke's law in three dimensions, inverted, is the oracle for both plane problems.
#[test]
fn elasticity_matrices_follow_from_hookes_law() {
    let (E, nu) = (30000.0, 0.2);
    let compliance = Matrix3::new(1.0, -nu, -nu, -nu, 1.0, -nu, -nu, -nu, 1.0) / E;
    let stiffness = compliance.try_inverse().expect("nu < 0.5");
    let (strain, stress) = (D(Plane::Strain, E, nu), D(Plane::Stress, E, nu));
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        assert_near("plane strain", strain[(i, j)], stiffness[(i, j)], E, &ELEMENT);
        // Plane stress: the third strain condensed out.
        let condensed =
            stiffness[(i, j)] - stiffness[(i, 2)] * stiffness[(2, j)] / stiffness[(2, 2)];
        assert_near("plane stress", stress[(i, j)], condensed, E, &ELEMENT);
    }
    for d in [strain, stress] {
        assert_near("shear", d[(2, 2)], E / (2.0 * (1.0 + nu)), E, &ELEMENT);
    }
}

/// Uniaxial stress s in plane stress: von Mises stress s, von Mises strain 2/3 (1 + nu) s / E.
#[test]
fn von_mises_values_of_uniaxial_stress() {
    let (E, nu, s) = (1000.0, 0.3, 5.0);
    let p = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let u = linear(&p, [0.0; 2], [[s / E, 0.0], [0.0, -nu * s / E]]);
    let state = State::new(Plane::Stress, E, nu, &B(&p), &u);
    assert_near("sigma_x", state.sigma[0], s, s, &ELEMENT);
    assert_near("sigma_y", state.sigma[1], 0.0, s, &ELEMENT);
    assert_near("von Mises stress", state.von_mises_stress, s, s, &ELEMENT);
    let strain = 2.0 / 3.0 * (1.0 + nu) * s / E;
    assert_near("von Mises strain", state.von_mises_strain, strain, strain, &ELEMENT);
}

/// In numbers that `f64` holds: twice the area of the triangle is 8.
#[test]
fn a_triangle_in_whole_numbers() {
    let p = [[1.0, 2.0], [3.0, 2.0], [1.0, 6.0]];
    assert_eq!(area(&p), 4.0);
    assert_eq!(area(&[p[0], p[2], p[1]]), -4.0, "clockwise");
    assert_eq!(gradients(&p), [[-0.5, -0.25], [0.5, 0.0], [0.0, 0.25]]);
    let turned = p.map(|[x, y]| [y, -x]);
    assert_eq!(gradients(&turned), gradients(&p).map(|[x, y]| [y, -x]), "by a right angle");
    // nu = 1/4 in plane strain: E / ((1 + nu) (1 − 2 nu)) = 10 · 1.6 = 16.
    let d = D(Plane::Strain, 10.0, 0.25);
    assert_eq!(d, Matrix3::new(12.0, 4.0, 0.0, 4.0, 12.0, 0.0, 0.0, 0.0, 4.0));
    // nu = 1/2 in plane stress: E / (1 − nu²) = 12 / 0.75 = 16.
    let d = D(Plane::Stress, 12.0, 0.5);
    assert_eq!(d, Matrix3::new(16.0, 8.0, 0.0, 8.0, 16.0, 0.0, 0.0, 0.0, 4.0));
    assert_eq!(stiffness(&B(&p), &d), B(&p).transpose() * d * B(&p));
}

#[test]
fn poisson_ratios_up_to_the_bounds_of_each_plane_problem() {
    use Plane::{Strain, Stress};
    let sound = [
        (Strain, (-1.0_f64).next_up()),
        (Strain, 0.0),
        (Strain, 0.5_f64.next_down()),
        (Stress, (-1.0_f64).next_up()),
        (Stress, 0.5),
        (Stress, 1.0_f64.next_down()),
    ];
    for (plane, nu) in sound {
        assert!(plane.check_poisson(nu, "here").is_ok(), "{plane:?} {nu}");
    }
    for (plane, nu) in [(Strain, -1.0), (Strain, 0.5), (Strain, 0.7), (Stress, -1.5), (Stress, 1.0)]
    {
        let error = plane.check_poisson(nu, "here").expect_err("outside");
        assert_eq!(error.place, "here", "{plane:?} {nu}");
    }
    for plane in Plane::ALL {
        assert!(plane.check_poisson(f64::NAN, "here").is_err(), "{plane:?}");
    }
}

/// What lies across the plane, where nu is 1/4: a quarter of the sum of two stresses, and a third
/// of the sum of two strains, negative.
#[test]
fn what_lies_across_the_plane() {
    let two = Vector3::new(2.0, 4.0, 7.0);
    assert_eq!(out_of_plane_stress(Plane::Strain, 0.25, &two), 1.5);
    assert_eq!(out_of_plane_stress(Plane::Stress, 0.25, &two), 0.0);
    assert_eq!(out_of_plane_strain(Plane::Strain, 0.25, &two), 0.0);
    assert_near("strain", out_of_plane_strain(Plane::Stress, 0.25, &two), -2.0, 2.0, &ELEMENT);
}

/// Von Mises values in closed form: of equal strains e along x and y in plane strain the stress is
/// E e / (1 + nu) and the strain 2/3 e; of a shear g they are √3 G g and g / √3.
#[test]
fn von_mises_values_of_simple_strains() {
    let (E, nu, e) = (1000.0, 0.25, 1e-3);
    let p = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let state = |plane, g| State::new(plane, E, nu, &B(&p), &linear(&p, [0.3, -0.2], g));
    let equal = state(Plane::Strain, [[e, 0.0], [0.0, e]]);
    let stress = E * e / (1.0 + nu);
    assert_near("stress", equal.von_mises_stress, stress, stress, &ELEMENT);
    assert_near("strain", equal.von_mises_strain, 2.0 / 3.0 * e, e, &ELEMENT);
    for plane in [Plane::Strain, Plane::Stress] {
        let shear = state(plane, [[0.0, e], [0.0, 0.0]]);
        let stress = 3.0_f64.sqrt() * E / (2.0 * (1.0 + nu)) * e;
        assert_near("shear stress", shear.von_mises_stress, stress, stress, &ELEMENT);
        assert_near("shear strain", shear.von_mises_strain, e / 3.0_f64.sqrt(), e, &ELEMENT);
        let still = state(plane, [[0.0; 2]; 2]);
        assert_eq!([still.von_mises_stress, still.von_mises_strain], [0.0; 2]);
    }
}

/// By the formula of the stress, the von Mises strain of a bar that is pulled by e is e itself,
/// that of a block which only strains along x is e / (1 + nu), and that of a shear g is
/// √3/2 g / (1 + nu).
#[test]
fn von_mises_strains_by_the_formula_of_the_stress() {
    let (nu, e) = (0.25, 1e-3);
    let of = |plane, x: [f64; 3]| von_mises_strain_by_stress_formula(plane, nu, &x.into());
    assert_near("bar", of(Plane::Stress, [e, -nu * e, 0.0]), e, e, &ELEMENT);
    assert_near("block", of(Plane::Strain, [e, 0.0, 0.0]), e / (1.0 + nu), e, &ELEMENT);
    let shear = 0.75_f64.sqrt() * e / (1.0 + nu);
    assert_near("shear", of(Plane::Stress, [0.0, 0.0, e]), shear, shear, &ELEMENT);
    assert_eq!(of(Plane::Strain, [0.0; 3]), 0.0);
}
