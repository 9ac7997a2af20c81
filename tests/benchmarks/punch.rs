//! SOURCE: K. L. Johnson, Contact Mechanics, section 2.8(a).
//!
//! GOAL: a flat stiff punch on a half plane, frictionless: p(x) = P / (pi sqrt(a² − x²)) away from
//! the corner.
//!
//! MESH: half model, 24 and 48 edges on the half width, graded towards the corner, as far as 20
//! half widths.
//!
//! BOUNDARY CONDITIONS: axis held in x, the outer boundary in both; the punch 10,000 times as stiff
//! as the foundation. a = 1.

use std::f64::consts::PI;

use crate::common::recovery::solved;
use crate::common::tolerances::assert_near;
use plane_contact::engine::Solution;
use plane_contact::studies::benchmark::Punch;

testing::tolerances! {
    /// The pressure of a flat punch away from its corner, relative to the closed form.
    PUNCH = 1.5e-2, "24 edges on the half width, a boundary at 20: measured 1 %";
}

/// As far as this the corner's last nodes do not show.
const AWAY: f64 = 0.75;

pub fn punch(size: usize) -> Solution {
    let punch = Punch { punch: size, foundation: size, ..Punch::default() };
    solved(punch.generate().expect("in range"))
}

#[test]
fn the_pressure_away_from_the_corner_is_the_closed_form() {
    let solution = punch(24);
    let half_load: f64 = solution.contact.iter().filter_map(|c| c.force).sum();
    let near = solution.contact.iter().filter(|c| c.arc < AWAY);
    assert!(near.clone().count() > 10);
    for node in near {
        let exact = 2.0 * half_load / (PI * (1.0 - node.arc.powi(2)).sqrt());
        assert_near(
            &format!("pressure at {}", node.arc),
            node.pressure.unwrap(),
            exact,
            exact,
            &PUNCH,
        );
    }
}

/// At the corner the closed form has no bound, and a finer mesh shows more of it.
#[test]
fn the_pressure_at_the_corner_grows_with_the_mesh() {
    let peak = |size| punch(size).contact.iter().filter_map(|c| c.pressure).fold(0.0, f64::max);
    let (coarse, fine) = (peak(24), peak(48));
    assert!(fine > 1.5 * coarse, "{coarse}, {fine}");
}
