//! The first scene of a mesh, and what it leaves to its author; units that do not fit each other.

use problem::element::Plane;
use problem::scene::{Axis, Mesh, MeshBuilder, PhysicalName, Scene, SceneBuilder, first, gmsh};

type Block = (&'static str, [f64; 2], [f64; 2], u32);

const PUNCH: [Block; 2] =
    [("block", [0.0, 10.0], [0.0, 5.0], 10), ("punch", [3.0, 7.0], [5.01, 8.0], 4)];

/// A block under a narrower punch, a hundredth above it, with all their sides as groups.
fn punch() -> Mesh {
    blocks(&PUNCH)
}

/// Blocks by name, extent and number of cells, each in a surface of its own, with all their sides as groups.
fn blocks(blocks: &[Block]) -> Mesh {
    let mut mesh = MeshBuilder::default();
    for (name, [left, right], [low, high], cells) in blocks.iter().copied() {
        let row = |y: f64| {
            (0..=cells).map(move |k| [left + (right - left) * f64::from(k) / f64::from(cells), y])
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

fn notes(mesh: &Mesh) -> String {
    first("m.msh", gmsh::write(mesh).as_bytes()).unwrap().notes.join("\n")
}

#[test]
fn bodies_that_nothing_or_contact_alone_holds_are_named() {
    let far: Block = ("far", [30.0, 40.0], [20.0, 25.0], 10);
    let said = notes(&blocks(&[PUNCH[0], PUNCH[1], far]));
    assert!(said.contains("contact: \"punch_bottom\" on \"block_top\""), "{said}");
    assert!(said.contains("contact alone holds the body \"punch\""), "{said}");
    assert!(said.contains("nothing holds the body \"far\""), "{said}");
    assert!(!said.contains("body \"block\""), "{said}");
}

#[test]
fn curves_that_face_no_other_body_are_no_contact() {
    // Beside each other, corner to corner: no side faces another.
    let corner: Block = ("other", [10.0, 20.0], [5.0, 10.0], 10);
    let said = notes(&blocks(&[PUNCH[0], corner]));
    assert!(said.contains("no two groups of edges of different bodies face each other"), "{said}");
    assert!(said.contains("nothing holds the body \"other\""), "{said}");
    let above: Block = ("punch", [3.0, 7.0], [9.0, 12.0], 4);
    let said = notes(&blocks(&[PUNCH[0], above]));
    assert!(said.contains("though they are 4 apart, more than an edge"), "{said}");
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
    let said = notes(&mesh);
    let merged = "\"lower\" and \"upper\" share nodes and are one body: nothing comes in contact";
    assert!(said.contains(merged) && said.contains("have none: \"lid\""), "{said}");
    let said = notes(&punch());
    assert!(!said.contains("share nodes") && !said.contains("have none"), "{said}");
}

/// A punch with edges of another length than the block's, by name too.
#[test]
fn the_surface_with_the_longer_edges_is_the_contact_surface() {
    let of = |cells: u32, [lower, upper]: [&str; 2]| {
        let mut mesh = blocks(&[PUNCH[0], ("punch", [3.0, 7.0], [5.01, 8.0], cells)]);
        for name in &mut mesh.names {
            name.name = name.name.replace("block_top", lower).replace("punch_bottom", upper);
        }
        let file = gmsh::write(&mesh);
        let scene = first("m.msh", file.as_bytes()).unwrap();
        let finer = scene.notes.iter().any(|note| note.contains("alternates from node to node"));
        let (_, rest) = scene.text.split_once("\"cnt\":\"").unwrap();
        (rest.split('"').next().unwrap().to_string(), scene.notes.join("\n"), finer)
    };
    let plain = ["block_top", "punch_bottom"];
    for (cells, names, cnt, why) in [
        (2, plain, "punch_bottom", "its edges are longer, 2 times"),
        (4, plain, "punch_bottom", "it is the shorter surface"),
        (12, plain, "block_top", "its edges are longer, 3 times"),
        (4, ["the slave", "the master"], "the slave", "the names say"),
        (6, ["block_top", "Secondary"], "Secondary", "the names say"),
        (12, ["primary", "secondary"], "primary", "its edges are longer, 3 times"),
    ] {
        let (found, said, finer) = of(cells, names);
        assert!(found == cnt && said.contains(why) && !finer, "{cells} {names:?}: {found}: {said}");
    }
    let file = gmsh::write(&blocks(&[PUNCH[0], ("punch", [3.0, 7.0], [5.01, 8.0], 12)]));
    let scene = |[cnt, trg]: [&str; 2]| {
        let text = first("m.msh", file.as_bytes()).unwrap().text;
        let text = text.replace("\"nu\":null", "\"nu\":0.2").replace("null", "1.0");
        let text =
            text.replace("\"cnt\":\"block_top\",\"trg\":\"punch_bottom\"", &format!("{cnt},{trg}"));
        build(&text, &file).unwrap().adapted().join(" ")
    };
    let fine = scene(["\"cnt\":\"punch_bottom\"", "\"trg\":\"block_top\""]);
    assert!(fine.contains("The target's edges are 3 times as long"), "{fine}");
    let coarse = scene(["\"cnt\":\"block_top\"", "\"trg\":\"punch_bottom\""]);
    assert!(!coarse.contains("as long"), "{coarse}");
}

/// A line inside a body, and a body of two parts that lie beside each other with nodes of their own.
#[test]
fn inner_edges_are_left_over_and_slits_are_named() {
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

    let halves = [("left", [0.0, 1.0], [0.0, 1.0], 2), ("right", [1.0, 2.0], [0.0, 1.0], 2)];
    let mesh = blocks(&halves);
    let said = notes(&mesh);
    assert!(
        said.contains("The mesh has a slit") && said.contains("nothing holds the body"),
        "{said}"
    );
    let file = gmsh::write(&mesh);
    let text = first("m.msh", file.as_bytes()).unwrap().text;
    let text = text.replace("\"nu\":null", "\"nu\":0.2").replace("null", "1.0");
    let why = build(&text, &file).unwrap_err();
    assert!(why.contains("can still") && why.contains("The mesh has a slit"), "{why}");
}

/// Groups that face each other nowhere, and one group of both sides.
#[test]
fn the_right_groups_of_contact_are_named() {
    let file = gmsh::write(&punch());
    let text = first("punch.msh", file.as_bytes()).unwrap().text;
    let text = text.replace("\"nu\":null", "\"nu\":0.2").replace("null", "1.0");
    let named = |trg: &str| build(&text.replace("\"trg\":\"block_top\"", trg), &file);
    let notes = |trg: &str| named(trg).unwrap().adapted().join(" ");
    let wrong = notes("\"trg\":\"block_bottom\"");
    assert!(wrong.contains("nowhere; \"punch_bottom\" and \"block_top\" do"), "{wrong}");
    assert!(!notes("\"trg\":\"block_top\"").contains("nowhere"));
    let why = named("\"trg\":\"punch_bottom\"").unwrap_err();
    assert!(why.contains("give the surface of each body a group of its own"), "{why}");
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

#[test]
fn units_that_do_not_fit_each_other_are_named() {
    let note = |[length, stress, force]: [&str; 3]| {
        let scene = SceneBuilder::new("punch", punch(), Plane::Strain)
            .units(length, stress, force)
            .material("block", 1.0, 0.3)
            .material("punch", 1.0, 0.3)
            .restrain("block_bottom", &[Axis::X, Axis::Y])
            .restrain("punch_bottom", &[Axis::X, Axis::Y])
            .build()
            .unwrap();
        scene.adapted().first().cloned()
    };
    let fitting = [
        ["mm", "MPa", "N"],
        ["m", "Pa", "N"],
        ["mm", "GPa", "kN"],
        ["in", "psi", "lbf"],
        ["in", "ksi", "kip"],
        ["", "MPa", "kip"],
        ["mm", "N/mm2", "N"],
        ["MM", "N / mm^2", "n"],
        ["cm", "kN/cm²", "KN"],
        ["in", "lbf/in**2", "lb"],
    ];
    fitting.into_iter().for_each(|units| assert_eq!(note(units), None, "{units:?}"));
    let misfits = [
        (["in", "psi", "kip"], "psi times in² is 0.001 kip", "\"lbf\""),
        (["m", "MPa", "N"], "MPa times m² is 1000000 N", "\"MN\""),
        (["in", "MPa", "N"], "MPa times in² is 645.16 N", "units that fit"),
        (["cm", "n/MM2", "N"], "n/MM2 times cm² is 100 N", "units that fit"),
        (["cm", "mpa", "N"], "mpa times cm² is 100 N", "units that fit"),
        (["furlong", "MPa", "N"], "the length \"furlong\"", "not checked"),
        (["mm", "MPa", "mn"], "the force \"mn\"", "not checked"),
        (["mm", "mPa", "N"], "the stress \"mPa\"", "not checked"),
        (["Mm", "MPa", "N"], "the length \"Mm\"", "not checked"),
    ];
    for (units, size, fix) in misfits {
        let note = note(units).unwrap();
        assert!(note.contains(size) && note.contains(fix), "{note}");
    }
}
