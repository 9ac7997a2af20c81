//! The plan of a run: counts are exact, nothing that could be left out is passed over.

use crate::common::embedded::scene_json;
use crate::common::json::build;
use plane_contact::engine::linear::{Arithmetic, Solver};
use plane_contact::engine::plan::{Idle, Plan, Storage};
use plane_contact::engine::{Request, solve};
use plane_contact::output::plan::line;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
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
    assert_eq!((blocks.edges, blocks.pairs, blocks.near), (2, 4, 3));
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
fn dense_and_sparse_are_told_apart() {
    let strand = Scene::open("strand").unwrap();
    let storage = |variant, solver| plan_of(&strand, variant, Some(solver)).storage;
    assert_eq!(storage(Variant::Tied, Solver::DenseLu), Storage::Dense);
    assert_eq!(storage(Variant::Tied, Solver::SparseLu), Storage::Dense, "of T' K T");
    assert_eq!(storage(Variant::Tied, Solver::SparseCholesky), Storage::Sparse);
    assert_eq!(storage(Variant::Printed, Solver::SparseLu), Storage::Sparse);
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

#[test]
fn the_line_says_what_is_planned() {
    let text = line(&plan("fig1", Variant::Stepped));
    let expected = "plan: 20 free equations of 26, 8 contact candidates of 15, \
                    sparse-cholesky in f64";
    assert_eq!(text, expected);
}
