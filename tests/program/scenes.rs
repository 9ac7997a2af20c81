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

<<<<<<< HEAD
/// A node in no triangle is dropped where the scene says so: all others keep their numbers and their
/// displacements.
=======
#[test]
fn text_that_is_no_scene() {
    let parse = |text: &str| {
        let error = Scene::build("test", text.as_bytes(), |_| Err("no".into()));
        error.expect_err("refused")
    };
    says(&parse("{"), "the scene file, line 1", &["the text ends within an object"]);
    says(&parse("[1]"), "the scene file", &["a list where an object is expected"]);
    let whole = scene_json("fig1").to_string();
    says(&parse(&(whole.clone() + "x")), "the end of the scene file", &["more follows"]);
    says(&parse(&whole.replacen("0.001", "1e999", 1)), "c_tll", &["number out of range"]);
    for (value, words) in [
        ("NaN", "NaN where a finite number is expected"),
        ("-Infinity", "-Infinity where a finite number is expected"),
        ("+1", "+1 where a value is expected"),
        ("None", "None where a value is expected"),
        ("null", "null where a number is expected"),
    ] {
        says(&parse(&whole.replacen("0.001", value, 1)), "field contact.c_tll, line 1", &[words]);
    }
    let two = r#"{"restraints":[{"on":"top","fix":[{"direction":[0,1],"displacement":1}]}]}"#;
    says(&parse(two), "restraints[0].fix[0]", &["a second field stands in an object of one"]);
    let twice = r#"{"plane":"strain","materials":{"1":{"E":1,"nu":0},"1":{"E":2,"nu":0}}}"#;
    says(&parse(twice), "materials", &["\"1\" is given twice"]);
}

#[test]
fn meshes() {
    let e = refused(|s| push(&mut s["elem"], json!([19, 2, 2, 1, 1, 1, 10, 99])));
    says(&e, "element 19", &["node number 99 is beyond R = 13"]);
    let e = refused(|s| s["node"][12][0] = json!(20.0));
    says(&e, "nodes", &["node number 20 is beyond R = 13"]);
    let e = refused(|s| s["node"][12][0] = json!(1.5));
    says(&e, "node[12]", &["1.5 is no node number"]);
    let e = refused(|s| s["node"][12][0] = json!(12.0));
    says(&e, "nodes", &["node 12 is given twice"]);
    let e = refused(|s| s["node"][12][3] = json!(1.0));
    says(
        &e,
        "nodes",
        &[
            "the mesh is not plane",
            "node 13 has z = 1",
            "a difference of 1 in a mesh of the size 3",
        ],
    );
    // Rounding of a rotation to the plane is none; the mesh is 3 wide.
    let rounded = |z: f64| {
        let mut scene = scene_json("fig1");
        (0..13).for_each(|k| scene["node"][k][3] = json!(5.0 + z * (k % 3) as f64));
        build(&scene)
    };
    rounded(1e-12).expect("a plane mesh at z = 5");
    says(
        &rounded(1e-11).expect_err("tilted"),
        "nodes",
        &["a difference of 2e-11 in a mesh of the size 3"],
    );
    let e = refused(|s| s["elem"][9] = json!([10, 2, 2, 1, 1, 1, 2, 10]));
    says(&e, "triangles", &["triangle 10 (nodes 1, 2, 10) runs clockwise", "area is -0.5"]);
    let e = refused(|s| s["node"][9] = json!([10, 2.0, 0.04, 0.0]));
    says(&e, "triangles", &["triangle 10 (nodes 1, 10, 2)", "area"]);
    assert_eq!(e.fix, "move or merge its nodes");
    for (factor, size) in [(1e160, "large"), (1e-170, "small")] {
        let e = refused(|s| {
            for node in s["node"].as_array_mut().unwrap() {
                (1..3).for_each(|k| node[k] = json!(node[k].as_f64().unwrap() * factor));
            }
        });
        says(&e, "triangles", &[&format!("has an area too {size} to represent")]);
        assert_eq!(e.fix, "choose other units");
    }
    let e = refused(|s| s["node"][1][1] = json!(-1e200));
    says(&e, "triangles", &["runs clockwise: its area is -", "e199"]);
    let e = refused(|s| push(&mut s["elem"], json!([19, 2, 2, 1, 1, 10, 2, 1])));
    says(&e, "elements", &["triangles 10 and 19 have the same nodes"]);
    let e = refused(|s| push(&mut s["elem"], json!([19, 1, 2, 1, 1, 2, 2])));
    says(&e, "elements", &["element 19 names node 2 twice"]);
    let e = refused(|s| push(&mut s["elem"], json!([18, 1, 2, 1, 1, 1, 2])));
    says(&e, "elements", &["element 18 is given twice"]);
    let e = refused(|s| push(&mut s["elem"], json!([1000000, 1, 2, 1, 1, 1, 2])));
    says(&e, "elements", &["element number 1000000 for 19 elements"]);
    let e = refused(|s| push(&mut s["elem"], json!([19, 3, 2, 1, 1, 1, 2, 3, 4])));
    says(&e, "elem[18]", &["type 3 is none of 15 (point), 1 (edge), 2 (triangle)"]);
    let e = refused(|s| push(&mut s["elem"], json!([19, 1, 3, 1, 1, 1, 2])));
    says(&e, "elem[18]", &["3 tags", "column 6"]);
    let e = refused(|s| push(&mut s["elem"], json!([19, 1, 2, 1, 1, 1])));
    says(&e, "elem[18]", &["type 1 has 2 nodes, not 1"]);
    let e = refused(|s| push(&mut s["elem"], json!([19, 1])));
    says(&e, "elem[18]", &["2 entries are too few"]);
    let e = refused(|s| s["elem"].as_array_mut().unwrap().truncate(9));
    says(&e, "elements", &["no triangle"]);
    let e = refused(|s| s["mesh"] = json!("strand.msh"));
    says(&e, "mesh, node, elem", &["either mesh, or node and elem"]);
}

