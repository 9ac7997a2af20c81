//! Scenes and meshes built in code, written and read back; chains of edges.

use problem::element::Plane;
use problem::modelling::{Coupling, Friction, Geometry, StatusRule, Variant};
use problem::scene::surface::chain;
use problem::scene::{
    Axis, Contact, Element, Mesh, MeshBuilder, SceneBuilder, SceneFile, file, gmsh,
};
use serde_json::json;
use testing::golden_file::assert_file;

/// Two blocks on each other, with node 1 apart from both.
fn blocks() -> SceneBuilder {
    let mut mesh = MeshBuilder::default();
    mesh.node([9.0, 0.0]);
    let rows = [0.0, 1.0, 1.0, 2.0].map(|y| mesh.row([0.0, 1.0].map(|x| [x, y])));
    mesh.join("lower", &rows[0], &rows[1]);
    mesh.join("upper", &rows[2], &rows[3]);
    let names = ["bottom", "target", "contact", "top"];
    names.iter().zip(&rows).for_each(|(name, row)| mesh.edges(*name, row));
    SceneBuilder::new("blocks", mesh.finish(), Plane::Stress)
        .title("Two \"blocks\"")
        .thickness(0.25)
        .units("mm", "MPa", "N")
        .material("lower", 30000.0, 0.2)
        .material("upper", 1e-7, 1.0 / 3.0)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .restrain_node(6, &[Axis::X])
        .pressure("top", 6.3)
        .traction("top", [0.0, -1e300])
        .force(8, [0.5, -0.0])
        .contact(Contact {
            coupling: Some(Coupling::Mortar),
            friction: Some(Friction::NONE),
            geometry: Geometry::Initial,
            status: StatusRule::Intersection,
            ..Contact::new(vec![6, 7], "target", 0.001)
        })
        .iterations(3)
        .variant(Variant::Tied)
        .drop_orphans()
}

/// Reads the scene back from the two files as which it is written.
fn read_back(scene: &SceneBuilder) -> SceneBuilder {
    let text = file::write(&scene.description, "m.msh");
    let beside = |_: &str| Ok(gmsh::write(&scene.mesh).into_bytes());
    SceneBuilder::read(&scene.name, text.as_bytes(), beside).expect("the files are sound")
}

#[test]
fn a_scene_file_says_what_code_says() {
    let scene = blocks();
    assert_eq!(read_back(&scene), scene);
    let bare = SceneBuilder::new("bare", scene.mesh.clone(), Plane::Strain);
    assert_eq!(read_back(&bare), bare);
    let by_tag = SceneBuilder::new("tags", scene.mesh, Plane::Strain)
        .restrain(1, &[Axis::Y])
        .contact(Contact::new(3, 2, 0.0));
    assert_eq!(read_back(&by_tag), by_tag);
}

#[test]
fn what_has_its_default_is_not_written() {
    let bare = SceneBuilder::new("bare", Mesh::default(), Plane::Strain).pressure("top", 1.0);
    let text = "{\n  \"mesh\": \"m.msh\",\n  \"plane\": \"strain\",\n  \"materials\": {},\n  \
                \"loads\": [{\"on\":\"top\",\"pressure\":1.0}]\n}\n";
    assert_eq!(file::write(&bare.description, "m.msh"), text);
    // The defaults are 16 load steps and 20 iterations.
    let written = |load_steps: usize, iterations: usize| {
        let contact = Contact { load_steps, ..Contact::new("top", "bottom", 0.5) };
        let scene = blocks().iterations(iterations).contact(contact);
        file::write(&scene.description, "m.msh")
    };
    assert_file("tests/blocks.json", &written(3, 7));
    for field in ["load_steps", "iterations", "coupling", "friction", "geometry", "status"] {
        assert!(!written(16, 20).contains(field), "{field}: {}", written(16, 20));
    }
}

