//! The iterations that the page of a lesson makes (JavaScript, run by node) are the engine's: `printed`, `tied`
//! and `stepped` find the same contact nodes in every iteration, and so do the corrected programs.

use std::collections::HashSet;
use std::path::Path;
use std::process::Command;

use nalgebra::DVector;
use plane_contact::engine::estimates::{Perturbed, When, perturbed};
use plane_contact::engine::{Request, Solution, Step, solve};
use plane_contact::mathcad::{Settings, unsupported};
use plane_contact::output::page::INTERPRETER;
use plane_contact::paper::corrected::{Bound, Program, STEPS, Worksheet, program};
use plane_contact::paper::listings::Which;
use plane_contact::problem::model::NodeId;
use plane_contact::problem::modelling::{ContactModel, Coupling, Geometry, StatusRule, Variant};
use plane_contact::problem::scene::Scene;
use plane_contact::studies::audit::{Case, prices};
use plane_contact::studies::lesson::page as lesson;
use plane_contact::studies::lesson::{Repairs, Switch};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::tolerances::assert_near;
use crate::common::tools::has_node;
use testing::bodies::Writing;
use testing::drawn::scenes;

testing::tolerances! {
    /// Displacements of the page's iterations beside the engine's, relative to the largest.
    PAGE_ITERATIONS = 1e-9,
        "two factorisations of up to 200 equations in f64, and a shape from which the coordinates are taken off \
         again: 1e-12; the issue's own number";
}

/// The number of random scenes.
const DRAWN: usize = 40;

/// Scenes on which rounding decides nothing that a listing asks.
const NAMED: [&str; 6] =
    ["fig1", "two-blocks", "findings/C6", "findings/K5", "findings/K6", "findings/K9"];

/// The scenes, the random ones last.
fn small() -> Vec<Scene> {
    let drawn = scenes(46, DRAWN).map(|drawn| {
        let scene = drawn.bodies.scene(&Writing::default(), Coupling::Nts, Geometry::Initial);
        scene.build().unwrap()
    });
    NAMED.into_iter().map(|name| Scene::open(name).unwrap()).chain(drawn).collect()
}

/// The number of iterations before the first whose contact the last digit decides.
fn certain(scene: &Scene, variant: Variant) -> usize {
    let mut request = Request::new(scene).variant(variant);
    request.iterations = STEPS;
    let Ok(solution) = solve(&request, &mut |_| ()) else { return 0 };
    match perturbed(&solution).expect("it is rounded") {
        Perturbed { contact: Some(change), .. } => match change.when {
            When::Iteration(k) => k - 1,
            When::Load(_) => unreachable!("a variant of the paper"),
        },
        Perturbed { failures, .. } if !failures.is_empty() => 0,
        Perturbed { .. } => STEPS,
    }
}

/// The contact nodes in contact and the displacements after an iteration.
type State = (Vec<NodeId>, DVector<f64>);

/// The iterations of a variant of the paper under the print's own contact model: an iteration's displacements are those
/// from which the next starts.
fn states(scene: &Scene, variant: Variant) -> Vec<State> {
    let (coupling, status) = (Coupling::Nts, StatusRule::Signs);
    let contact = ContactModel { coupling, status, ..scene.contact };
    let mut request = Request::new(scene).variant(variant).contact(contact);
    request.iterations = STEPS;
    let Ok(Solution { model, steps, u, .. }) = solve(&request, &mut |_| ()) else { return vec![] };
    let from = |shape: &[[f64; 2]]| {
        let moved = shape.iter().zip(&model.nodes);
        DVector::from_vec(moved.flat_map(|(x, at)| [0, 1].map(|d| x[d] - at[d])).collect())
    };
    let after = steps.iter().skip(1).map(|next| from(&next.shape)).chain([u]);
    let in_contact = |step: &Step| {
        let mut nodes = step.contact_set(&model);
        let mut seen = HashSet::new();
        nodes.retain(|node| seen.insert(*node));
        nodes
    };
    steps.iter().map(in_contact).zip(after).collect()
}

/// The engine's iterations of the variants of the paper, on a random scene as far as rounding decides nothing.
fn engine(scene: &Scene, is_drawn: bool) -> Vec<(&'static str, Vec<State>)> {
    let published = Variant::OF_THE_PAPER.iter().map(|variant| {
        let states = states(scene, *variant);
        let count = if is_drawn { certain(scene, *variant) } else { states.len() };
        (variant.name(), states.into_iter().take(count).collect())
    });
    published.collect()
}