#[test]
fn materials() {
    let e = refused(|s| s["materials"]["1"]["nu"] = json!(0.5));
    says(&e, "materials.1.nu", &["nu = 0.5 is outside (-1, 0.5) in plane strain"]);
    let e = refused(|s| {
        s["plane"] = json!("stress");
        s["materials"]["1"]["nu"] = json!(-1.0);
    });
    says(&e, "materials.1.nu", &["nu = -1 is outside (-1, 1) in plane stress"]);
    let e = refused(|s| s["materials"]["2"]["E"] = json!(0.0));
    says(&e, "materials.2.E", &["E = 0 is not positive"]);
    let e = refused(|s| drop(s["materials"].as_object_mut().unwrap().remove("2")));
    says(&e, "materials", &["triangle 14 has no material"]);
    let e = refused(|s| s["materials"]["3"] = json!({ "E": 1.0, "nu": 0.0 }));
    says(&e, "materials.3", &["no physical group \"3\" of triangles"]);
    assert!(e.fix.contains("the mesh's groups of triangles are 1, 2"), "{e}");
    let mut stress = scene_json("fig1");
    stress["plane"] = json!("stress");
    stress["materials"]["1"]["nu"] = json!(0.7);
    let scene = build(&stress).expect("0.7 is sound in plane stress");
    let e = Request::new(&scene).reading("R6=strain".parse().unwrap()).model();
    let e = e.expect_err("not in plane strain");
    says(&e, "reading R6", &["nu = 0.7 is outside (-1, 0.5) in plane strain"]);
}

#[test]
fn restraints_and_loads() {
    let e = refused(|s| s["restraints"][0]["on"] = json!("wall"));
    says(&e, "restraints[0].on", &["no physical group \"wall\""]);
    let e = refused(|s| s["restraints"][1]["node"] = json!(14));
    says(&e, "restraints[1].node", &["node number 14 is beyond R = 13"]);
    let e = refused(|s| s["restraints"][1]["on"] = json!(11));
    says(&e, "restraints[1]", &["{on, fix}, {node, fix} or {at, fix}"]);
    let e = refused(|s| push(&mut s["loads"], json!({ "on": 21 })));
    says(
        &e,
        "loads[1]",
        &["a load has either on and pressure, on and traction, node and force, or on, rho and g"],
    );
    let e = refused(|s| {
        push(&mut s["loads"], json!({ "on": 21, "pressure": 1.0, "traction": [0.0, 1.0] }))
    });
    says(
        &e,
        "loads[1]",
        &["a load has either on and pressure, on and traction, node and force, or on, rho and g"],
    );
    let e = refused(|s| push(&mut s["loads"], json!({ "node": 0, "force": [0.0, 1.0] })));
    says(&e, "loads[1]", &["there is no node number 0"]);
    let e = refused(|s| {
        push(&mut s["elem"], json!([19, 1, 2, 50, 1, 2, 10]));
        push(&mut s["loads"], json!({ "on": 50, "pressure": 1.0 }));
    });
    says(&e, "loads[1]", &["edge 19 (nodes 2 and 10) bounds 2 triangles"]);
    let e = refused(|s| {
        push(&mut s["elem"], json!([19, 1, 2, 50, 1, 1, 5]));
        push(&mut s["loads"], json!({ "on": 50, "pressure": 1.0 }));
    });
    says(&e, "loads[1]", &["bounds 0 triangles"]);
    let e = refused(|s| s["thickness"] = json!(0.0));
    says(&e, "thickness", &["0 is not positive"]);
    let e = refused(|s| s["iterations"] = json!(0));
    says(&e, "iterations", &["0 iterations"]);
    let e = refused(|s| s["iterations"] = json!(10_000_000));
    says(&e, "iterations", &["10000000 iterations are outside"]);
    let e = refused(|s| s["restraints"][1]["fix"] = json!([]));
    says(&e, "restraints[1].fix", &["fixes no direction"]);
    let e = refused(|s| push(&mut s["elem"], json!([19, 1, 2, 21, 21, 13, 12])));
    says(&e, "loads[0]", &["edges 8 and 19 of group 21 are the same"]);
    let e = refused(|s| s["loads"][0]["pressure"] = json!(1.5e308));
    says(&e, "loads[0]", &["too large"]);
}

