//! The first scene of a mesh, and what it leaves to its author; units that do not fit each other.

use problem::element::Plane;
use problem::scene::{Axis, Mesh, MeshBuilder, PhysicalName, Scene, SceneBuilder, first, gmsh};
use testing::golden_file::assert_rows;

/// A block under a narrower punch, a hundredth above it, with all their sides as groups.
fn punch() -> Mesh {
    blocks("block:0:10:0:5:10 punch:3:7:5.01:8:4")
}

/// Blocks by name, extent along x and y, and number of cells, each in a surface of its own, with all their sides as
/// groups.
fn blocks(blocks: &str) -> Mesh {
    let mut mesh = MeshBuilder::default();
    for (name, extent) in blocks.split(' ').map(|block| block.split_once(':').expect("a name")) {
        let numbers: Vec<f64> = extent.split(':').map(|x| x.parse().expect("a number")).collect();
        let [left, right, low, high, cells] = numbers[..] else { panic!("{extent}") };
        let row = |y: f64| {
            (0..=cells as u32).map(move |k| [left + (right - left) * f64::from(k) / cells, y])
        };
        let (bottom, top) = (mesh.row(row(low)), mesh.row(row(high)));
        mesh.join(name, &bottom, &top);
        mesh.edges(format!("{name}_bottom"), &bottom);
        mesh.edges(format!("{name}_top"), &top);
        mesh.edges(format!("{name}_left"), &[bottom[0], top[0]]);
    }
    mesh.finish()
}

fn build(text: &str, file: &str) -> Result<Scene, String> {
    let beside = |_: &str| Ok(file.as_bytes().to_vec());
    Scene::build("first", text.as_bytes(), beside).map_err(|why| why.to_string())
}

#[test]
fn a_first_scene_leaves_exactly_what_only_its_author_knows() {
    let file = gmsh::write(&punch());
    let scene = first("punch.msh", file.as_bytes()).unwrap();
    for guess in [
        r#""cnt":"punch_bottom","trg":"block_top""#,
        r#"{"on":"block_bottom","fix""#,
        r#"{"on":"punch_top","pressure":null}"#,
    ] {
        assert!(scene.text.contains(guess), "{guess}: {}", scene.text);
    }
    assert!(scene.notes.iter().any(|note| note.contains("left for more")), "{:?}", scene.notes);
    let why = build(&scene.text, &file).unwrap_err();
    let open = "materials.block.E, materials.block.nu, materials.punch.E, materials.punch.nu, loads[0].pressure, \
                contact.friction";
    assert!(why.contains(&format!("where: {open}\n")), "{why}");
    let chosen = scene.text.replace("\"nu\":null", "\"nu\":0.2").replace("null", "1.0");
    let built = build(&chosen, &file).unwrap();
    assert!(built.check_friction().is_ok() && built.model.has_contact());
}

/// A row of `first.txt` has blocks, ` | `, and what is renamed, `a>b`, or named in the scene, `"a">"b"`, with `+` for a
/// blank. Then stand the notes on the mesh, who is in contact with whom, and what the chosen scene is built with.
#[test]
fn first_scenes() {
    let answer = |row: &str| {
        let (of, changes) = row.split_once(" |").expect("blocks");
        let changes = changes.split(' ').filter_map(|both| both.split_once('>'));
        let changes: Vec<_> = changes.map(|(a, b)| (a, b.replace('+', " "))).collect();
        let mut mesh = blocks(of);
        for (from, to) in &changes {
            mesh.names.iter_mut().for_each(|name| name.name = name.name.replace(from, to));
        }
        let file = gmsh::write(&mesh);
        let scene = first("m.msh", file.as_bytes()).expect("groups");
        let contact = scene.text.lines().find(|line| line.contains("\"cnt\"")).unwrap_or_default();
        let text = scene.text.replace("\"nu\":null", "\"nu\":0.2").replace("null", "1.0");
        let text = changes.iter().fold(text, |text, (from, to)| text.replace(from, to));
        let built = build(&text, &file).map_or_else(|why| why, |built| built.adapted().join("\n"));
        let notes = scene.notes.iter().map(String::as_str);
        let said = notes.chain([contact.trim(), &built]).filter(|line| !line.is_empty());
        said.collect::<Vec<_>>().join("\n")
    };
    assert_rows("tests/first.txt", answer);
}

#[test]
fn a_mesh_without_groups_is_refused_with_the_lines_that_it_lacks() {
    let mut mesh = punch();
    mesh.names.clear();
    mesh.elements.iter_mut().for_each(|element| element.physical.clear());
    let surface = mesh.of_dimension(2).next().unwrap().geometric;
    let why = first("punch.msh", gmsh::write(&mesh).as_bytes()).err().unwrap().to_string();
    let line = format!("Physical Surface(\"surface{surface}\") = {{{surface}}};");
    assert!(why.contains(&line) && why.contains("Physical Curve(\"curve"), "{why}");
    mesh.elements.retain(|element| element.dim() == 2);
    let why = first("punch.msh", gmsh::write(&mesh).as_bytes()).err().unwrap().to_string();
    assert!(why.contains("whose numbers Gmsh shows"), "{why}");
}

