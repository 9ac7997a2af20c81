//! SOURCE: NAFEMS, Benchmark Tests for Various Finite Element Contact Problems, CGS-1; closed form:
//! K. L. Johnson, Contact Mechanics, section 4.2.
//!
//! GOAL: a cylinder on a block: half width 6.2146 mm, peak pressure 3585.36 MPa.
//!
//! MESH: half model, graded towards the contact, 3,806 equations (20 edges on the half width) and
//! 30,090 (59).
//!
//! BOUNDARY CONDITIONS: R = 50 mm, 35 kN/mm on the top of the cylinder, bottom held in y, axis in
//! x, frictionless. E = 210 and 70 GPa, nu = 0.3, plane strain.
//!
//! Half width and peak are fitted to the pressures (`common::fitted_hertz`).
//!
//! A SECOND CODE (run once, on the meshes of 10 and 20 edges on the half width): Kratos 10.4.4's dual
//! mortar (ALMContactFrictionless, segments cut exactly, normals of the contact surface, the moved
//! mesh: `--geometry current` here) gives displacements within 3.9e-5 and 5.9e-6 of the largest,
//! peak von Mises stresses within 1.6e-6 and 1.2e-7; the difference shrinks with its penalty. In the
//! mesh not moved its normals are the cylinder's and ours the block's: 9e-3. Standard in place of
//! dual multipliers (an own code) change displacements by 4e-4 and 9e-5.

use crate::common::fitted_hertz::{over_hertz, peak_pressure};
use crate::common::tolerances::{HERTZ_PRINTED, assert_near};
use plane_contact::problem::modelling::{Coupling, Geometry};
use plane_contact::studies::benchmark::Hertz;

testing::tolerances! {
    /// Known departures of a curved or deformed surface from Hertz's half plane, relative.
    KNOWN_CURVATURE = 1e-3, "stated to three decimals, and a mesh error of 5e-4 at 40 and 59 edges";
    /// The same at about 30,000.
    HERTZ_FINE = 5e-3, "the issue's own number; measured 0.1 %, and 0.03 % at a tenth of the load";
    /// Hertz's half width and peak at about 4,000 equations, relative.
    HERTZ_COARSE = 1e-2, "the issue's own number; measured 0.2 %, node to segment 0.4 %";
}

const HALF_WIDTH: f64 = 6.2146;
const PEAK: f64 = 3585.36;
const LOAD: f64 = 35000.0;

#[test]
fn the_closed_form_is_the_benchmarks() {
    let hertz = Hertz::default();
    assert_near("half width", hertz.half_width(), HALF_WIDTH, HALF_WIDTH, &HERTZ_PRINTED);
    assert_near("peak", peak_pressure(&hertz), PEAK, PEAK, &HERTZ_PRINTED);
}

#[test]
fn at_4_000_equations_within_one_percent() {
    for coupling in [Coupling::Mortar, Coupling::Nts] {
        let [half_width, peak] = over_hertz(20, LOAD, |m| m.coupling = coupling);
        assert_near("half width", half_width, 1.0, 1.0, &HERTZ_COARSE);
        assert_near("peak pressure", peak, 1.0, 1.0, &HERTZ_COARSE);
    }
}

#[test]
fn at_30_000_equations_within_half_a_percent() {
    for load in [LOAD, LOAD / 10.0] {
        let [half_width, peak] = over_hertz(59, load, |_| ());
        assert_near("half width", half_width, 1.0, 1.0, &HERTZ_FINE);
        assert_near("peak pressure", peak, 1.0, 1.0, &HERTZ_FINE);
    }
}

/// Known: in the current shape the surfaces have shortened by 1 to 3 % under the pressure, so the
/// cylinder is more curved; Hertz's theory leaves that out.
#[test]
fn in_the_current_shape_the_peak_is_higher() {
    let current = over_hertz(40, LOAD, |m| m.geometry = Geometry::Current);
    let initial = over_hertz(40, LOAD, |m| m.geometry = Geometry::Initial);
    assert_near("half width", current[0] / initial[0], 0.9914, 1.0, &KNOWN_CURVATURE);
    assert_near("peak", current[1] / initial[1], 1.0083, 1.0, &KNOWN_CURVATURE);
}