/// Two triangles on one side of an edge, a third at an edge, one of other nodes that shares no edge, and one of
/// nodes of its own but one: each counts the stiffness of a place twice. Bodies may lie inside each other.
#[test]
fn triangles_of_one_body_that_lie_over_each_other() {
    for (nodes, pair) in [([1, 10, 11], [10, 19]), ([1, 11, 4], [11, 19]), ([6, 13, 12], [15, 19])]
    {
        let e = refused(|s| {
            let [a, b, c] = nodes;
            push(&mut s["elem"], json!([19, 2, 2, 1, 1, a, b, c]));
        });
        says(&e, "the mesh's triangles", &["lie over each other", "and 19"]);
        assert!(pair.iter().any(|number| e.what.contains(&number.to_string())), "{e}");
    }
    let e = refused(|s| {
        push(&mut s["node"], json!([14, 0.9, -0.9, 0.0]));
        push(&mut s["node"], json!([15, 0.9, -0.8, 0.0]));
        push(&mut s["elem"], json!([19, 2, 2, 1, 1, 10, 14, 15]));
        for n in [14, 15] {
            push(&mut s["restraints"], json!({ "node": n, "fix": ["x", "y"] }));
        }
    });
    says(&e, "the mesh's triangles", &["triangles 11 and 19"]);
    let mut scene = scene_json("fig1");
    for n in 4..9 {
        let y = scene["node"][n][2].as_f64().expect("a number") - 0.01;
        scene["node"][n][2] = json!(y);
    }
    assert!(build(&scene).is_ok(), "the stamp lies 0.01 inside the base");
}

/// What passes nothing on, though it looks joined, is said: a crack may be meant. Triangles of bodies without
/// contact between them are refused where they lie over each other.
#[test]
fn slits_are_named() {
    let changed = |change: fn(&mut Value)| {
        let mut scene = scene_json("fig1");
        change(&mut scene);
        build(&scene).map(|scene| scene.adapted().to_vec())
    };
    assert_eq!(changed(|_| ()), Ok(vec![]));
    // Node 14 divides the side of triangle 10 between nodes 2 and 10, which its neighbour has.
    let hanging = changed(|s| {
        let [a, b] = [1, 9].map(|k| s["node"][k].clone());
        let mean = |k: usize| (a[k].as_f64().unwrap() + b[k].as_f64().unwrap()) / 2.0;
        push(&mut s["node"], json!([14, mean(1), mean(2), 0.0]));
        let triangles = s["elem"].as_array_mut().expect("a list");
        let at = triangles.iter().position(|row| row[0] == 10).expect("a triangle");
        let mut row = triangles[at].as_array().expect("a row").clone();
        let nodes = row.split_off(5);
        let halves = [2, 10].map(|old| {
            let node = |n: &Value| if *n == json!(old) { json!(14) } else { n.clone() };
            [row.clone(), nodes.iter().map(node).collect()].concat()
        });
        let [first, mut second] = halves;
        second[0] = json!(19);
        triangles[at] = json!(first);
        triangles.push(json!(second));
    });
    let said = hanging.expect("a scene").concat();
    assert!(said.contains("node 14 is on the side between 2 and 10"), "{said}");
    let mut cut = scene_json("fig1");
    push(&mut cut["elem"], json!([19, 1, 2, 30, 30, 1, 3]));
    let finer = build(&cut).expect("a scene").refined().expect("a scene");
    assert_eq!(finer.scene.adapted().len(), 1, "{:?}", finer.scene.adapted());
    let loose =
        changed(|s| push(&mut s["elem"], json!([19, 1, 2, 30, 30, 1, 3]))).expect("a scene");
    assert!(
        loose[0].starts_with("Edge 19 of the mesh (nodes 1, 3) is a side of no triangle"),
        "{loose:?}"
    );
    let apart = changed(|s| {
        for (n, x, y) in [(14, 20.0, 0.0), (15, 21.0, 0.0), (16, 20.0, 1.0)] {
            push(&mut s["node"], json!([n, x, y, 0.0]));
            push(&mut s["node"], json!([n + 3, x, y, 0.0]));
        }
        s["node"].as_array_mut().unwrap().sort_by_key(|row| row[0].as_u64());
        for (k, n) in [(19, 14), (20, 17)] {
            push(&mut s["elem"], json!([k, 2, 2, 1, 1, n, n + 1, n + 2]));
            for n in n..n + 3 {
                push(&mut s["restraints"], json!({"node": n, "fix": ["x", "y"]}));
            }
        }
    });
    says(
        &apart.expect_err("an overlap"),
        "the mesh's triangles",
        &["triangles 19 and 20 lie over"],
    );
}