/// As a file does, code that names no variant asks for contact as it is.
#[test]
fn a_scene_in_code_runs_the_contact_solution() {
    let scene = |variant: Option<Variant>| {
        let mut scene = blocks();
        scene.description.variant = variant;
        scene.description.contact = Some(Contact::new(vec![6, 7], "target", 0.001));
        scene.build().expect("the scene is sound")
    };
    let own = scene(None);
    assert_eq!((own.variant, own.coupling(own.variant)), (Variant::Unilateral, Coupling::Mortar));
    assert!(own.check_friction().is_err());
    let paper = scene(Some(Variant::Stepped));
    assert_eq!((paper.variant, paper.coupling(paper.variant)), (Variant::Stepped, Coupling::Nts));
    assert!(paper.check_friction().is_ok());
}

#[test]
fn a_scene_in_code_is_checked_like_a_file() {
    let scene = blocks();
    let built = scene.build().expect("the scene is sound");
    assert_eq!((built.model.dropped[0].number(), built.iterations), (1, 3));
    let place = |scene: SceneBuilder| {
        let error = scene.build().expect_err("the scene is at fault");
        assert_eq!(error, read_back(&scene).build().unwrap_err());
        error.place
    };
    assert_eq!(place(scene.clone().thickness(0.0)), "field thickness");
    assert_eq!(place(scene.clone().restrain("wall", &[Axis::X])), "restraints[2].on");
    assert_eq!(place(scene.clone().force(99, [1.0, 0.0])), "loads[3].node");
    assert_eq!(place(scene.clone().material("wall", 1.0, 0.0)), "materials.wall");
    let mut folded = scene;
    folded.mesh.nodes[1].xyz = [0.0, 2.0, 0.0];
    // A file's triangles are turned where they run clockwise: of a fold it is left that they lie over each other.
    let why = |scene: SceneBuilder| scene.build().expect_err("the mesh is folded").what;
    assert!(why(read_back(&folded)).ends_with("lie over each other"));
    assert!(why(folded).contains("runs clockwise"));
}

/// Returns the triangles between two rows of `inner` and `outer` segments.
fn triangles(inner: usize, outer: usize) -> Vec<Vec<usize>> {
    let mut mesh = MeshBuilder::default();
    let place = |k: usize, n: usize| if n == 0 { 0.5 } else { k as f64 / n as f64 };
    let a = mesh.row((0..=inner).map(|k| [place(k, inner), 0.0]));
    let b = mesh.row((0..=outer).map(|k| [place(k, outer), 1.0]));
    mesh.join("body", &a, &b);
    mesh.finish().elements.into_iter().map(|e| e.nodes.to_vec()).collect()
}

#[test]
fn equal_rows_are_cut_along_one_diagonal() {
    assert_eq!(triangles(1, 1), [[1, 4, 3], [1, 2, 4]]);
}

#[test]
fn a_row_of_half_the_segments_takes_three_triangles_a_segment() {
    assert_eq!(triangles(2, 1), [[1, 2, 4], [2, 5, 4], [2, 3, 5]]);
}

#[test]
fn the_last_triangle_may_stand_on_the_outer_row() {
    assert_eq!(triangles(1, 3), [[1, 4, 3], [1, 5, 4], [1, 2, 5], [2, 6, 5]]);
}

/// Returns what is said of a mesh of one triangle that is refused.
fn refusal(corners: [[f64; 2]; 3]) -> String {
    let mut mesh = MeshBuilder::default();
    let row = mesh.row(corners);
    mesh.join("body", &row[..2], &row[2..]);
    let scene = SceneBuilder::new("flat", mesh.finish(), Plane::Strain).material("body", 1.0, 0.0);
    scene.build().expect_err("it is refused").what
}

