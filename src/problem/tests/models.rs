//! What a scene is built into: bodies and how they are held, loads of edges, identifiers and boxes.

use nalgebra::DVector;
use problem::element::Plane;
use problem::model::{Bounds, Dof, EdgeId, Model, NodeId, TriangleId, freedom};
use problem::scene::{Axis, MeshBuilder, SceneBuilder};
use serde_json::json;
use testing::golden_file::assert_rows;
use testing::rows::scene_of;

/// Builds square blocks of the side 2, each of a material of the given name, side by side with
/// a gap; the nodes of block k are 4k + 1 to 4k + 4, counter-clockwise from the lower left one.
fn blocks(names: &[&str]) -> SceneBuilder {
    let mut mesh = MeshBuilder::default();
    for (k, name) in names.iter().enumerate() {
        let left = 3.0 * k as f64 + 1.0;
        let corners = [[left, 5.0], [left + 2.0, 5.0], [left + 2.0, 7.0], [left, 7.0]];
        let [a, b, c, d] = mesh.row(corners)[..] else { unreachable!("four corners") };
        mesh.triangles(*name, [[a, b, c], [a, c, d]]);
        mesh.edges(format!("bottom {k}"), &[a, b]);
        mesh.edges(format!("right {k}"), &[b, c]);
        mesh.edges(format!("top {k}"), &[d, c]);
    }
    let mut distinct = names.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    let scene = SceneBuilder::new("blocks", mesh.finish(), Plane::Stress);
    distinct.into_iter().fold(scene, |scene, name| scene.material(name, 1000.0, 0.25))
}

/// Fixes the lower side of the first `blocks` blocks.
fn held(scene: SceneBuilder, blocks: usize) -> SceneBuilder {
    (0..blocks).fold(scene, |s, k| s.restrain(format!("bottom {k}"), &[Axis::X, Axis::Y]))
}

#[test]
fn bodies_of_one_name_are_numbered() {
    let names = |of: &[&str]| -> Vec<String> {
        let scene = held(blocks(of), of.len()).build().expect("a sound scene");
        scene.model.bodies.iter().map(|body| body.name.clone()).collect()
    };
    assert_eq!(names(&["steel"]), ["steel"]);
    assert_eq!(names(&["steel", "brass"]), ["steel", "brass"]);
    assert_eq!(names(&["steel", "steel"]), ["steel 1", "steel 2"]);
    let three = ["steel", "brass", "steel", "brass", "steel"];
    assert_eq!(names(&three), ["steel 1", "brass 1", "steel 2", "brass 2", "steel 3"]);
}

#[test]
fn bodies_have_their_own_nodes_and_triangles() {
    let scene = held(blocks(&["a", "b"]), 2).build().expect("a sound scene");
    for (k, body) in scene.model.bodies.iter().enumerate() {
        assert_eq!(body.nodes, (4 * k..4 * k + 4).map(NodeId::new).collect::<Vec<_>>());
        assert_eq!(body.triangles, [2 * k, 2 * k + 1].map(TriangleId::new));
        for node in scene.model.node_ids() {
            assert_eq!(body.has(node), body.nodes.contains(&node), "{node}");
            assert_eq!(scene.model.body_of(node) == Some(body), body.has(node), "{node}");
        }
    }
    // Two materials that meet make one body, under both names.
    let mut mesh = MeshBuilder::default();
    let rows = [0.0, 1.0, 2.0].map(|y| mesh.row([0.0, 1.0].map(|x| [x, y])));
    mesh.join("soft", &rows[0], &rows[1]);
    mesh.join("hard", &rows[1], &rows[2]);
    mesh.edges("bottom", &rows[0]);
    let scene = SceneBuilder::new("layers", mesh.finish(), Plane::Stress)
        .material("hard", 2.0, 0.0)
        .material("soft", 1.0, 0.0)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .build()
        .expect("a sound scene");
    assert_eq!(scene.model.bodies.len(), 1);
    assert_eq!(scene.model.bodies[0].name, "soft+hard");
    assert!(scene.model.target().is_none() && !scene.model.has_contact());
}

