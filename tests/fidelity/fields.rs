//! Golden fields: every displacement and every stress and strain of the shipped scenes, not their
//! maxima alone.

use std::fmt::Write as _;

use plane_contact::Solution;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::SCENES;

use crate::common::golden_floats::assert_golden;
use crate::common::outcome::solve;
use crate::golden::number;

#[test]
fn displacements_and_stresses_of_every_variant() {
    for scene in SCENES {
        for variant in Variant::ALL {
            let (_, solution) = solve(scene.name, *variant);
            assert_golden(scene.name, &format!("fields-{variant}"), &fields(&solution));
        }
    }
}

/// A line for each node: u, v, length. A line for each triangle: sigma_x, sigma_y, tau_xy and the
/// von Mises stress, then a line with e_xx, e_yy, g_xy and the von Mises strain: a tolerance is
/// relative to its line.
fn fields(solution: &Solution) -> String {
    let mut text = String::from("node: u v\n");
    for node in solution.model.node_ids() {
        let [u, v] = node.of(&solution.u).map(number);
        writeln!(text, "{node}: {u} {v}").expect("a String takes any text");
    }
    text += "triangle: sigma_x sigma_y tau_xy von_mises\ntriangle: e_xx e_yy g_xy von_mises\n";
    for (id, state) in solution.model.triangle_ids().zip(&solution.elements) {
        let stress = [state.sigma[0], state.sigma[1], state.sigma[2], state.von_mises_stress];
        let strain = [state.epsilon[0], state.epsilon[1], state.epsilon[2], state.von_mises_strain];
        for row in [stress, strain] {
            let row = row.map(number).join(" ");
            writeln!(text, "{id}: {row}").expect("a String takes any text");
        }
    }
    text
}
