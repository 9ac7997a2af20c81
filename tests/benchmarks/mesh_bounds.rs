//! What `solve --probe` prints, beside closed forms: the numbers, and how much wider than the true
//! error their mesh bounds are.
//!
//! SOURCE: Lamé, Kirsch: S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, art. 28 and 35;
//! Cook: 23.96, R. D. Cook, J. Struct. Div. ASCE 100 (1974) 1851-1863; corners: M. L. Williams, J.
//! Appl. Mech. 19 (1952) 526-528.
//!
//! GOAL: bounds of displacements that hold, and are at most MESH_BOUND_WIDTH times as wide as the
//! error; recovered stresses within RECOVERED; no bound where the stress has no limit.
//!
//! MESH, BOUNDARY CONDITIONS: those of `mesh annulus`, `mesh hole`, `mesh cook`.

use std::f64::consts::PI;

use crate::common::json::build;
use crate::common::recovery::solved;
use crate::common::tolerances::{FLAMANT, MESH_BOUND_WIDTH, RECOVERED, assert_near};
use crate::cook::membrane;
use crate::kirsch::{sheet, stress};
use plane_contact::engine::estimates::{Cause, Estimates, NoLimit};
use plane_contact::engine::{Assessment, Probe, Solution, max_displacement};
use plane_contact::error::InputError;
use plane_contact::problem::scene::Scene;
use plane_contact::report::tables::error_estimates;
use plane_contact::studies::benchmark::Annulus;
use plane_contact::{Request, solve};
use serde_json::json;

fn probed(solution: &Solution, at: [f64; 2]) -> Vec<Probe> {
    let mut assessment = Assessment::new(solution);
    assessment.probe(solution, &[at]).expect("a body has the point");
    assessment.probes
}

/// A number of the first body that has a point: value, recovered, mesh.
fn number(probes: &[Probe], name: &str) -> (f64, Option<f64>, Option<f64>) {
    let quantity = probes[0].quantities.iter().find(|q| q.name == name).expect("it is printed");
    (quantity.value, quantity.recovered, quantity.mesh)
}

/// That the bound holds, and how wide it is over the error.
fn width(what: &str, (value, _, mesh): (f64, Option<f64>, Option<f64>), exact: f64) -> f64 {
    let (error, bound) = ((value - exact).abs(), mesh.expect("a bound"));
    println!("{what}: {value:.6} for {exact:.6}, bound / error {:.2}", bound / error);
    assert!(error <= bound, "{what}: error {error:e}, bound {bound:e}");
    bound / error
}

fn assert_bound(what: &str, number: (f64, Option<f64>, Option<f64>), exact: f64) {
    let (width, limit) = (width(what, number, exact), MESH_BOUND_WIDTH.limit);
    assert!(width <= limit, "{what}: {width} times as wide as the error");
}

#[test]
fn lame_is_read_from_the_program() {
    for n in [8, 16, 32] {
        let solution = solved(Annulus { radial: n, around: 2 * n }.generate().expect("in range"));
        let probes = probed(&solution, [10.0, 0.0]);
        assert_bound(&format!("Lame {n}, u"), number(&probes, "u_x"), 0.006_133_333);
        assert_bound(&format!("Lame {n}, hoop"), number(&probes, "sigma_y"), 50.0 / 3.0);
        let (_, recovered, _) = number(&probes, "sigma_y");
        if n == 32 {
            assert_near("hoop", recovered.unwrap(), 50.0 / 3.0, 50.0 / 3.0, &RECOVERED);
        }
    }
}

#[test]
fn kirsch_is_read_from_the_program() {
    for around in [16, 32, 64] {
        let solution = solved(sheet(around, 5.0));
        let probes = probed(&solution, [0.0, 1.0]);
        let [exact, ..] = stress([0.0, 1.0]);
        // The triangle's own stress is right there by chance: its bound holds, but is wide.
        width(&format!("Kirsch {around}"), number(&probes, "sigma_x"), exact);
        let (_, recovered, _) = number(&probes, "sigma_x");
        if around == 64 {
            assert_near("sigma_x", recovered.unwrap(), exact, exact, &RECOVERED);
        }
    }
}

#[test]
fn cook_is_read_from_the_program() {
    for n in [8, 16, 32] {
        let solution = solved(membrane(n));
        let probes = probed(&solution, [48.0, 52.0]);
        assert_bound(&format!("Cook {n}"), number(&probes, "u_y"), 23.96);
    }
}

#[test]
fn a_point_on_a_node_names_every_triangle_that_has_it() {
    let solution = solved(Annulus { radial: 4, around: 8 }.generate().expect("in range"));
    let probes = probed(&solution, [10.0, 0.0]);
    assert_eq!((probes.len(), probes[0].body.as_str()), (1, "wall"));
    assert_eq!(probes[0].triangle, 1);
    assert_eq!(probes[0].shared, [2]);
}

#[test]
fn a_point_outside_every_body_is_refused_with_the_nearest_one() {
    let solution = solved(Annulus { radial: 4, around: 8 }.generate().expect("in range"));
    let refused = Assessment::new(&solution).probe(&solution, &[[25.0, 0.0]]);
    let InputError { what, place, fix } = refused.expect_err("the wall ends at 20");
    assert!(what.contains("25,0") && place == "probe", "{what} {place}");
    assert!(fix.contains("20,0 of body wall, 5.000e0 away"), "{fix}");
}

/// The limit of each body's largest stress.
fn limits(solution: &Solution) -> Vec<Option<NoLimit>> {
    Estimates::new(solution).errors.bodies.into_iter().map(|body| body.no_limit).collect()
}

