//! The forms that a scene may take. What is refused stands in `tests/cases/mistakes.txt`.

use std::sync::Arc;

use crate::common::embedded::scene_json;
use crate::common::json::build;
use plane_contact::engine::linear::{Arithmetic, ScalarName};
use plane_contact::engine::{Request, solve};
use plane_contact::paper::door;
use plane_contact::paper::mirror::Worksheet;
use plane_contact::problem::model::{NodeId, TriangleId};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{Materials, Scene};
use serde_json::{Value, json};

/// The paper's tables of a scene.
fn sheet(scene: &Scene) -> Worksheet<f64> {
    door::worksheet(&scene.model, |x| x)
}

/// The model of a request is the scene's own, not a copy, unless something changes it.
#[test]
fn the_model_of_a_request() {
    let scene = Scene::open("fig1").expect("embedded");
    let own = |request: &Request| {
        Arc::ptr_eq(&request.model().expect("the request is sound"), &scene.model)
    };
    let request = Request::new(&scene);
    let of = |variant| request.clone().variant(variant);
    assert!(Variant::ALL.iter().all(|variant| own(&of(*variant))));
    let mut finer = request.clone();
    finer.tolerance = Some(1e-5);
    assert!(!own(&finer));
    assert_eq!(finer.model().unwrap().contact.tolerance, 1e-5);
    for (reading, expected) in [("R6=stress", false), ("R8=m", false), ("R3=nested", true)] {
        assert_eq!(own(&request.clone().reading(reading.parse().unwrap())), expected, "{reading}");
    }
    let mut backwards = scene_json("fig1");
    backwards["contact"]["cnt"].as_array_mut().expect("a list").reverse();
    let turned = Request::new(&build(&backwards).expect("a sound scene"));
    let contact = |variant| turned.clone().variant(variant).model().unwrap().contact.clone();
    let listed: Vec<NodeId> = scene.model.contact.nodes.iter().rev().copied().collect();
    assert_eq!(contact(Variant::Tied).nodes, listed);
    assert_eq!(contact(Variant::Unilateral), of(Variant::Unilateral).model().unwrap().contact);
}

/// What lies beside the side between any two nodes, against a look at every triangle.
#[test]
fn sides() {
    for name in ["fig1", "two-blocks"] {
        let model = &*Scene::open(name).expect("embedded").model;
        for (a, b) in model.node_ids().flat_map(|a| model.node_ids().map(move |b| (a, b))) {
            let has = |id: &TriangleId| {
                a != b && [a, b].iter().all(|node| model.triangle(*id).nodes.contains(node))
            };
            let expected: Vec<TriangleId> = model.triangle_ids().filter(has).collect();
            let beside = model.sides.beside([a, b]);
            let triangles: Vec<TriangleId> = beside.iter().map(|one| one.triangle).collect();
            assert_eq!(triangles, expected, "{name}: {a}, {b}");
            for one in beside {
                // The three nodes go round the triangle as it lists them.
                let [from, to] = one.nodes;
                let nodes = model.triangle(one.triangle).nodes;
                let turned = [[from, to, one.third], [to, one.third, from], [one.third, from, to]];
                assert!(turned.contains(&nodes), "{name}: {a}, {b}");
            }
            let boundary = if let [one] = beside { Some(*one) } else { None };
            assert_eq!(model.sides.boundary([a, b]), boundary, "{name}: {a}, {b}");
        }
        let none = NodeId::new(model.nodes.len());
        assert!(model.sides.beside([none, NodeId::new(0)]).is_empty());
    }
}

/// Those of a scene file are looked at before; these are read by themselves.
#[test]
fn materials_that_are_no_object() {
    let error = serde_json::from_value::<Materials>(json!([])).unwrap_err().to_string();
    let expected = r#"an object whose keys are physical groups, such as {"block": {"E": 3e4, "#;
    assert!(error.contains(expected), "{error}");
}

