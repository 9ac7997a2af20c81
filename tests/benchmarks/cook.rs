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
use crate::common::tolerances::{COOK, assert_near};
use plane_contact::studies::benchmark::Cook;

/// Divisions and displacement.
const KNOWN: [(usize, f64); 6] =
    [(2, 6.743), (4, 11.252), (8, 17.331), (16, 21.592), (32, 23.275), (64, 23.774)];

#[test]
fn the_tip_moves_as_known_on_every_mesh() {
    for (n, expected) in KNOWN {
        let solution = solved(Cook { n }.generate());
        let [_, tip] = node_at(&solution.model, [48.0, 52.0]).components(&solution.u);
        assert_near(&format!("n = {n}"), tip, expected, 1.0, &COOK);
    }
}
