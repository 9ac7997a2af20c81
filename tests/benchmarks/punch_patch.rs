//! SOURCE: R. L. Taylor, P. Papadopoulos, On a patch test for contact problems in two dimensions,
//! in: Computational Methods in Nonlinear Mechanics (1991).
//!
//! GOAL: a punch on a wider foundation, the same pressure on the punch and beside it: sigma_y = -p
//! everywhere.
//!
//! MESH: foundation 8 x 5, punch 2 x 2 on its middle; 6 divisions of the punch on edges of another
//! length.
//!
//! BOUNDARY CONDITIONS: p = 1; bottom held in y, axes in x, frictionless. E = 1000, nu = 0.4, plane
//! strain.

use crate::common::recovery::solved_by;
use crate::common::tolerances::{PATCH_TEST, assert_near};
use crate::grid::grid;
use plane_contact::engine::Solution;
use plane_contact::problem::element::Plane;
use plane_contact::problem::modelling::Friction;
use plane_contact::problem::modelling::{Coupling, Variant};
use plane_contact::problem::scene::{Axis, Contact, MeshBuilder, SceneBuilder};

/// The scene: 6 divisions of the punch on 4 of the foundation, which has 6 more on either side.
pub fn scene() -> SceneBuilder {
    let mut mesh = MeshBuilder::default();
    let foundation = grid(&mut mesh, "foundation", [16, 10], |s, t| [8.0 * s - 4.0, 5.0 * t]);
    let punch = grid(&mut mesh, "punch", [6, 6], |s, t| [2.0 * s - 1.0, 5.0 + 2.0 * t]);
    let axis = |rows: &[Vec<usize>], k: usize| rows.iter().map(|row| row[k]).collect::<Vec<_>>();
    mesh.edges("bottom", &foundation[0]);
    mesh.edges("foundation_axis", &axis(&foundation, 8));
    mesh.edges("target", &foundation[10]);
    mesh.edges("free_left", &foundation[10][..=6]);
    mesh.edges("free_right", &foundation[10][10..]);
    mesh.edges("contact", &punch[0]);
    mesh.edges("punch_top", &punch[6]);
    mesh.edges("punch_axis", &axis(&punch, 3));
    SceneBuilder::new("punch-patch", mesh.finish(), Plane::Strain)
        .variant(Variant::Stepped)
        .material("foundation", 1000.0, 0.4)
        .material("punch", 1000.0, 0.4)
        .restrain("bottom", &[Axis::Y])
        .restrain("foundation_axis", &[Axis::X])
        .restrain("punch_axis", &[Axis::X])
        .pressure("punch_top", 1.0)
        .pressure("free_left", 1.0)
        .pressure("free_right", 1.0)
        .contact(Contact {
            friction: Some(Friction::NONE),
            ..Contact::new("contact", "target", 0.001)
        })
}

pub fn punch(coupling: Coupling) -> Solution {
    solved_by(scene(), |model| model.coupling = coupling)
}

#[test]
fn mortar_carries_the_pressure_unchanged() {
    for state in &punch(Coupling::Mortar).elements {
        assert_near("sigma_y", state.sigma[1], -1.0, 1.0, &PATCH_TEST);
        assert_near("sigma_x", state.sigma[0], 0.0, 1.0, &PATCH_TEST);
    }
}

/// Known: see `benchmark_patch`.
#[test]
fn node_to_segment_does_not() {
    let off =
        punch(Coupling::Nts).elements.iter().map(|s| (s.sigma[1] + 1.0).abs()).fold(0.0, f64::max);
    assert!(off > 0.02, "sigma_y is off by {off} of p");
}