/// The engine's iterations of the corrected programs, with faults put back.
fn corrected(scene: &Scene, edits: &[&str]) -> Vec<State> {
    let after = |steps: usize| {
        let ending = Worksheet::new(&scene.model, Bound::Normal).iterate(edits, steps).ok()?;
        let nodes = ending.in_contact.into_iter().map(|(node, _)| node).collect();
        (ending.iterations == steps).then(|| (nodes, DVector::from_vec(ending.u)))
    };
    (1..=STEPS).map_while(after).collect()
}

/// What the page has of a scene, and of the corrected programs with some faults put back, then with others.
fn given(scene: &Scene, edits: &[Vec<&str>]) -> Value {
    let switch = Switch::as_printed();
    let texts = |which: Which| switch.listing(which).to_string();
    let programs = |edits: &Vec<&str>| -> Value {
        let programs = Program::ALL.iter();
        programs.map(|own| (own.name(), program(*own, edits).to_string())).collect()
    };
    json!({
        "mesh": lesson::mesh(&scene.model),
        "plane": scene.model.plane,
        "settings": switch.settings(),
        "readsRestraintOfY": switch.reads_restraint_of_y(),
        "c_tll": scene.model.contact.tolerance,
        "c_cnt": texts(Which::CCnt),
        "Km": texts(Which::Km),
        "corrected": edits.iter().map(programs).collect::<Vec<_>>(),
    })
}

/// The iterations that the page makes of each of the scenes given.
fn made(scenes: &[Value]) -> Value {
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("given.json");
    let script = [&INTERPRETER[..], &lesson::ITERATE].concat().join("\n");
    let given = json!({
        "script": script,
        "data": { "known": { "functions": unsupported::FUNCTIONS, "units": unsupported::UNITS } },
        "settings": Settings::default(),
        "scenes": scenes,
    });
    std::fs::write(&file, given.to_string()).expect("a file");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/contact/page_iterations.cjs");
    let output = Command::new("node").arg(script).arg(&file).output().expect("node starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Compares the page's iterations with the engine's; returns how many there are of these.
fn compare(what: &str, page: &Value, states: &[State]) -> usize {
    let own = page["states"].as_array().expect("states");
    assert!(own.len() >= states.len(), "{what}: {}", page["failure"]);
    let size = states.iter().map(|(_, u)| u.amax()).fold(0.0, f64::max);
    for (own, (nodes, u)) in own.iter().zip(states) {
        assert_eq!(own["inContact"], json!(nodes), "{what}");
        let theirs: Vec<f64> = serde_json::from_value(own["u"].clone()).expect("numbers");
        let difference = (DVector::from_vec(theirs) - u).amax();
        assert_near(what, difference, 0.0, size, &PAGE_ITERATIONS);
    }
    states.len()
}

#[test]
fn the_page_s_iterations_are_the_engine_s() {
    if !has_node() {
        eprintln!("node is not installed: the page's iterations are not made");
        return;
    }
    let scenes = small();
    let page = made(&scenes.iter().map(|scene| given(scene, &[vec![]])).collect::<Vec<_>>());
    let mut compared = 0;
    for (k, scene) in scenes.iter().enumerate() {
        let what = |variant: &str| format!("scene {k} ({}), {variant}", scene.name);
        for (variant, states) in engine(scene, k >= NAMED.len()) {
            compared += compare(&what(variant), &page[k][variant], &states);
        }
        compared += compare(&what("corrected"), &page[k]["corrected"][0], &corrected(scene, &[]));
    }
    println!("{compared} iterations are the same");
    assert!(compared > 10 * DRAWN, "{compared}");
}

/// With the faults that are left after each repair too.
#[test]
fn the_page_s_iterations_are_the_engine_s_repair_by_repair() {
    if !has_node() {
        return;
    }
    for (name, needed) in [("fig1", 7), ("two-blocks", 2)] {
        let scene = Scene::open(name).unwrap();
        let case = Case::new(scene.clone());
        let alone = prices::on(&case, &|| ()).unwrap();
        let (repairs, _) = Repairs::new(&case, &alone).expect("the repairs lead to the solution");
        assert_eq!(repairs.needed, needed);
        let left = |k: usize| repairs.left(k).map(|fault| fault.edit).collect();
        let edits: Vec<Vec<&str>> = repairs.shown().map(left).collect();
        assert_eq!(edits.len(), needed + 2, "the last is the corrected algorithm itself");
        let page = &made(&[given(&scene, &edits)])[0]["corrected"];
        for (k, edits) in edits.iter().enumerate() {
            let compared =
                compare(&format!("{name}, row {k}"), &page[k], &corrected(&scene, edits));
            assert!(compared > 0, "{name}, row {k}");
        }
    }
}
