//! SOURCE: the contact patch test: R. L. Taylor, P. Papadopoulos (1991); why node to segment misses
//! it: G. Zavarise, L. De Lorenzis, Int. J. Numer. Meth. Engng 79 (2009) 379-416.
//!
//! GOAL: two stacked blocks under uniform pressure carry it unchanged: sigma_y = -p everywhere, von
//! Mises 5.774 MPa, top -0.010080 mm.
//!
//! MESH: 50 x 25 mm each; 7 divisions of the upper block on 10 of the lower, and 7 on 7.
//!
//! BOUNDARY CONDITIONS: p = 6.3 MPa on the top, bottom held in y, left sides in x, frictionless. E
//! = 30000 MPa, nu = 0.2, plane strain.
//!
//! A SECOND CODE (run once, on this mesh): Kratos 10.4.4's dual mortar (ALMContactFrictionless, Python
//! packages KratosMultiphysics, StructuralMechanics and ContactStructuralMechanics) carries the load
//! unchanged too; displacements differ from ours by 3e-13 of the largest.

use crate::common::recovery::solved_by;
use crate::common::tolerances::{PATCH_TEST, assert_near};
use plane_contact::engine::Solution;
use plane_contact::problem::modelling::Coupling;
use plane_contact::studies::benchmark::Blocks;

testing::tolerances! {
    /// sigma_y / p of the patch test under node to segment, absolute.
    KNOWN_NTS = 1e-4, "the known miss is stated to four digits";
}

const P: f64 = 6.3;

fn blocks(upper: usize, coupling: Coupling) -> Solution {
    let blocks = Blocks { upper, lower: 10 }.generate().expect("in range");
    solved_by(blocks, |model| model.coupling = coupling)
}

/// Least and largest sigma_y / p.
fn sigma_y(solution: &Solution) -> [f64; 2] {
    let values = solution.elements.iter().map(|state| state.sigma[1] / P);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], s| [l.min(s), h.max(s)])
}

fn assert_exact(solution: &Solution) {
    let von_mises = P * (1.0_f64 - 0.2 + 0.04).sqrt();
    for (n, state) in solution.elements.iter().enumerate() {
        let what = format!("von Mises stress of triangle {}", n + 1);
        assert_near(&what, state.von_mises_stress, von_mises, von_mises, &PATCH_TEST);
        assert_near("sigma_y", state.sigma[1], -P, P, &PATCH_TEST);
    }
    let top = solution.u.iter().skip(1).step_by(2).fold(0.0_f64, |least, v| least.min(*v));
    assert_near("top", top, -0.010080, 0.010080, &PATCH_TEST);
    for node in &solution.contact {
        assert_near("pressure", node.pressure.unwrap(), P, P, &PATCH_TEST);
    }
}

#[test]
fn mortar_passes() {
    assert_exact(&blocks(7, Coupling::Mortar));
}

#[test]
fn matching_nodes_pass_either_way() {
    assert_exact(&blocks(10, Coupling::Mortar));
    assert_exact(&blocks(10, Coupling::Nts));
}

/// Known: the force of a contact node goes to the two nodes of one edge, as if it acted at a point;
/// a uniform pressure on the lower block is another split. No refinement helps.
#[test]
fn node_to_segment_misses_by_a_known_amount() {
    let [least, largest] = sigma_y(&blocks(7, Coupling::Nts));
    assert_near("least sigma_y / p", least, -1.1453, 1.0, &KNOWN_NTS);
    assert_near("largest sigma_y / p", largest, -0.9008, 1.0, &KNOWN_NTS);
    let fine = Blocks { upper: 28, lower: 40 }.generate().expect("in range");
    let fine = solved_by(fine, |model| model.coupling = Coupling::Nts);
    let [least, largest] = sigma_y(&fine);
    assert!(least < -1.13 && largest > -0.91, "refinement does not help: {least}, {largest}");
}
