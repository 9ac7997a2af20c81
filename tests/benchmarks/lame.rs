//! SOURCE: G. Lamé; S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 28.
//!
//! GOAL: a thick-walled cylinder under internal pressure: u(ri) = 0.00613333 mm, hoop stress at the
//! bore 16.6667 MPa; displacements of second order.
//!
//! MESH: a quarter, n x 2n cells of polar coordinates, each cut into two triangles; n = 4, 8, 16,
//! 32, 64.
//!
//! BOUNDARY CONDITIONS: 10 MPa on the bore, the axes held across themselves. ri = 10 mm, ro = 20
//! mm, E = 30000 MPa, nu = 0.2, plane strain.
//!
//! Measured where the quarter's diagonal meets the bore. Stress: extrapolated (`common::recovery`).

use crate::common::annulus::annulus as plate;
use crate::common::recovery::{extrapolated, node_at, order, solved};
use crate::common::tolerances::assert_near;
use plane_contact::engine::Solution;

testing::tolerances! {
    /// Lamé at 64 divisions, hoop stress of the bore, relative to it.
    LAME_STRESS = 6e-4, "second order by extrapolation: 3.9e-4 was measured, four times that at 32 divisions";
    /// Lamé at 64 divisions through the wall, displacement of the bore, relative to it.
    LAME_DISPLACEMENT = 2e-4, "second order: 1.2e-4 was measured, four times that at 32 divisions";
    /// Lamé: order of convergence, absolute.
    LAME_ORDER = 0.06, "theory gives 2 in the limit; 1.95, 2.00, 2.01 were measured between 4 and 32 divisions";
}

pub fn annulus(n: usize) -> Solution {
    solved(plate(n, 2 * n))
}

/// The closed form's radial displacement, mm.
pub fn exact(r: f64) -> f64 {
    let (p, [a2, b2], e, nu) = (10.0, [100.0, 400.0], 30000.0, 0.2);
    (1.0 + nu) * p * a2 / (e * (b2 - a2)) * ((1.0 - 2.0 * nu) * r + b2 / r)
}

/// Root mean square of the displacements' error over the nodes, mm.
fn error(solution: &Solution) -> f64 {
    let squares = solution.model.node_ids().map(|node| {
        let ([x, y], [ux, uy]) = (solution.model.coordinates(node), node.components(&solution.u));
        let r = x.hypot(y);
        let [ex, ey] = [x, y].map(|c| exact(r) * c / r);
        (ux - ex).powi(2) + (uy - ey).powi(2)
    });
    (squares.sum::<f64>() / solution.model.nodes.len() as f64).sqrt()
}

#[test]
fn displacements_converge_with_order_2() {
    let errors = [4, 8, 16, 32].map(|n| error(&annulus(n)));
    for pair in errors.windows(2) {
        assert_near("order", order(pair[0], pair[1]), 2.0, 1.0, &LAME_ORDER);
    }
}

#[test]
fn the_bore_has_its_displacement_and_hoop_stress() {
    let solution = annulus(64);
    let bore = node_at(&solution.model, [50f64.sqrt(); 2]);
    let [x, y] = bore.components(&solution.u);
    let u = x.hypot(y);
    assert_near("u", u, 0.00613333, 0.00613333, &LAME_DISPLACEMENT);
    let [xx, yy, xy] = extrapolated(&solution, bore);
    assert_near("hoop stress", (xx + yy) / 2.0 - xy, 16.6667, 16.6667, &LAME_STRESS);
}