/// The rows of `models/free.txt`: which directions of which nodes of a square are held, and what motion is left, whatever
/// its size and place.
#[test]
fn what_restraints_leave_free() {
    let square = held(blocks(&["a"]), 1).build().expect("sound").model;
    assert_rows("tests/models/free.txt", |row| {
        let mut model = Model::clone(&square);
        model.holds.release(model.all_dofs());
        for held in row.split(' ').filter(|held| *held != "-") {
            let [x, y] = NodeId::from_number(held[..1].parse().expect("a node")).dofs();
            model.holds.fix([if held.ends_with('x') { x } else { y }]);
        }
        let places = [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, -2.0), (1.0, 1e7)];
        let left = places.map(|(scale, shift)| {
            let mut moved = model.clone();
            moved.nodes = model.nodes.iter().map(|p| p.map(|x| scale * x + shift)).collect();
            let found = freedom(&moved, &moved.bodies[0].nodes, &[]).unwrap_or("nothing".into());
            found.split(" about").next().expect("a motion").to_owned()
        });
        assert!(left.iter().all(|motion| *motion == left[0]), "{row}: {left:?}");
        left[0].clone()
    });
}

/// Two restraints along y, `apart` on a body of the size √2, and one along x: turning has the
/// eigenvalue apart²/4, beside one of 2. A part of 1e-12 counts as none.
#[test]
fn restraints_beside_each_other_leave_a_body_free_to_turn() {
    let mut model = Model::clone(&held(blocks(&["a"]), 1).build().expect("sound").model);
    model.holds.release(model.all_dofs());
    model.holds.fix([0, 1, 3].map(Dof::new));
    let mut found = |apart: f64| {
        model.nodes = vec![[0.0, 0.0], [apart, 0.0], [1.0, 1.0], [-1.0, -1.0]];
        freedom(&model, &model.bodies[0].nodes, &[])
    };
    assert_eq!([2e-6, 4e-6].map(&mut found), [Some("rotate about 1e-6, 0".into()), None]);
}

/// The rows of `models/rows.txt`: the bodies of a scene, its loads by node, and their sums after each half of a stage.
#[test]
fn models_by_hand() {
    let answer = |row: &str| {
        let model = match scene_of("tests/models", row) {
            Ok(scene) => scene.model,
            Err(why) => return why.to_string(),
        };
        let names: Vec<_> = model.bodies.iter().map(|body| &*body.name).collect();
        let loaded = model.node_ids().map(|n| (n, n.components(&model.load)));
        let loaded = loaded.filter(|(_, load)| *load != [0.0; 2]);
        let loads = loaded.map(|(n, [x, y])| format!("{n}: {x} {y}")).collect::<Vec<_>>();
        let parts = (0..=2 * model.stages.len() + 1).map(|half| half as f64 / 2.0);
        let sums = parts.map(|part| model.load_after(part).sum()).collect::<Vec<_>>();
        let free = model.free_part(&model.load).sum();
        format!(
            "bodies {}; loads {}; in all {:?}, of free equations {free}; by half stages {sums:?}",
            names.join(", "),
            loads.join(", "),
            model.total_load()
        )
    };
    assert_rows("tests/models/rows.txt", answer);
}

/// In a scalar in which each number is twice as large: that is twice a force, and eight times what an edge of a body
/// carries.
#[test]
fn loads_in_a_scalar() {
    let loads =
        r#"{"on":12,"pressure":8.0},{"node":3,"force":[1.0,2.0]},{"on":10,"traction":[3.0,5.0]}"#;
    let scene = scene_of("tests/models", &format!("blocks /thickness=0.5 /loads=[{loads}]"));
    let load = scene.expect("sound").model.load_in(|x| 2.0 * x);
    let twice = [12.0, 20.0, 12.0, 20.0, 2.0, 4.0 - 32.0, 0.0, -32.0];
    assert_eq!(load.as_slice()[..8], twice);
}