/// Cook's membrane has an angle of 108 degrees where its held side ends above, one of 48 below: the
/// stress has a limit below 60.
#[test]
fn a_held_side_has_a_limit_only_where_its_corner_is_sharp() {
    let solution = solved(membrane(16));
    let [Some(found)] = &limits(&solution)[..] else { panic!("the corner is not found") };
    assert_eq!(found.cause, Cause::Restraint);
    assert_eq!(solution.model.coordinates(found.node), [0.0, 44.0]);
    assert!(found.is_largest);
    assert!(Estimates::new(&solution).errors.bodies[0].mesh.is_none());
    let corner = &probed(&solution, [0.0, 44.0])[0];
    assert_eq!(corner.no_limit, Some(Cause::Restraint));
    let stress = corner.quantities.iter().find(|q| q.name == "von Mises stress");
    assert_eq!(stress.expect("it is printed").mesh, None);
}

/// Symmetry and a circle of chords make no corner.
#[test]
fn what_is_smooth_has_a_limit() {
    for smooth in [Annulus { radial: 8, around: 16 }.generate().expect("in range"), sheet(16, 5.0)]
    {
        assert_eq!(limits(&solved(smooth)), [None]);
    }
}

/// Contact that sticks has no limit where it ends; without friction it fades away.
#[test]
fn sticking_contact_has_none_where_it_ends() {
    let request = Request::new(&Scene::open("strand").unwrap());
    let run = |request: &Request| limits(&solve(request, &mut |_| ()).unwrap());
    for body in run(&request.equilibrium()) {
        assert_eq!(body.expect("no limit").cause, Cause::Sticking);
    }
    assert_eq!(run(&request.reference()), [None, None]);
}

/// A block of unit width on rollers, six by six squares, with a force on the middle of its top; the
/// upper half is of another material.
fn pushed(upper: f64) -> Scene {
    let n = 6;
    let number = |i: usize, j: usize| j * (n + 1) + i + 1;
    let place = |k: usize| k as f64 / n as f64;
    let nodes = (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j)));
    let node: Vec<_> = nodes.map(|(i, j)| json!([number(i, j), place(i), place(j), 0.0])).collect();
    let mut elem = Vec::new();
    for k in 0..n {
        elem.push(json!([elem.len() + 1, 1, 2, 10, 10, number(k, 0), number(k + 1, 0)]));
    }
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let body = if j < n / 2 { 1 } else { 2 };
        let [a, b] = [number(i, j), number(i + 1, j)];
        let [d, c] = [number(i, j + 1), number(i + 1, j + 1)];
        elem.push(json!([elem.len() + 1, 2, 2, body, body, a, b, c]));
        elem.push(json!([elem.len() + 1, 2, 2, body, body, a, c, d]));
    }
    build(&json!({
        "plane": "strain",
        "node": node,
        "elem": elem,
        "materials": { "1": { "E": E, "nu": NU }, "2": { "E": upper, "nu": NU } },
        "restraints": [{ "on": 10, "fix": ["x", "y"] }],
        "loads": [{ "node": number(n / 2, n), "force": [0.0, -P] }],
        "variant": "tied",
        "iterations": 1
    }))
    .expect("a sound scene")
}

const E: f64 = 1000.0;
const NU: f64 = 0.25;
const P: f64 = 3.0;

/// Flamant: each mesh of half the element size adds 2 (1 − ν²) P ln 2 / (π E) under the force.
#[test]
fn under_a_force_on_a_node_neither_stress_nor_displacement_has_a_limit() {
    let mut scene = pushed(E);
    let mut largest = Vec::new();
    for _ in 0..4 {
        let solution = solve(&Request::new(&scene), &mut |_| ()).expect("it is held");
        largest.push(max_displacement(&solution.u));
        let estimates = Estimates::new(&solution).errors;
        let limits = estimates.bodies.iter().map(|body| body.no_limit.clone());
        let loaded = limits.flatten().find(|limit| limit.cause == Cause::Load).expect("the force");
        assert_eq!(solution.model.coordinates(loaded.node), [0.5, 1.0]);
        assert_eq!(estimates.displacement_no_limit, Some((loaded.node, Cause::Load)));
        assert!(estimates.displacement_mesh.is_none());
        let assessment = Assessment::new(&solution);
        let words = error_estimates(&solution, &assessment).text(usize::MAX);
        assert!(words.contains("in the plane it diverges under refinement: at node"), "{words}");
        scene = scene.refined().expect("a sound scene").expect("a whole scene").scene;
    }
    let expected = 2.0 * (1.0 - NU * NU) * P * 2f64.ln() / (PI * E);
    let grows = largest[3] - largest[2];
    assert_near("growth", grows, expected, expected, &FLAMANT);
}

/// Where the interface of two materials ends at the outline the stress may have no limit; along it
/// and in one material it has.
#[test]
fn corners_of_two_materials_may_have_none() {
    let at = |upper: f64, place: [f64; 2]| {
        let solution = solve(&Request::new(&pushed(upper)), &mut |_| ()).expect("it is held");
        probed(&solution, place)[0].no_limit
    };
    assert_eq!(at(10.0 * E, [0.0, 0.5]), Some(Cause::Interface));
    assert_eq!(at(10.0 * E, [1.0, 0.5]), Some(Cause::Interface));
    assert_eq!(at(10.0 * E, [0.5, 0.5]), None);
    assert_eq!(at(E, [0.0, 0.5]), None);
    let words = [Cause::Interface, Cause::Load].map(Cause::diverges);
    assert_eq!(words, ["may diverge", "diverges"]);
}
