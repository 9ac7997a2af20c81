//! The converged answer: what it promises, on every scene, coupling, friction and geometry.

mod common;

use common::build;
use common::tolerances::{BALANCE, COMPLEMENTARITY, CURRENT_LENGTHS, assert_near};
use plane_contact::benchmark::{Blocks, Hertz, Punch, PunchPatch};
use plane_contact::contact::{
    Coupling, Friction, Geometry, Model, Outcome, Variant, distance, reference, run,
};
use plane_contact::error::Error;
use plane_contact::mirror::Reading;
use plane_contact::scene::{SCENES, Scene};
use serde_json::json;

/// The most iterations that an equilibrium may take.
const ITERATIONS: usize = 12;

fn models() -> Vec<Model> {
    let mut models = Vec::new();
    for &coupling in Coupling::ALL {
        models.push(Model { coupling, friction: Friction::Stick, ..Model::default() });
        for &geometry in Geometry::ALL {
            models.push(Model { coupling, friction: Friction::None, geometry, ..Model::default() });
        }
    }
    models
}

fn solve(scene: &Scene, model: Model) -> Outcome {
    let mut scene = scene.clone();
    scene.contact = model;
    run(&scene, Variant::Unilateral, &Reading::default(), |_| ()).expect("there is an equilibrium")
}

/// Larger extent of the scene.
fn size(outcome: &Outcome) -> f64 {
    let extent = |column: usize| {
        let values = (1..=outcome.sheet.R()).map(|n| outcome.sheet.node[(n, column)]);
        let (l, h) = values.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        h - l
    };
    extent(2).max(extent(3))
}

/// Force balance, complementarity, no node that pulls, none that penetrates, few iterations.
fn assert_equilibrium(name: &str, scene: &Scene, model: Model) {
    let outcome = solve(scene, model);
    let what = |of: &str| format!("{name}, {model:?}: {of}");
    let last = outcome.iterations.last().unwrap();
    let [fx, fy] = scene.total_load();
    let load = fx.hypot(fy);
    assert_near(&what("force on the target"), last.target_force, load, load, &BALANCE);
    assert!(
        outcome.iterations.len() <= ITERATIONS,
        "{}",
        what(&outcome.iterations.len().to_string())
    );
    let size = size(&outcome);
    let most = outcome.contact.iter().map(|c| c.force).fold(0.0, f64::max);
    assert!(most > 0.0, "{}", what("nothing presses"));
    for node in &outcome.contact {
        let at = |of: &str| what(&format!("node {}: {of}", node.node));
        assert_near(&at("gap x force"), node.gap * node.force, 0.0, size * most, &COMPLEMENTARITY);
        assert_near(&at("penetration"), node.gap.min(0.0), 0.0, size, &COMPLEMENTARITY);
        assert!(node.force >= 0.0 || node.dy == 0, "{}", at("pulls"));
        assert_near(
            &at("force apart"),
            if node.dy == 0 { node.force } else { 0.0 },
            0.0,
            most,
            &BALANCE,
        );
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
        let scene = benchmark.scene().unwrap();
        for model in models().into_iter().filter(|model| model.friction == Friction::None) {
            // Force that a punch's own pressure puts beside the contact does not pass through it.
            if benchmark.name != "punch-patch" && benchmark.name != "punch" {
                assert_equilibrium(benchmark.name, &scene, model);
            } else {
                assert!(solve(&scene, model).iterations.len() <= ITERATIONS);
            }
        }
    }
}

/// Under small displacements the two geometries are one.
#[test]
fn current_and_initial_shape_agree_as_displacements_vanish() {
    let scene =
        Hertz { size: 20, load: 35.0, ..Hertz::default() }.generate().unwrap().scene().unwrap();
    let of = |geometry| solve(&scene, Model { geometry, ..scene.contact });
    let (current, initial) = (of(Geometry::Current), of(Geometry::Initial));
    let peak = |outcome: &Outcome| outcome.contact[0].pressure;
    assert_near("peak", peak(&current), peak(&initial), peak(&initial), &CURRENT_LENGTHS);
}

#[test]
fn the_reference_is_at_no_distance_from_itself() {
    for embedded in SCENES {
        let scene = Scene::open(embedded.name).unwrap();
        let converged = reference(&scene, &Reading::default()).unwrap();
        let same = distance(&scene, &converged, &converged);
        assert_eq!((same.displacement, same.energy_relative), (0.0, 0.0));
    }
}

/// Two unit squares, the upper one on the lower one; `load` on the top edge, `held` of the upper square's left side.
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

fn outcome(scene: &serde_json::Value) -> Result<Outcome, Error> {
    run(
        &build(scene).expect("the scene is sound"),
        Variant::Unilateral,
        &Reading::default(),
        |_| (),
    )
}

#[test]
fn a_stack_is_shortened_by_its_load() {
    let outcome = outcome(&stacked([0.0, -1.0], &["x"], json!(0))).unwrap();
    assert_near("top", outcome.u[15], -2e-3, 2e-3, &BALANCE);
}

#[test]
fn a_body_that_may_slide_is_the_inputs_fault() {
    let error = outcome(&stacked([0.0, -1.0], &[], json!(0))).unwrap_err();
    assert_eq!(error.exit_status(), 2);
    assert!(error.to_string().contains("can move in x"), "{error}");
    assert!(
        outcome(&stacked([0.0, -1.0], &[], json!("stick"))).is_ok(),
        "where it sticks it is held"
    );
}

#[test]
fn a_body_that_is_pulled_away_is_the_inputs_fault() {
    let error = outcome(&stacked([0.0, 1.0], &["x"], json!(0))).unwrap_err();
    assert_eq!(error.exit_status(), 2);
    assert!(error.to_string().contains("no contact state is in equilibrium"), "{error}");
}

#[test]
fn a_contact_node_held_along_the_normal_is_the_inputs_fault() {
    let error = outcome(&stacked([0.0, -1.0], &["x", "y"], json!(0))).unwrap_err();
    assert_eq!(error.exit_status(), 2);
    assert!(error.to_string().contains("contact node 5 is restrained along the normal"), "{error}");
}

#[test]
fn friction_is_0_or_stick() {
    let error = build(&stacked([0.0, -1.0], &["x"], json!(0.3))).unwrap_err();
    assert!(error.to_string().contains("friction 0.3 is neither 0 nor \"stick\""), "{error}");
}
