//! SOURCE: R. D. Cook, "Improved two-dimensional finite element", J. Struct. Div. ASCE 100 (1974)
//! 1851-1863.
//!
//! GOAL: the vertical displacement of (48, 52) on each mesh, as other programs give it for the same
//! triangles; 23.96 in the limit.
//!
//! MESH: n x n mapped cells, each cut from its lower left to its upper right corner; n = 2, 4, ...,
//! 64.
//!
//! BOUNDARY CONDITIONS: left side held, a shear load of 1 spread over the right side. E = 1, nu =
//! 1/3, plane stress, thickness 1.

use crate::common::recovery::{node_at, solved};
use crate::common::tolerances::assert_near;
use crate::grid::{between, ends, grid};
use plane_contact::problem::element::Plane;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{Axis, MeshBuilder, SceneBuilder};

testing::tolerances! {
    /// Cook: half a unit of the last of the three decimals of the reference numbers, absolute.
    COOK = 5.1e-4, "the reference numbers are printed with three decimals";
}

/// The membrane with corners (0, 0), (48, 44), (48, 60), (0, 44), of n x n cells.
pub fn membrane(n: usize) -> SceneBuilder {
    let mut mesh = MeshBuilder::default();
    let rows = grid(&mut mesh, "membrane", [n, n], |s, t| {
        between([0.0, 44.0 * t], [48.0, 44.0 + 16.0 * t], s)
    });
    let [left, right] = ends(&rows);
    mesh.edges("left", &left);
    mesh.edges("right", &right);
    SceneBuilder::new("cook", mesh.finish(), Plane::Stress)
        .variant(Variant::Stepped)
        .material("membrane", 1.0, 1.0 / 3.0)
        .restrain("left", &[Axis::X, Axis::Y])
        .traction("right", [0.0, 1.0 / 16.0])
}

/// Divisions and displacement.
pub const KNOWN: [(usize, f64); 6] =
    [(2, 6.743), (4, 11.252), (8, 17.331), (16, 21.592), (32, 23.275), (64, 23.774)];

#[test]
fn the_tip_moves_as_known_on_every_mesh() {
    for (n, expected) in KNOWN {
        let solution = solved(membrane(n));
        let [_, tip] = node_at(&solution.model, [48.0, 52.0]).components(&solution.u);
        assert_near(&format!("n = {n}"), tip, expected, 1.0, &COOK);
    }
}
