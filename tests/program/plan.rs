//! The plan of a run: counts are exact, estimates grow with what is asked, nothing that could be
//! left out is passed over.

use crate::common::embedded::scene_json;
use crate::common::json::build;
use crate::common::program;
use plane_contact::engine::{Request, solve};
use plane_contact::memory;
use plane_contact::numbers::solve::{Arithmetic, Solver};
use plane_contact::problem::modelling::{ContactModel, Friction, Variant};
use plane_contact::problem::scene::Scene;
use plane_contact::report::plan::line;
use plane_contact::studies::plan::{Idle, Plan, Storage};
use serde_json::json;

fn plan_of(scene: &Scene, variant: Variant, solver: Option<Solver>) -> Plan {
    let arithmetic = Arithmetic { solver, ..Arithmetic::default() };
    let request = Request::new(scene).variant(variant).arithmetic(arithmetic);
    Plan::new(&request).expect("the scene is sound")
}

fn plan(scene: &str, variant: Variant) -> Plan {
    plan_of(&Scene::open(scene).expect("embedded"), variant, None)
}

#[test]
fn equations_are_counted() {
    for (name, variant, all, restrained, solved) in [
        ("two-blocks", Variant::Tied, 36, 15, 21),
        ("fig1", Variant::Stepped, 26, 6, 20),
        ("fig1", Variant::Printed, 26, 6, 26),
        ("strand", Variant::Stepped, 2222, 69, 2153),
    ] {
        let equations = plan(name, variant).equations;
        let counted = (equations.all, equations.restrained, equations.free, equations.solved);
        assert_eq!(counted, (all, restrained, all - restrained, solved), "{name}");
    }
}

/// fig1: x = 0.3 and 2.8 lie within half an edge of one edge, 1.2, 1.7 and 2.3 of two. two-blocks:
/// an end node meets one edge, the middle one two.
#[test]
fn candidates_are_those_whose_boxes_overlap() {
    let fig1 = plan("fig1", Variant::Stepped).contact.expect("fig1 has contact").candidates;
    assert_eq!((fig1.nodes, fig1.edges, fig1.pairs, fig1.near), (5, 3, 8, 5));
    let blocks = plan("two-blocks", Variant::Tied).contact.expect("they touch").candidates;
    assert_eq!((blocks.edges, blocks.pairs, blocks.near, blocks.touching), (2, 4, 3, 3));
    let strand = plan("strand", Variant::Stepped).contact.expect("strand has contact").candidates;
    assert_eq!((strand.nodes, strand.edges), (55, 78));
    assert_eq!((strand.pairs, strand.near), (110, 55));
}

#[test]
fn a_body_far_away_has_no_candidate() {
    let mut far = scene_json("two-blocks");
    for node in far["node"].as_array_mut().unwrap().iter_mut().skip(9) {
        let y = node[2].as_f64().unwrap();
        node[2] = json!(y + 10.0);
    }
    let plan = plan_of(&build(&far).unwrap(), Variant::Tied, None);
    assert_eq!(plan.contact.unwrap().candidates.pairs, 0);
}

#[test]
fn estimates_grow_with_what_is_asked() {
    let [small, middle, large] = ["two-blocks", "fig1", "strand"].map(|s| plan(s, Variant::Tied));
    assert!(large.cost.bytes.total() > middle.cost.bytes.total().max(small.cost.bytes.total()));
    assert!(large.cost.operations > middle.cost.operations.max(small.cost.operations));
    let strand = Scene::open("strand").unwrap();
    let by = |solver| plan_of(&strand, Variant::Tied, Some(solver));
    let [lu, sparse] = [Solver::DenseLu, Solver::SparseCholesky].map(by);
    assert_eq!([lu.storage, sparse.storage].map(|s| s == Storage::Dense), [true, false]);
    assert!(lu.cost.bytes.total() > sparse.cost.bytes.total());
    assert!(lu.cost.operations > sparse.cost.operations);
}

/// Megabytes of whole processes, files included, on 2 cores: the estimate is no less, and at most twice as
/// much.
#[test]
fn the_memory_that_was_measured_is_planned() {
    let folder = tempfile::tempdir().unwrap();
    let plan = |mesh: &str, variant: Variant, friction: Friction| {
        let scene = if mesh == "strand" {
            Scene::open(mesh).unwrap()
        } else {
            let words = format!("scene mesh {mesh} --out mesh");
            let words: Vec<&str> = words.split(' ').collect();
            assert!(program::run(folder.path(), &words).status.success());
            Scene::open(folder.path().join("mesh/scene.json").to_str().unwrap()).unwrap()
        };
        let request = Request::new(&scene).variant(variant);
        let contact = ContactModel { friction, ..request.contact };
        Plan::new(&request.contact(contact)).unwrap().cost.bytes.total() / 1e6
    };
    for (mesh, variant, friction, measured) in [
        ("strand", Variant::Unilateral, Friction::STICK, 30.3),
        ("strand", Variant::Tied, Friction::STICK, 30.0),
        ("strand", Variant::Printed, Friction::STICK, 32.4),
        ("hertz --size 59", Variant::Unilateral, Friction::NONE, 86.4),
        ("hertz --size 59", Variant::Unilateral, Friction::new(0.2).unwrap(), 190.0),
        ("hertz --size 59", Variant::Tied, Friction::NONE, 139.0),
        ("hertz --size 59", Variant::Stepped, Friction::NONE, 167.0),
        ("hertz --size 59", Variant::Printed, Friction::NONE, 186.0),
        ("hertz --size 116", Variant::Unilateral, Friction::NONE, 299.0),
        ("hertz --size 116", Variant::Tied, Friction::NONE, 482.0),
        ("hertz --size 116", Variant::Stepped, Friction::NONE, 585.0),
        ("blocks --upper 240 --lower 246", Variant::Unilateral, Friction::NONE, 300.0),
        ("blocks --upper 240 --lower 246", Variant::Tied, Friction::NONE, 401.0),
        ("cook --n 120", Variant::Printed, Friction::NONE, 325.0),
        ("cook --n 230", Variant::Tied, Friction::NONE, 352.0),
    ] {
        let over = plan(mesh, variant, friction) / measured;
        assert!((1.0..2.0).contains(&over), "{mesh} {variant} {friction}: {over}");
    }
}

