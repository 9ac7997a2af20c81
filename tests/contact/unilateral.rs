//! The reference solution: what it promises, on every scene, coupling, friction and geometry.

use std::sync::Arc;

use crate::common::tolerances::{BALANCE, assert_near};
use plane_contact::engine::contact::{ContactNode, Status};
use plane_contact::engine::{self, Detail, Request, Solution, Step, distance};
use plane_contact::problem::modelling::{ContactModel, Coupling, Friction, Geometry, Variant};
use plane_contact::problem::scene::{Axis, SCENES, Scene};
use plane_contact::studies::benchmark::{Blocks, Hertz, Punch};
use testing::bodies::{Bodies, Writing, grid};

testing::tolerances! {
    /// Contact in the current shape beside contact in the initial one at a load of a thousandth of CGS-1's, relative to
    /// the peak.
    CURRENT_LENGTHS = 2e-3, "strains of 1e-3 at the contact: the two differ by as much";
    /// Gap times force of a contact node relative to size times the largest force; penetration relative to the size.
    COMPLEMENTARITY = 1e-12, "the issue's own number";
}

/// Both directions.
const BOTH: &[Axis] = &[Axis::X, Axis::Y];

/// The most iterations that an equilibrium under one load may take.
const ITERATIONS: usize = 20;

/// Every way to model contact under `unilateral`.
pub fn models() -> Vec<ContactModel> {
    let mut models = Vec::new();
    for &coupling in Coupling::ALL {
        for &geometry in Geometry::ALL {
            for mu in [0.0, 0.1, 0.3, f64::INFINITY] {
                let friction = Friction::new(mu).unwrap();
                models.push(ContactModel {
                    coupling,
                    friction,
                    geometry,
                    ..ContactModel::default()
                });
            }
        }
    }
    models
}

fn solve(scene: &Scene, model: ContactModel) -> Solution {
    let request = Request::new(scene).variant(Variant::Unilateral).contact(model);
    engine::solve(&request, &mut |_| ()).expect("there is an equilibrium")
}

fn force(node: &ContactNode) -> f64 {
    node.force.expect("no restraint leaves it open")
}

/// The force along the tangent.
fn shear(node: &ContactNode) -> f64 {
    node.friction_needed.map_or(0.0, |needed| needed * force(node))
}

/// The most iterations under one load.
fn iterations(solution: &Solution) -> usize {
    let load = |step: &Step| match &step.detail {
        Detail::Unilateral(own) => own.load.to_bits(),
        Detail::Published(_) => unreachable!("unilateral was asked for"),
    };
    let loads: Vec<u64> = solution.steps.iter().map(load).collect();
    loads.chunk_by(|a, b| a == b).map(<[u64]>::len).max().unwrap_or(0)
}

/// Twice as thick bodies under twice the forces move as before, by the same pressures and shears.
#[test]
fn tractions_are_forces_over_length_and_thickness() {
    let scene = Scene::open("two-blocks").unwrap();
    let mut thick = scene.clone();
    let model = Arc::make_mut(&mut thick.model);
    model.thickness *= 2.0;
    model.load *= 2.0;
    model.stages.iter_mut().for_each(|stage| *stage *= 2.0);
    let rubs = ContactModel { friction: Friction::new(0.3).unwrap(), ..ContactModel::default() };
    let (one, other) = (solve(&scene, rubs).contact, solve(&thick, rubs).contact);
    let tractions = |node: &ContactNode| [node.pressure, node.shear].map(Option::unwrap);
    let scale = one.iter().map(|node| tractions(node)[0]).fold(0.0, f64::max);
    assert!(scale > 0.0);
    for (one, other) in one.iter().zip(&other) {
        for d in [0, 1] {
            assert_near("traction", tractions(other)[d], tractions(one)[d], scale, &BALANCE);
        }
    }
}

/// Force balance, complementarity, no node that pulls, none that penetrates, few iterations.
fn assert_equilibrium(name: &str, scene: &Scene, model: ContactModel) {
    let solution = solve(scene, model);
    let what = |of: &str| format!("{name}, {model:?}: {of}");
    let [fx, fy] = scene.model.total_load();
    let load = fx.hypot(fy);
    assert_near(&what("force on the target"), solution.target_force(), load, load, &BALANCE);
    assert!(iterations(&solution) <= ITERATIONS, "{}", what(&iterations(&solution).to_string()));
    let size = solution.model.bounds().larger_side();
    let most = solution.contact.iter().map(force).fold(0.0, f64::max);
    assert!(most > 0.0, "{}", what("nothing presses"));
    for node in &solution.contact {
        let at = |of: &str| what(&format!("node {}: {of}", node.node));
        assert_near(&at("gap x force"), node.gap * force(node), 0.0, size * most, &COMPLEMENTARITY);
        assert_near(&at("penetration"), node.gap.min(0.0), 0.0, size, &COMPLEMENTARITY);
        assert_near(&at("pull"), force(node).min(0.0), 0.0, most, &BALANCE);
        assert_near(
            &at("force apart"),
            if node.in_contact { 0.0 } else { force(node) },
            0.0,
            most,
            &BALANCE,
        );
        if !node.in_contact {
            continue;
        }
        let (most_shear, shear) = (model.friction.coefficient() * force(node), shear(node));
        match node.status {
            Some(Status::Slip(_)) if most_shear > 0.0 => {
                assert_near(&at("friction"), shear.abs(), most_shear, most, &BALANCE);
            }
            _ => assert!(shear.abs() <= most_shear + 1e-10 * most, "{}", at("beyond friction")),
        }
    }
}