#[test]
fn identifiers_count_from_0_and_numbers_from_1() {
    let node = NodeId::from_number(4);
    assert_eq!((node.index(), node.number(), node.to_string()), (3, 4, "4".to_owned()));
    assert_eq!(node.dofs(), [Dof::new(6), Dof::new(7)]);
    assert_eq!([node.x(), node.y()], node.dofs());
    for (dof, direction, axis) in [(6, 0, 'x'), (7, 1, 'y')] {
        let dof = Dof::new(dof);
        assert_eq!((dof.node(), dof.direction(), dof.axis()), (node, direction, axis));
    }
    let field = DVector::from_fn(10, |k, _| k as f64);
    assert_eq!(node.components(&field), [6.0, 7.0]);
    assert_eq!(EdgeId::all(3).map(EdgeId::index).collect::<Vec<_>>(), [0, 1, 2]);
    assert_eq!(serde_json::to_value(TriangleId::new(6)).expect("a number"), json!(7));
}

#[test]
fn boxes() {
    let bounds = Bounds::around(&[[1.0, 5.0], [4.0, 3.0], [2.0, 4.0]]);
    assert_eq!(bounds, Bounds { low: [1.0, 3.0], high: [4.0, 5.0] });
    assert_eq!((bounds.size(), bounds.larger_side()), ([3.0, 2.0], 3.0));
    assert_eq!(bounds.centre(), [2.5, 4.0]);
    assert_eq!(bounds.padded(0.5), Bounds { low: [0.5, 2.5], high: [4.5, 5.5] });
    for inside in [[1.0, 3.0], [4.0, 5.0], [2.0, 4.0]] {
        assert!(bounds.contains(inside), "{inside:?}");
    }
    for outside in [[0.9, 4.0], [4.1, 4.0], [2.0, 2.9], [2.0, 5.1]] {
        assert!(!bounds.contains(outside), "{outside:?}");
    }
    let high = Bounds::around(&[[0.0, 0.0], [1.0, 7.0]]);
    assert_eq!(high.larger_side(), 7.0);
}

/// The shape after displacements, and the box around all that triangles have.
#[test]
fn shapes_and_places() {
    let mut mesh = MeshBuilder::default();
    mesh.node([90.0, 80.0]);
    let rows = [0.0, 2.0].map(|y| mesh.row([0.0, 4.0].map(|x| [x, y])));
    mesh.join("body", &rows[0], &rows[1]);
    mesh.edges("bottom", &rows[0]);
    let scene = SceneBuilder::new("block", mesh.finish(), Plane::Stress)
        .material("body", 1.0, 0.0)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .drop_orphans()
        .build()
        .expect("a sound scene");
    let model = &*scene.model;
    assert_eq!(model.bounds(), Bounds { low: [0.0; 2], high: [4.0, 2.0] });
    assert_eq!((model.dofs(), model.free_dofs()), (10, 4));
    assert_eq!(
        model.node_ids().filter(|n| model.is_dropped(*n)).collect::<Vec<_>>(),
        model.dropped
    );
    assert_eq!(model.dropped, [NodeId::new(0)]);
    let u = DVector::from_fn(10, |k, _| if k % 2 == 0 { 0.5 } else { 8.0 });
    let moved: Vec<[f64; 2]> = model.nodes.iter().map(|[x, y]| [x + 0.5, y + 8.0]).collect();
    assert_eq!(model.shape(&u), moved);
    let finer = scene.refined().expect("sound");
    assert_eq!(finer.scene.model.nodes.len(), 5 + 5, "one on each edge");
    for (k, ends) in finer.nodes.iter().enumerate() {
        let [[ax, ay], [bx, by]] = ends.map(|n| model.coordinates(n));
        assert_eq!(finer.scene.model.nodes[k], [(ax + bx) / 2.0, (ay + by) / 2.0]);
    }
    let (_, mesh) = finer.scene.source();
    assert!(mesh.nodes.iter().zip(1..).all(|(node, number)| node.number == number));
    assert!(mesh.elements.iter().zip(1..).all(|(element, number)| element.number == number));
}
