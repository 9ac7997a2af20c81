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

use crate::common::recovery::solved;
use crate::common::tolerances::{MESH_BOUND_WIDTH, RECOVERED, assert_near};
use plane_contact::answer::estimates::{Cause, ErrorEstimates, NoLimit};
use plane_contact::answer::{Assessment, Probe, Solution};
use plane_contact::error::InputError;
use plane_contact::problem::scene::Scene;
use plane_contact::studies::benchmark::{Annulus, Cook, Hole};
use plane_contact::{Request, solve};

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
        let solution = solved(Annulus { radial: n, around: 2 * n }.generate());
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
        let solution = solved(Hole { around, outer: 5.0 }.generate());
        let probes = probed(&solution, [0.0, 1.0]);
        let [exact, ..] = Hole::stress([0.0, 1.0]);
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
        let solution = solved(Cook { n }.generate());
        let probes = probed(&solution, [48.0, 52.0]);
        assert_bound(&format!("Cook {n}"), number(&probes, "u_y"), 23.96);
    }
}

#[test]
fn a_point_on_a_node_names_every_triangle_that_has_it() {
    let solution = solved(Annulus { radial: 4, around: 8 }.generate());
    let probes = probed(&solution, [10.0, 0.0]);
    assert_eq!((probes.len(), probes[0].body.as_str()), (1, "wall"));
    assert_eq!(probes[0].triangle, 1);
    assert_eq!(probes[0].shared, [2]);
}

#[test]
fn a_point_outside_every_body_is_refused_with_the_nearest_one() {
    let solution = solved(Annulus { radial: 4, around: 8 }.generate());
    let refused = Assessment::new(&solution).probe(&solution, &[[25.0, 0.0]]);
    let InputError { what, place, fix } = refused.expect_err("the wall ends at 20");
    assert!(what.contains("25,0") && place == "--probe", "{what} {place}");
    assert!(fix.contains("20,0 of body wall, 5.000e0 away"), "{fix}");
}

/// The limit of each body's largest stress.
fn limits(solution: &Solution) -> Vec<Option<NoLimit>> {
    ErrorEstimates::new(solution).bodies.into_iter().map(|body| body.no_limit).collect()
}

/// Cook's membrane has an angle of 108 degrees where its held side ends above, one of 48 below: the
/// stress has a limit below 60.
#[test]
fn a_held_side_has_a_limit_only_where_its_corner_is_sharp() {
    let solution = solved(Cook { n: 16 }.generate());
    let [Some(found)] = &limits(&solution)[..] else { panic!("the corner is not found") };
    assert_eq!(found.cause, Cause::Restraint);
    assert_eq!(solution.model.at(found.node), [0.0, 44.0]);
    assert!(found.is_largest);
    assert!(ErrorEstimates::new(&solution).bodies[0].mesh.is_infinite());
    let corner = &probed(&solution, [0.0, 44.0])[0];
    assert_eq!(corner.no_limit, Some(Cause::Restraint));
    let stress = corner.quantities.iter().find(|q| q.name == "von Mises stress");
    assert_eq!(stress.expect("it is printed").mesh, None);
}

/// Symmetry and a circle of chords make no corner.
#[test]
fn what_is_smooth_has_a_limit() {
    for smooth in [Annulus { radial: 8, around: 16 }.generate(), Hole::default().generate()] {
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