#[test]
fn contact() {
    let e = refused(|s| s["contact"]["cnt"] = json!([5, 6, 2]));
    says(&e, "contact", &["contact node 2 is also on the target edge 1"]);
    let e = refused(|s| s["contact"]["cnt"] = json!([5, 77]));
    says(&e, "contact.cnt", &["node number 77 is beyond R = 13"]);
    let e = refused(|s| s["contact"]["trg"] = json!([10]));
    says(&e, "contact.trg", &["elem 10 is no edge"]);
    let e = refused(|s| s["contact"]["trg"] = json!([]));
    says(&e, "contact.trg", &["the list is empty"]);
    let e = refused(|s| s["contact"]["trg"] = json!([1, 2, 1]));
    says(&e, "contact.trg", &["edge 1 is named twice"]);
    for (place, edge, words) in [
        ("trg", json!([19, 1, 2, 10, 10, 3, 2]), "edges 2 and 19 both join nodes 3 and 2"),
        ("cnt", json!([19, 1, 2, 20, 20, 8, 9]), "edges 7 and 19 both join nodes 8 and 9"),
    ] {
        let e = refused(|s| {
            push(&mut s["elem"], edge);
            s["contact"] = json!({ "cnt": 20, "trg": 10, "c_tll": 0.001 });
        });
        says(&e, &format!("contact.{place}"), &[words]);
    }
    let e = refused(|s| s["contact"]["c_tll"] = json!(-0.001));
    says(&e, "contact.c_tll", &["-0.001 is negative"]);
    let e = refused(|s| {
        push(&mut s["elem"], json!([19, 1, 2, 20, 20, 12, 13]));
        s["contact"]["cnt"] = json!(20);
    });
    says(&e, "contact.cnt", &["more than one chain"]);
}

#[test]
fn bodies_that_nothing_holds() {
    let free = |fix: Value| {
        refused(move |s| {
            s.as_object_mut().unwrap().remove("contact");
            s["restraints"] = json!([{ "on": 11, "fix": ["x", "y"] }]);
            if !fix.is_null() {
                push(&mut s["restraints"], fix);
            }
        })
    };
    says(
        &free(Value::Null),
        "restraints",
        &["body \"2\" is restrained by no contact", "move in x"],
    );
    says(&free(json!({ "node": 12, "fix": ["x"] })), "restraints", &["move in y"]);
    says(&free(json!({ "node": 12, "fix": ["x", "y"] })), "restraints", &["rotate"]);
    let e = refused(|s| s["restraints"] = json!([{ "on": 11, "fix": ["y"] }]));
    says(&e, "restraints", &["the bodies that contact joins can still move in x, all together"]);
    let mut held = scene_json("fig1");
    held.as_object_mut().unwrap().remove("contact");
    // Without contact no body may lie in the other.
    for n in 4..9 {
        held["node"][n][2] = json!(0.1);
    }
    push(&mut held["restraints"], json!({ "node": 12, "fix": ["x", "y"] }));
    push(&mut held["restraints"], json!({ "node": 9, "fix": ["y"] }));
    build(&held).expect("three restraints hold a body");
}

/// A node in no triangle is named, and dropped only where the scene says so: all others keep their
/// numbers and their displacements.
>>>>>>> h2
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