#[test]
fn a_dense_run_is_refused_by_its_estimate_and_a_sparse_one_is_not() {
    let strand = Scene::open("strand").unwrap();
    let dense = plan_of(&strand, Variant::Stepped, Some(Solver::DenseLu));
    let needed = memory::needed(dense.nodes, dense.cost.dense_matrices);
    assert!(dense.check_memory(Some(needed)).is_ok());
    assert!(dense.check_memory(Some(needed - 1)).is_err());
    let sparse = plan_of(&strand, Variant::Stepped, None);
    let own = dense.cost.bytes.matrices - sparse.cost.bytes.matrices;
    assert!(needed as f64 >= own, "what is refused is what is estimated");
    assert!(sparse.check_memory(Some(0)).is_ok());
}

#[test]
fn strand_is_symmetric_and_fig1_is_not() {
    let strand = plan("strand", Variant::Stepped);
    let half = strand.half.expect("strand.msh is its own mirror image about x = 0");
    assert_eq!((half.at, half.nodes), (0.0, 571));
    assert!(plan("fig1", Variant::Stepped).half.is_none());
    assert!(plan("strand", Variant::Unilateral).half_would_do() && !strand.half_would_do());
}

/// Each of load, restraint and material, changed on one side, ends the symmetry.
#[test]
fn one_side_changed_is_no_symmetry() {
    let strand = scene_json("strand");
    let mut loaded = strand.clone();
    loaded["loads"].as_array_mut().unwrap().push(json!({ "on": "right", "traction": [0.0, 1.0] }));
    let mut held = strand.clone();
    held["restraints"].as_array_mut().unwrap().push(json!({ "on": "right", "fix": ["y"] }));
    let beside = |_: &str| Ok(include_bytes!("../../golden/strand/strand.msh")[..].into());
    let symmetric = |scene: &serde_json::Value| {
        let scene = Scene::build("strand", scene.to_string().as_bytes(), beside).unwrap();
        plan_of(&scene, Variant::Tied, None).half.is_some()
    };
    assert_eq!([&strand, &loaded, &held].map(symmetric), [true, false, false]);
}

/// A third block, held and without load, beside the two of two-blocks.
#[test]
fn a_body_that_nothing_moves_is_found() {
    let mut scene = scene_json("two-blocks");
    let nodes = scene["node"].as_array_mut().unwrap();
    for (n, x, y) in [(19, 10.0, 0.0), (20, 11.0, 0.0), (21, 10.0, 1.0)] {
        nodes.push(json!([n, x, y, 0.0]));
    }
    let elements = scene["elem"].as_array_mut().unwrap();
    elements.push(json!([elements.len() + 1, 2, 2, 1, 1, 19, 20, 21]));
    for node in [19, 20] {
        scene["restraints"]
            .as_array_mut()
            .unwrap()
            .push(json!({ "node": node, "fix": ["x", "y"] }));
    }
    let scene = build(&scene).unwrap();
    let plan = plan_of(&scene, Variant::Tied, None);
    let idle: Vec<Option<Idle>> = plan.bodies.iter().map(|body| body.idle).collect();
    assert_eq!(idle, [None, None, Some(Idle::NoLoadNoContact)]);
    assert_eq!(plan.equations.idle, 2);
    let solution = solve(&Request::new(&scene).variant(Variant::Tied), &mut |_| ()).unwrap();
    assert!(solution.u.iter().skip(36).all(|u| *u == 0.0), "and it does not move");
}

#[test]
fn as_printed_no_load_reaches_the_block() {
    let plan = plan("strand", Variant::Printed);
    let idle: Vec<Option<Idle>> = plan.bodies.iter().map(|body| body.idle).collect();
    assert_eq!(idle, [Some(Idle::NotCoupled), None]);
}

/// The line of fig1: 274 operations for each of 5 states of the run and 3 of the reference solution.
#[test]
fn the_line_says_what_is_planned() {
    let text = line(&plan("fig1", Variant::Stepped));
    let expected = "plan: 20 free equations of 26, 8 contact candidates of 15, \
                    sparse-cholesky in f64; about 31 MB, 2.2e3 operations";
    assert_eq!(text, expected);
}