#[test]
fn bodies_that_share_nodes_and_bodies_that_are_missing_are_named() {
    let mut mesh = MeshBuilder::default();
    let rows = [0.0, 1.0, 2.0].map(|y| mesh.row([0.0, 1.0, 2.0].map(|x| [x, y])));
    mesh.join("lower", &rows[0], &rows[1]);
    mesh.join("upper", &rows[1], &rows[2]);
    mesh.edges("bottom", &rows[0]);
    let mut mesh = mesh.finish();
    mesh.names.push(PhysicalName { dim: 2, tag: 99, name: "lid".into() });
    let said = first("m.msh", gmsh::write(&mesh).as_bytes()).unwrap().notes.join("\n");
    let merged = "\"lower\" and \"upper\" share nodes and are one body: nothing comes in contact";
    assert!(said.contains(merged) && said.contains("have none: \"lid\""), "{said}");
}

/// A line inside a body.
#[test]
fn inner_edges_are_left_over() {
    let mut mesh = MeshBuilder::default();
    let rows = [0.0, 1.0, 2.0].map(|y| mesh.row([0.0, 1.0, 2.0].map(|x| [x, y])));
    mesh.join("body", &rows[0], &rows[1]);
    mesh.join("body", &rows[1], &rows[2]);
    mesh.edges("bottom", &rows[0]);
    mesh.edges("joint", &rows[1]);
    let file = gmsh::write(&mesh.finish());
    let scene = first("m.msh", file.as_bytes()).unwrap();
    let said = scene.notes.join("\n");
    assert!(said.contains("left over: \"joint\"") && said.contains("load: no group"), "{said}");
    assert!(!scene.text.contains("joint"), "{}", scene.text);
}

#[test]
fn each_triangle_is_in_one_group_with_a_material() {
    let grouped = |edit: fn(&mut problem::scene::Element, usize)| {
        let mut mesh = punch();
        let extra = mesh.names.iter().map(|name| name.tag).max().unwrap() + 1;
        mesh.names.push(PhysicalName { dim: 2, tag: extra, name: "all".into() });
        mesh.elements.iter_mut().filter(|e| e.dim() == 2).for_each(|e| edit(e, extra));
        first("m.msh", gmsh::write(&mesh).as_bytes())
    };
    let both = grouped(|element, extra| element.physical.push(extra)).unwrap();
    let said = both.notes.join("\n");
    assert!(said.contains("none for \"all\", whose triangles are in the other groups"), "{said}");
    assert!(!both.text.contains("\"all\""), "{}", both.text);
    let none = grouped(|element, extra| match element.number.is_multiple_of(2) {
        true => element.physical.clear(),
        false => element.physical[0] = extra,
    });
    let why = none.err().unwrap().to_string();
    assert!(why.contains("has no material (surface") && why.contains("add those"), "{why}");
    let part = grouped(|element, extra| match element.number.is_multiple_of(2) {
        true => element.physical = [extra].into_iter().collect(),
        false => element.physical.push(extra),
    });
    let why = part.err().unwrap().to_string();
    assert!(why.contains("has two materials"), "{why}");
}

#[test]
fn a_mesh_without_tags_is_refused_with_the_lines_of_meshio() {
    let mut mesh = punch();
    mesh.names.clear();
    mesh.elements.iter_mut().for_each(|element| {
        element.physical.clear();
        element.geometric = 0;
    });
    let why = first("m.msh", gmsh::write(&mesh).as_bytes()).err().unwrap().to_string();
    assert!(why.contains("mesh.cell_data[\"gmsh:physical\"] = ["), "{why}");
    assert!(!why.contains("Physical Surface") && !why.contains("{0}"), "{why}");
}

/// A row of `units.txt` has the units of length, stress and force, `-` for none.
#[test]
fn units_that_do_not_fit_each_other_are_named() {
    assert_rows("tests/units.txt", |row| {
        let units =
            row.trim_start_matches("units: ").split(", ").map(|unit| unit.trim_matches('-'));
        let [length, stress, force] = units.collect::<Vec<_>>()[..] else { panic!("{row}") };
        let scene = SceneBuilder::new("punch", punch(), Plane::Strain)
            .units(length, stress, force)
            .material("block", 1.0, 0.3)
            .material("punch", 1.0, 0.3)
            .restrain("block_bottom", &[Axis::X, Axis::Y])
            .restrain("punch_bottom", &[Axis::X, Axis::Y])
            .build();
        scene.expect("it is sound").adapted().first().cloned().unwrap_or("they fit".into())
    });
}
