//! A plate whose solution is known: a thick-walled cylinder (Lamé).

use std::f64::consts::FRAC_PI_2;

use problem::element::Plane;
use problem::modelling::Variant;
use problem::scene::{Axis, MeshBuilder, SceneBuilder};

/// A quarter of a thick-walled cylinder under internal pressure, of `radial` divisions through the wall and
/// `around` the quarter.
///
/// Radii 10 and 20 mm, 10 MPa inside, E = 30000 MPa, nu = 0.2, plane strain. At the bore: u =
/// 0.00613333 mm, hoop stress 16.6667 MPa.
///
/// Source: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 28.
pub fn annulus(radial: usize, around: usize) -> SceneBuilder {
    let mut mesh = MeshBuilder::default();
    let at = |i: usize, radius: f64| {
        let angle = FRAC_PI_2 * (i as f64 / around as f64);
        if i == around { [0.0, radius] } else { [radius * angle.cos(), radius * angle.sin()] }
    };
    let radius = |j: usize| 10.0 + 10.0 * (j as f64 / radial as f64);
    let row = |j: usize| (0..=around).map(move |i| at(i, radius(j))).collect::<Vec<_>>();
    let rows: Vec<Vec<usize>> = (0..=radial).map(|j| mesh.row(row(j))).collect();
    mesh.join_all("wall", &rows);
    mesh.edges("inner", &rows[0]);
    mesh.edges("outer", &rows[radial]);
    mesh.edges("x_axis", &rows.iter().map(|row| row[0]).collect::<Vec<_>>());
    mesh.edges("y_axis", &rows.iter().map(|row| row[around]).collect::<Vec<_>>());
    SceneBuilder::new("annulus", mesh.finish(), Plane::Strain)
        .variant(Variant::Unilateral)
        .units("mm", "MPa", "N")
        .material("wall", 30000.0, 0.2)
        .restrain("x_axis", &[Axis::Y])
        .restrain("y_axis", &[Axis::X])
        .pressure("inner", 10.0)
}
