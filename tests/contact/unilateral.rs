//! The reference solution: what it promises, on every scene, coupling, friction and geometry.

use crate::common::json::build;
use crate::common::tolerances::{
    BALANCE, COMPLEMENTARITY, CURRENT_LENGTHS, FAR_FROM_THE_ORIGIN, FORCE_OF_A_SLOPE, assert_near,
};
use plane_contact::answer::contact::{ContactNode, Status};
use plane_contact::answer::error::Error;
use plane_contact::answer::{self, Detail, Request, Solution, Step, distance, equilibrium};
use plane_contact::problem::model::NodeId;
use plane_contact::problem::modelling::{ContactModel, Coupling, Friction, Geometry, Variant};
use plane_contact::problem::scene::{SCENES, Scene};
use plane_contact::studies::benchmark::{Blocks, Hertz, Punch, PunchPatch};
use serde_json::json;

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
    answer::solve(&request, &mut |_| ()).expect("there is an equilibrium")
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

/// Larger extent of the scene.
fn size(solution: &Solution) -> f64 {
    let extent = |axis: usize| {
        let values = solution.model.nodes.iter().map(|place| place[axis]);
        let (l, h) = values.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        h - l
    };
    extent(0).max(extent(1))
}

/// Force balance, complementarity, no node that pulls, none that penetrates, few iterations.
fn assert_equilibrium(name: &str, scene: &Scene, model: ContactModel) {
    let solution = solve(scene, model);
    let what = |of: &str| format!("{name}, {model:?}: {of}");
    let last = solution.last();
    let [fx, fy] = scene.model.total_load();
    let load = fx.hypot(fy);
    assert_near(&what("force on the target"), last.target_force, load, load, &BALANCE);
    assert!(iterations(&solution) <= ITERATIONS, "{}", what(&iterations(&solution).to_string()));
    let size = size(&solution);
    let most = solution.contact.iter().map(force).fold(0.0, f64::max);
    assert!(most > 0.0, "{}", what("nothing presses"));
    for node in &solution.contact {
        let at = |of: &str| what(&format!("node {}: {of}", node.node));
        assert_near(&at("gap x force"), node.gap * force(node), 0.0, size * most, &COMPLEMENTARITY);
        assert_near(&at("penetration"), node.gap.min(0.0), 0.0, size, &COMPLEMENTARITY);
        assert!(force(node) >= 0.0 || !node.in_contact, "{}", at("pulls"));
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
        PunchPatch::default().generate().unwrap(),
        Punch::default().generate().unwrap(),
        hertz(8),
        hertz(20),
        hertz(40),
    ];
    for benchmark in benchmarks {
        let scene = benchmark.build().unwrap();
        for model in models().into_iter().filter(|model| model.friction == Friction::NONE) {
            // Force that a punch's own pressure puts beside the contact does not pass through it.
            if benchmark.name != "punch-patch" && benchmark.name != "punch" {
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
        let reached = equilibrium(&Request::new(&scene)).unwrap();
        let same = distance(&reached, &reached);
        assert_eq!((same.displacement, same.energy_relative), (0.0, 0.0));
    }
}

/// Two unit squares, the upper one on the lower one; `load` on the top edge, `held` of the upper
/// square's left side.
fn stacked(load: [f64; 2], held: &[&str], friction: serde_json::Value) -> serde_json::Value {
    let mut restraints =
        vec![json!({ "node": 1, "fix": ["x", "y"] }), json!({ "node": 2, "fix": ["x", "y"] })];
    if !held.is_empty() {
        restraints.push(json!({ "node": 5, "fix": held }));
        restraints.push(json!({ "node": 8, "fix": held }));
    }
    json!({
        "node": [[1, 0, 0, 0], [2, 1, 0, 0], [3, 1, 1, 0], [4, 0, 1, 0], [5, 0, 1, 0], [6, 1, 1, 0], [7, 1, 2, 0], [8, 0, 2, 0]],
        "elem": [
            [1, 1, 2, 11, 1, 4, 3], [2, 1, 2, 12, 2, 5, 6], [3, 1, 2, 13, 3, 8, 7],
            [4, 2, 2, 1, 1, 1, 2, 3], [5, 2, 2, 1, 1, 1, 3, 4],
            [6, 2, 2, 2, 2, 5, 6, 7], [7, 2, 2, 2, 2, 5, 7, 8]
        ],
        "plane": "stress",
        "materials": { "1": { "E": 1000.0, "nu": 0.0 }, "2": { "E": 1000.0, "nu": 0.0 } },
        "restraints": restraints,
        "loads": [{ "on": 13, "traction": load }],
        "contact": { "cnt": 12, "trg": 11, "c_tll": 0.001, "friction": friction },
        "variant": "unilateral"
    })
}

fn solved(scene: &serde_json::Value) -> Result<Solution, Error> {
    let scene = build(scene).expect("the scene is sound");
    answer::solve(&Request::new(&scene).variant(Variant::Unilateral), &mut |_| ())
}

/// Displacement along y of node 8, a corner of the stack's top edge.
fn top(solution: &Solution) -> f64 {
    NodeId::from_number(8).of(&solution.u)[1]
}

#[test]
fn a_stack_is_shortened_by_its_load() {
    let solution = solved(&stacked([0.0, -1.0], &["x"], json!(0))).unwrap();
    assert_near("top", top(&solution), -2e-3, 2e-3, &BALANCE);
}

#[test]
fn a_body_that_may_slide_is_the_inputs_fault() {
    let error = solved(&stacked([0.0, -1.0], &[], json!(0))).unwrap_err();
    assert_eq!(error.exit_status(), 2);
    assert!(error.to_string().contains("can move in x"), "{error}");
    assert!(
        solved(&stacked([0.0, -1.0], &[], json!("stick"))).is_ok(),
        "where it sticks it is held"
    );
}

#[test]
fn a_body_that_is_pulled_away_has_no_equilibrium() {
    let error = solved(&stacked([0.0, 1.0], &["x"], json!(0))).unwrap_err();
    assert_eq!(error.exit_status(), 4);
    assert!(error.to_string().contains("no contact state in equilibrium was found"), "{error}");
}

/// Node 5 carries half of the load; its restraint takes it, as far as the target leaves it.
#[test]
fn the_force_on_a_contact_node_restrained_along_the_normal_comes_from_its_target() {
    let flat = json!({ "geometry": "initial" });
    let solution = solved(&with(&stacked([0.0, -1.0], &["x", "y"], json!(0)), &flat)).unwrap();
    let passed = solution.last().target_force;
    let forces: f64 = solution.contact.iter().map(force).sum();
    assert_near("force on the target", forces, passed, 1.0, &BALANCE);
    assert!(solution.contact.iter().all(|node| force(node) >= 0.0));
}

/// Where both surfaces are restrained along the normal nothing says what passes between them.
#[test]
fn a_force_between_two_restraints_is_not_determined() {
    let mut scene = stacked([0.0, -1.0], &["x", "y"], json!(0));
    let restraints = scene["restraints"].as_array_mut().unwrap();
    restraints.push(json!({ "node": 4, "fix": ["x", "y"] }));
    let solution = solved(&scene).unwrap();
    let of = |number: usize| {
        let mut nodes = solution.contact.iter();
        nodes.find(|node| node.node.number() == number).unwrap()
    };
    assert_eq!((of(5).force, of(5).pressure), (None, None));
    assert!(of(6).force.is_some());
}

#[test]
fn friction_is_a_coefficient_or_stick() {
    for wrong in [json!(-0.1), json!("slippery"), json!("NaN"), json!(null)] {
        let error = build(&stacked([0.0, -1.0], &["x"], wrong.clone())).unwrap_err();
        assert!(
            error.to_string().contains("neither a coefficient of 0 or more"),
            "{wrong}: {error}"
        );
    }
    assert!(build(&stacked([0.0, -1.0], &["x"], json!(0.3))).is_ok());
}

/// `scene` with members of its `contact` set.
fn with(scene: &serde_json::Value, contact: &serde_json::Value) -> serde_json::Value {
    let mut scene = scene.clone();
    for (key, value) in contact.as_object().unwrap() {
        scene["contact"][key] = value.clone();
    }
    scene
}

fn every_coupling_and_geometry() -> Vec<serde_json::Value> {
    let of = |geometry| ["nts", "mortar"].map(|c| json!({ "coupling": c, "geometry": geometry }));
    ["current", "initial"].into_iter().flat_map(of).collect()
}

/// The stack with a Poisson's ratio: its surfaces slide on each other, past the target's end.
fn bulging() -> serde_json::Value {
    let mut scene = stacked([0.0, -1.0], &["x"], json!(0));
    for body in ["1", "2"] {
        scene["materials"][body]["nu"] = json!(0.3);
    }
    scene
}

#[test]
fn a_node_that_slides_a_little_past_the_end_of_the_target_rests_on_it() {
    for contact in every_coupling_and_geometry() {
        let solution = solved(&with(&bulging(), &contact)).unwrap();
        assert_eq!(solution.in_contact().count(), 2, "{contact}");
        let force: f64 = solution.contact.iter().map(force).sum();
        assert_near("force", force, 1.0, 1.0, &FORCE_OF_A_SLOPE);
    }
}

#[test]
fn a_scene_far_from_the_origin_has_the_same_answer() {
    for contact in every_coupling_and_geometry() {
        let scene = with(&bulging(), &contact);
        let mut far = scene.clone();
        for row in far["node"].as_array_mut().unwrap() {
            for (axis, by) in [(1, 1e6), (2, -3e6)] {
                row[axis] = json!(row[axis].as_f64().unwrap() + by);
            }
        }
        let (near, far) = (solved(&scene).unwrap(), solved(&far).unwrap());
        let (near, far) = (top(&near), top(&far));
        assert_near("top", far, near, near.abs(), &FAR_FROM_THE_ORIGIN);
    }
}

#[test]
fn bodies_that_touch_without_a_load_rest() {
    for contact in every_coupling_and_geometry() {
        let solution = solved(&with(&stacked([0.0, 0.0], &["x"], json!(0)), &contact)).unwrap();
        assert_eq!(solution.u.amax(), 0.0);
    }
}

/// All of the upper square's outline listed: only its lower side faces the target, and its corners
/// stand for half of each side.
#[test]
fn a_closed_contact_surface_has_an_edge_from_its_last_node_to_its_first() {
    for contact in every_coupling_and_geometry() {
        let closed = with(&with(&bulging(), &contact), &json!({ "cnt": [5, 6, 7, 8] }));
        let open = solved(&with(&bulging(), &contact)).unwrap();
        let closed = solved(&closed).unwrap();
        let numbers: Vec<usize> = closed.contact.iter().map(|c| c.node.number()).collect();
        assert_eq!(numbers, [5, 6]);
        for (one, other) in closed.contact.iter().zip(&open.contact) {
            assert_near("force", force(one), force(other), 1.0, &BALANCE);
        }
        if contact["coupling"] == "nts" {
            let of =
                |o: &Solution| o.contact.iter().map(|c| c.pressure.unwrap()).collect::<Vec<_>>();
            for (one, other) in of(&closed).into_iter().zip(of(&open)) {
                assert_near("pressure over both sides", one, other / 2.0, 1.0, &CURRENT_LENGTHS);
            }
        }
    }
}

#[test]
fn a_node_named_twice_counts_once() {
    for contact in every_coupling_and_geometry() {
        let twice = with(&with(&bulging(), &contact), &json!({ "cnt": [5, 6, 5, 6] }));
        let of = |scene| solved(&scene).unwrap().contact;
        assert_eq!(of(twice), of(with(&bulging(), &contact)));
    }
}

#[test]
fn a_surface_that_does_not_face_the_target_is_the_inputs_fault() {
    for contact in every_coupling_and_geometry() {
        let scene = with(&with(&bulging(), &contact), &json!({ "cnt": [8, 7] }));
        let error = solved(&scene).unwrap_err();
        assert_eq!(error.exit_status(), 2);
        assert!(error.to_string().contains("no contact node faces the target"), "{error}");
    }
}

/// A wedge over a roof of two faces, 0.4 above its ridge: the normal is the mean of the faces', and
/// the gap is measured along it.
#[test]
fn a_gap_over_a_ridge_closes() {
    let scene = json!({
        "node": [[1, 0, 0, 0], [2, 2, 0, 0], [3, 2, 1, 0], [4, 1, 1.1, 0], [5, 0, 1, 0], [6, 1, 1.5, 0], [7, 1.5, 2, 0], [8, 0.5, 2, 0]],
        "elem": [
            [1, 1, 2, 11, 1, 3, 4], [2, 1, 2, 11, 1, 4, 5],
            [3, 2, 2, 1, 1, 1, 2, 4], [4, 2, 2, 1, 1, 2, 3, 4], [5, 2, 2, 1, 1, 1, 4, 5], [6, 2, 2, 2, 2, 6, 7, 8]
        ],
        "plane": "stress",
        "materials": { "1": { "E": 1000.0, "nu": 0.0 }, "2": { "E": 1000.0, "nu": 0.0 } },
        "restraints": [
            { "node": 1, "fix": ["x", "y"] }, { "node": 2, "fix": ["x", "y"] },
            { "node": 6, "fix": ["x"] }, { "node": 7, "fix": ["x"] }
        ],
        "loads": [{ "node": 7, "force": [0.0, -0.5] }, { "node": 8, "force": [0.0, -0.5] }],
        "contact": { "cnt": [6], "trg": [1, 2], "c_tll": 0.001, "friction": 0 },
        "variant": "unilateral"
    });
    for geometry in ["current", "initial"] {
        let solution = solved(&with(&scene, &json!({ "geometry": geometry }))).unwrap();
        let node = &solution.contact[0];
        assert_near("gap", node.gap, 0.0, 1.0, &COMPLEMENTARITY);
        assert_near("force", force(node), 1.0, 1.0, &FORCE_OF_A_SLOPE);
    }
}

/// A square on a longer target whose surface falls away from the middle, loaded right of where it
/// first touches: it tips over that node until another one touches. The nodes left of it, with gaps
/// as small, would pull.
#[test]
fn a_body_that_tips_comes_to_rest_on_the_side_that_it_tips_to() {
    let surface = |x: f64| 1.0 - 0.05 * (x - 0.4) * (x - 0.4);
    let (mut node, mut elem) = (Vec::new(), Vec::new());
    for k in 0..=10 {
        let x = 0.2 * f64::from(k) - 0.6;
        node.push(json!([2 * k + 1, x, 0.0, 0.0]));
        node.push(json!([2 * k + 2, x, surface(x), 0.0]));
    }
    for k in 0..10 {
        let [a, b, c, d] = [2 * k + 1, 2 * k + 3, 2 * k + 4, 2 * k + 2];
        elem.push(json!([elem.len() + 1, 1, 2, 11, 1, c, d]));
        elem.push(json!([elem.len() + 1, 2, 2, 1, 1, a, b, c]));
        elem.push(json!([elem.len() + 1, 2, 2, 1, 1, a, c, d]));
    }
    for k in 0..=4 {
        let x = 0.25 * f64::from(k);
        node.push(json!([23 + 2 * k, x, 1.01, 0.0]));
        node.push(json!([24 + 2 * k, x, 2.01, 0.0]));
    }
    for k in 0..4 {
        let [a, b, c, d] = [23 + 2 * k, 25 + 2 * k, 26 + 2 * k, 24 + 2 * k];
        elem.push(json!([elem.len() + 1, 2, 2, 2, 2, a, b, c]));
        elem.push(json!([elem.len() + 1, 2, 2, 2, 2, a, c, d]));
    }
    let mut restraints: Vec<_> =
        (0..=10).map(|k| json!({ "node": 2 * k + 1, "fix": ["x", "y"] })).collect();
    restraints.push(json!({ "node": 24, "fix": ["x"] }));
    let scene = json!({
        "node": node, "elem": elem, "plane": "strain",
        "materials": { "1": { "E": 1e5, "nu": 0.3 }, "2": { "E": 1e5, "nu": 0.3 } },
        "restraints": restraints,
        "loads": [{ "node": 28, "force": [0.0, -0.5] }, { "node": 32, "force": [0.0, -0.5] }],
        "contact": {
            "cnt": [23, 25, 27, 29, 31], "trg": (0..10).map(|k| 3 * k + 1).collect::<Vec<_>>(), "c_tll": 0.001,
            "friction": 0, "geometry": "initial"
        },
        "variant": "unilateral"
    });
    for coupling in ["nts", "mortar"] {
        let solution = solved(&with(&scene, &json!({ "coupling": coupling }))).unwrap();
        assert!(solution.in_contact().all(|c| c.gap >= -1e-11 && force(c) >= 0.0));
        let right = solution.in_contact().filter(|c| c.arc > 0.5).count();
        assert!(right > 0, "it rests on its right side too");
    }
}

/// The stack pushed to +x by a fifth of what presses it: the target pushes back, to the left, which
/// is the tangent's direction.
#[test]
fn shear_and_the_friction_needed_balance_a_push_along_the_surface() {
    let flat = json!({ "geometry": "initial" });
    let solution = solved(&with(&stacked([0.2, -1.0], &[], json!("stick")), &flat)).unwrap();
    let shear: f64 = solution.contact.iter().map(|c| 0.5 * c.shear.unwrap()).sum();
    assert_near("shear force", shear, 0.2, 1.0, &BALANCE);
    for node in &solution.contact {
        let needed = node.friction_needed.expect("every node presses");
        assert_near(
            "friction",
            needed * node.pressure.unwrap(),
            node.shear.unwrap().abs(),
            1.0,
            &BALANCE,
        );
    }
}