/// A node in no triangle is dropped where the scene says so: all others keep their numbers and their
/// displacements.
#[test]
fn orphans() {
    let add = |s: &mut Value| {
        let nodes = s["node"].as_array_mut().unwrap();
        for row in nodes.iter_mut().filter(|row| row[0].as_u64().unwrap() > 4) {
            row[0] = json!(row[0].as_u64().unwrap() + 1);
        }
        nodes.insert(4, json!([5, 9.0, 9.0, 0.0]));
        for row in s["elem"].as_array_mut().unwrap() {
            for n in &mut row.as_array_mut().unwrap()[5..] {
                *n = json!(n.as_u64().unwrap() + u64::from(n.as_u64().unwrap() > 4));
            }
        }
        s["contact"]["cnt"] = json!([6, 7, 8, 9, 10]);
        s["restraints"][1]["node"] = json!(14);
        s["restraints"][2]["node"] = json!(13);
    };
    let mut scene = scene_json("fig1");
    add(&mut scene);
    scene["drop_orphans"] = json!(true);
    let dropped = build(&scene).expect("the orphan is dropped");
    assert_eq!(dropped.model.dropped, [NodeId::from_number(5)]);
    let original = build(&scene_json("fig1")).unwrap();
    let exact = Arithmetic { scalar: ScalarName::Exact, ..Arithmetic::default() };
    for variant in Variant::ALL {
        let [u, without] = [&dropped, &original].map(|scene| {
            let request = Request::new(scene).variant(*variant);
            let request = match variant {
                Variant::Unilateral => request,
                _ => request.arithmetic(exact),
            };
            solve(&request, &mut |_| ()).expect("fig1 is solved").u
        });
        assert_eq!((u[8], u[9]), (0.0, 0.0), "{variant}");
        assert_eq!(u.remove_rows(8, 2), without, "{variant}");
    }
}

/// Pressure pushes into the body whatever way the edge runs; thickness multiplies load and
/// stiffness.
#[test]
fn loads_are_consistent_and_pressure_pushes_inwards() {
    let mut scene = scene_json("fig1");
    let before = build(&scene).unwrap();
    assert_eq!(before.model.total_load(), [0.0, -6.3 * 2.5]);
    assert_eq!((before.model.load[23], before.model.load[25]), (-7.875, -7.875));
    scene["elem"][7] = json!([8, 1, 2, 21, 21, 13, 12]);
    assert_eq!(build(&scene).unwrap().model.load, before.model.load);
    scene["thickness"] = json!(2.0);
    scene["loads"] =
        json!([{ "on": 21, "traction": [0.5, -1.0] }, { "node": 1, "force": [3.0, 4.0] }]);
    assert_eq!(build(&scene).unwrap().model.total_load(), [2.5 + 3.0, -5.0 + 4.0]);
}

/// A group, its tag as a number or as text, and the list of its members say the same.
#[test]
fn names_tags_and_lists_are_one() {
    let by_list = build(&scene_json("fig1")).unwrap();
    let mut scene = scene_json("fig1");
    scene["contact"]["cnt"] = json!(20);
    scene["contact"]["trg"] = json!("10");
    assert_eq!(sheet(&build(&scene).unwrap()), sheet(&by_list));
}

/// R8: c_tol in metres is 1,000 times as much in a scene in mm, 100 times in one in cm.
#[test]
fn r8_multiplies_the_tolerance_by_the_units_of_a_metre() {
    let under = |unit: &str| {
        let mut scene = scene_json("fig1");
        scene["units"]["length"] = json!(unit);
        Request::new(&build(&scene).unwrap()).reading("R8=m".parse().unwrap()).model()
    };
    for (unit, expected) in [("m", 0.001), ("cm", 0.1), ("mm", 1.0), ("", 1.0), ("um", 1000.0)] {
        let model = under(unit).expect("a unit that is known");
        assert_eq!(door::worksheet(&model, |x| x).c_tll, expected, "{unit}");
    }
}
