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
use plane_contact::engine::Solution;
use plane_contact::problem::modelling::Coupling;
use plane_contact::studies::benchmark::PunchPatch;

fn punch(coupling: Coupling) -> Solution {
    solved_by(PunchPatch::default().generate(), |model| model.coupling = coupling)
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