/// What does not run counter-clockwise is turned, though nothing makes it a triangle. Sides of 2^-52 and
/// 1e-310 enclose 1e-326, which is below the least number; with a longest side of 1 it is 2e-295.
#[test]
fn a_triangle_without_area_is_refused() {
    let triangle = "triangle 1 (nodes 1, 3, 2) has";
    let flat = [0.0, 1.0, 2.0].map(|x| [x, 0.0]);
    assert_eq!(refusal(flat), format!("{triangle} the area 0"));
    let small = [[1.0, 0.0], [1.0 + f64::EPSILON, 0.0], [1.0, 1e-310]];
    assert_eq!(refusal(small), format!("{triangle} an area too small to represent"));
}

#[test]
fn a_row_of_one_node_is_the_tip_of_a_fan() {
    assert_eq!(triangles(2, 0), [[1, 2, 4], [2, 3, 4]]);
}

#[test]
fn edges_come_first_and_names_take_the_tags_that_are_free() {
    let mut mesh = MeshBuilder::default();
    mesh.row([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    mesh.triangles(2, [[1, 2, 3]]);
    mesh.edges("bottom", &[1, 2]);
    mesh.edges("left", &[3, 1]);
    mesh.edges("bottom", &[2, 3]);
    let mesh = mesh.finish();
    let of = |e: &Element| (e.number, e.physical[0], e.nodes.to_vec());
    let elements: Vec<_> = mesh.elements.iter().map(of).collect();
    let expected =
        [(1, 1, vec![1, 2]), (2, 1, vec![2, 3]), (3, 3, vec![3, 1]), (4, 2, vec![1, 2, 3])];
    assert_eq!(elements, expected);
    let names: Vec<_> = mesh.names.iter().map(|n| (n.dim, n.tag, n.name.as_str())).collect();
    assert_eq!(names, [(1, 1, "bottom"), (1, 3, "left")]);
}

#[test]
fn a_mesh_as_a_document_is_rows_of_numbers() {
    let mut mesh = MeshBuilder::default();
    mesh.row([[0.0, 0.5], [1.0, 0.0], [0.0, 1.0]]);
    mesh.edges("bottom", &[1, 2]);
    mesh.triangles(7, [[1, 2, 3]]);
    let mesh = mesh.finish();
    let document = json!({
        "groups": [[1, 1, "bottom"]],
        "nodes": [[1, 0.0, 0.5, 0.0], [2, 1.0, 0.0, 0.0], [3, 0.0, 1.0, 0.0]],
        "elements": [[1, 1, [1], 1, [1, 2]], [2, 2, [7], 7, [1, 2, 3]]],
    });
    assert_eq!(serde_json::to_value(&mesh).expect("a document"), document);
    assert_eq!(serde_json::from_value::<Mesh>(document).expect("a mesh"), mesh);
}

#[test]
fn a_scene_is_named_by_its_file_or_by_its_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("mine")).expect("a folder");
    for file in ["mine/scene.json", "mine/plate.json"] {
        std::fs::write(folder.path().join(file), "{}").expect("it is written");
    }
    let name = |path: &str| SceneFile::read_in(folder.path(), path).expect("it is there").name;
    assert_eq!(["mine", "mine/scene.json", "mine/plate.json"].map(name), ["mine", "mine", "plate"]);
}

#[test]
fn a_chain_starts_at_its_first_end_in_mesh_order() {
    assert_eq!(chain(&[[5, 4], [5, 6], [4, 9]]).unwrap(), [6, 5, 4, 9]);
    assert_eq!(chain(&[[2, 1], [3, 2]]).unwrap(), [1, 2, 3]);
}

#[test]
fn a_closed_chain_starts_at_its_first_edge_and_names_each_node_once() {
    assert_eq!(chain(&[[1, 2], [2, 3], [3, 1]]).unwrap(), [1, 2, 3]);
}

#[test]
fn branches_and_pieces_are_refused() {
    assert!(chain(&[[1, 2], [2, 3], [2, 4]]).unwrap_err().contains("node 2"));
    assert!(chain(&[[1, 2], [3, 4]]).unwrap_err().contains("edge 3 - 4"));
}