#[test]
fn every_model_ends_in_equilibrium_on_the_strand() {
    let scene = Scene::open("strand").unwrap();
    models().into_iter().for_each(|model| assert_equilibrium("strand", &scene, model));
}

#[test]
fn every_model_ends_in_equilibrium_on_the_benchmarks() {
    let hertz = |size| Hertz { size, ..Hertz::default() }.generate().unwrap();
    let benchmarks = [
        Blocks::default().generate().unwrap(),
        Punch::default().generate().unwrap(),
        hertz(8),
        hertz(20),
        hertz(40),
    ];
    for benchmark in benchmarks {
        let scene = benchmark.build().unwrap();
        for model in models().into_iter().filter(|model| model.friction == Friction::NONE) {
            // Force that a punch's own pressure puts beside the contact does not pass through it.
            if benchmark.name != "punch" {
                assert_equilibrium(&benchmark.name, &scene, model);
            } else {
                assert!(iterations(&solve(&scene, model)) <= ITERATIONS);
            }
        }
    }
}

/// Under small displacements the two geometries are one.
#[test]
fn current_and_initial_shape_agree_as_displacements_vanish() {
    let scene =
        Hertz { size: 20, load: 35.0, ..Hertz::default() }.generate().unwrap().build().unwrap();
    let of = |geometry| solve(&scene, ContactModel { geometry, ..scene.contact });
    let (current, initial) = (of(Geometry::Current), of(Geometry::Initial));
    let peak = |solution: &Solution| solution.contact[0].pressure.unwrap();
    assert_near("peak", peak(&current), peak(&initial), peak(&initial), &CURRENT_LENGTHS);
}

#[test]
fn the_reference_is_at_no_distance_from_itself() {
    for embedded in SCENES {
        let scene = Scene::open(embedded.name).unwrap();
        let reached = engine::solve(&Request::new(&scene).equilibrium(), &mut |_| ()).unwrap();
        let same = distance(&reached, &reached);
        assert_eq!((same.displacement, same.energy_relative), (0.0, 0.0));
    }
}

/// Returns why bodies turned by an angle do not come to rest without friction, in one step of the load.
fn refused(bodies: &Bodies, degrees: f64) -> String {
    let (geometry, friction) = (Geometry::Initial, Friction::NONE);
    let model = ContactModel { geometry, friction, load_steps: 1, ..ContactModel::default() };
    let scene = bodies.modelled(&Writing { degrees, ..Writing::default() }, model).build();
    let request = Request::new(&scene.expect("the scene is sound"));
    engine::solve(&request, &mut |_| ()).expect_err("nothing holds it").to_string()
}

/// A block that a force lifts off its target turns about its upper left corner: the 200 nodes
/// beside that one are guided along y, which leaves the same motion, and is so many restraints that
/// the stiffness of what they leave is no exact 0.
#[test]
fn a_body_that_turns_beside_many_restraints_is_told() {
    for height in [0.7, 1.3, 2.3] {
        let mut nodes = vec![[0.0, -1.0], [2.0, -1.0], [0.0, 0.0], [2.0, 0.0]];
        nodes.extend([[0.5, 0.0], [1.0, 0.0]]);
        nodes.extend((0..=200).map(|k| [f64::from(k) / 200.0, height]));
        let fan = (7..nodes.len()).map(|n| [4, n, n - 1]);
        let both = [0, 1, 2, 3, 6].map(|n| (n, BOTH.into()));
        let guided = (7..nodes.len()).map(|n| (n, vec![Axis::X]));
        let bodies = Bodies {
            triangles: [grid(0, 2, 2), fan.chain([[4, 5, nodes.len() - 1]]).collect()],
            moduli: [(1e3, 0.0); 2],
            contact: vec![4, 5],
            target: vec![[2, 3]],
            restrained: both.into_iter().chain(guided).collect(),
            loads: vec![(5, [0.0, 1.0])],
            nodes,
        };
        let text = refused(&bodies, 0.0);
        assert!(text.starts_with("there is no equilibrium: the load moves node"), "{text}");
    }
}

/// A block over one of which a thousand nodes are held, without friction, turned by any angle.
#[test]
fn that_a_body_can_slide_is_seen_beside_many_restraints() {
    let lower = |y: f64| (0..500).map(move |k| [f64::from(k) / 10.0, y]);
    let mut nodes: Vec<[f64; 2]> = lower(-1.0).chain(lower(0.0)).collect();
    let first = nodes.len();
    nodes.extend([[20.03, 0.0], [21.03, 0.0], [20.03, 1.0], [21.03, 1.0]]);
    let bodies = Bodies {
        nodes,
        triangles: [grid(0, first / 2, 2), grid(first, 2, 2)],
        moduli: [(1e3, 0.0); 2],
        contact: vec![first, first + 1],
        target: (first / 2..first - 1).map(|n| [n, n + 1]).collect(),
        restrained: (0..first).map(|n| (n, BOTH.into())).collect(),
        loads: [first + 2, first + 3].map(|n| (n, [0.0, -1.0])).into(),
    };
    for degrees in [10.0, 20.0, 35.0, 50.0, 65.0] {
        let text = refused(&bodies, degrees);
        assert!(text.contains("with every contact node in contact"), "{text}");
    }
}
