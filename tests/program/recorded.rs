//! What random edits of scenes and mesh files are read as, recorded: the model, its half and its finer
//! mesh, or the fault that is named.

use std::fmt::{Debug, Write};

use fastrand::Rng;
use plane_contact::Scene;
use plane_contact::problem::element::Plane;
use plane_contact::problem::scene::{
    Axis, Contact, MeshBuilder, SceneBuilder, gmsh, sha256, symmetry,
};
use serde_json::{Value, json};

use crate::common::draws::one_of;
use crate::common::embedded::scene_json;
use crate::common::recorded::assert_recorded_exactly;

/// The number of edited scenes and of edits of each mesh file.
const SCENES: usize = 240;
const MESHES: usize = 60;

const MESH_FILES: [(&str, &[u8]); 4] = [
    ("2.2", include_bytes!("gmsh/blocks-2.2-ascii.msh")),
    ("4.1", include_bytes!("gmsh/blocks-4.1-ascii.msh")),
    ("2.2 binary", include_bytes!("gmsh/blocks-2.2-binary.msh")),
    ("4.1 binary", include_bytes!("gmsh/blocks-4.1-binary.msh")),
];

/// Returns the beginning of the SHA-256 of all that a thing shows.
fn hash(thing: &impl Debug) -> String {
    sha256(&format!("{thing:?}"))[..16].to_owned()
}

/// Returns what came of a scene: a line each of its model, its half, and its finer mesh.
fn read(scene: plane_contact::error::Result<Scene>) -> String {
    let scene = match scene {
        Ok(scene) => scene,
        Err(error) => return format!("! {error}\n"),
    };
    let model = &scene.model;
    let counts = [
        model.nodes.len(),
        model.triangles.len(),
        model.bodies.len(),
        model.free_dofs(),
        model.contact.nodes.len(),
    ];
    let mut text = format!("{counts:?} load {:?} model {}\n", model.total_load(), hash(model));
    match symmetry::half(&scene) {
        Some(half) => {
            let of = [hash(&half.scene.model), hash(&half.nodes), hash(&half.triangles)];
            writeln!(text, "half at {} {of:?} {:e}", half.at, half.departure).expect("room");
        }
        None => text += "no half\n",
    }
    match scene.refined() {
        Ok(Some(finer)) => {
            writeln!(text, "finer {} {}", hash(&finer.scene.model), hash(&finer.parents))
                .expect("room");
        }
        other => {
            writeln!(text, "not finer {:?}", other.err().map(|why| why.to_string())).expect("room")
        }
    }
    if let Some((description, mesh)) = scene.source() {
        writeln!(text, "written {} {:?}", hash(&gmsh::write(mesh)), hash(description))
            .expect("room");
    }
    text
}

/// Returns every value in a document, by where it stands.
fn places(value: &Value, at: String, found: &mut Vec<String>) {
    match value {
        Value::Object(fields) => fields.iter().for_each(|(key, value)| {
            found.push(format!("{at}/{key}"));
            places(value, format!("{at}/{key}"), found);
        }),
        Value::Array(values) => values.iter().enumerate().for_each(|(k, value)| {
            found.push(format!("{at}/{k}"));
            places(value, format!("{at}/{k}"), found);
        }),
        _ => {}
    }
}

/// Edits a scene at a random place, and tells how.
fn edit(rng: &mut Rng, scene: &mut Value) -> String {
    let mut found = Vec::new();
    // Few of the many places of the tables.
    if rng.u8(..4) == 0 {
        places(scene, String::new(), &mut found);
    } else {
        let mut rest = scene.clone();
        rest.as_object_mut()
            .expect("an object")
            .retain(|key, _| !["node", "elem"].contains(&key.as_str()));
        places(&rest, String::new(), &mut found);
    }
    let at = one_of(rng, &found);
    let (parent, key) = at.rsplit_once('/').expect("a place");
    let values = [
        json!(null),
        json!(-1),
        json!(0),
        json!(0.5),
        json!(1),
        json!(2),
        json!(3),
        json!(7),
        json!(1e300),
        json!("x"),
        json!("y"),
        json!([]),
        json!({}),
        json!(true),
        json!(["x"]),
        json!("stress"),
        json!([1, 2]),
        json!(1e-3),
    ];
    let new = one_of(rng, &values);
    let parent = scene.pointer_mut(parent).expect("it stands there");
    match (rng.u8(..4), parent) {
        (0, Value::Object(fields)) => drop(fields.remove(key)),
        (0, Value::Array(values)) => drop(values.remove(key.parse().expect("a number"))),
        (1, Value::Array(values)) => {
            let copy = values[key.parse::<usize>().expect("a number")].clone();
            values.push(copy);
            return format!("{at} twice");
        }
        (_, Value::Object(fields)) => {
            fields.insert(key.into(), new.clone());
            return format!("{at} = {new}");
        }
        (_, Value::Array(values)) => {
            values[key.parse::<usize>().expect("a number")] = new.clone();
            return format!("{at} = {new}");
        }
        _ => unreachable!("it has parts"),
    }
    format!("{at} gone")
}

#[test]
fn edited_scenes() {
    let mut rng = Rng::with_seed(21);
    let mut text = String::new();
    let mesh = gmsh::write(&symmetric(&mut rng).mesh);
    let beside = |_: &str| Ok(mesh.clone().into_bytes().into());
    let with_mesh = json!({
        "title": "Blocks", "plane": "stress", "mesh": "blocks.msh", "thickness": 2.0,
        "materials": {"lower": {"E": 3e4, "nu": 0.2}, "upper": {"E": 2e5, "nu": 0.3}},
        "restraints": [{"on": "bottom", "fix": ["x", "y"]}, {"node": 3, "fix": ["x"]}],
        "loads": [{"on": "top", "pressure": 2.0}, {"on": "top", "traction": [1.0, -0.5], "stage": 2},
                  {"node": 4, "force": [0.25, -1.0]}],
        "contact": {"cnt": "contact", "trg": "target", "c_tll": 0.001, "friction": 0.3,
                    "load_steps": 4},
        "iterations": 5, "variant": "unilateral", "drop_orphans": true,
        "units": {"length": "mm", "force": "N"}
    });
    let bases = [scene_json("fig1"), scene_json("two-blocks"), with_mesh];
    for k in 0..SCENES {
        let mut scene = bases[k % bases.len()].clone();
        let edits: Vec<String> = (0..rng.usize(..3)).map(|_| edit(&mut rng, &mut scene)).collect();
        let json = scene.to_string();
        let read = read(Scene::build("edited", json.as_bytes(), beside));
        writeln!(text, "{}\n{read}", edits.join(", ")).expect("room");
    }
    assert_recorded_exactly("scenes", &text);
}

#[test]
fn edited_mesh_files() {
    let mut rng = Rng::with_seed(22);
    let mut text = String::new();
    for (name, file) in MESH_FILES {
        for _ in 0..MESHES {
            let (edited, how) = match std::str::from_utf8(file) {
                Ok(lines) => edited_text(&mut rng, lines),
                Err(_) => edited_bytes(&mut rng, file),
            };
            let read = match gmsh::read(&edited) {
                Err(error) => format!("! {error}"),
                Ok(mesh) => {
                    let judged = mesh.check().err().map(|error| error.to_string());
                    let counts = [mesh.nodes.len(), mesh.elements.len()];
                    format!("{counts:?} {} {}", hash(&mesh), judged.unwrap_or_default())
                }
            };
            writeln!(text, "{name}: {how}\n  {read}").expect("room");
        }
    }
    assert_recorded_exactly("mesh-files", &text);
}

/// Changes a line or a word of a text.
fn edited_text(rng: &mut Rng, text: &str) -> (Vec<u8>, String) {
    let mut lines: Vec<String> = text.lines().map(String::from).collect();
    let (i, j) = (rng.usize(..lines.len()), rng.usize(..lines.len()));
    let how = match rng.u8(..8) {
        0 => format!("line {} gone: {}", i + 1, lines.remove(i)),
        1 => {
            let line = lines[j].clone();
            lines.insert(i, line);
            format!("line {} before {}", j + 1, i + 1)
        }
        2 => {
            lines.truncate(i);
            format!("ends before line {}", i + 1)
        }
        _ => {
            let mut words: Vec<String> = lines[i].split(' ').map(String::from).collect();
            let k = rng.usize(..words.len());
            let new =
                ["0", "1", "2", "3", "15", "-1", "1e3", "x", "", "\"", "99999999999", "1.5", "9"];
            words[k] = one_of(rng, &new).to_owned();
            lines[i] = words.join(" ");
            format!("line {}: {}", i + 1, lines[i])
        }
    };
    let end = if rng.bool() { "\n" } else { "\r\n" };
    ((lines.join(end) + end).into_bytes(), how)
}

/// Changes some bytes of a file, or cuts it.
fn edited_bytes(rng: &mut Rng, file: &[u8]) -> (Vec<u8>, String) {
    let mut bytes = file.to_vec();
    let at = rng.usize(..bytes.len());
    if rng.u8(..5) == 0 {
        bytes.truncate(at);
        return (bytes, format!("ends at byte {at}"));
    }
    let new = one_of(rng, &[0, 1, 2, 3, 255, b'$', b'\n', b' ', 9]);
    bytes[at] = new;
    (bytes, format!("byte {at} = {new}"))
}

/// Two blocks that are their own image about x = 2, one thing about which may be changed.
fn symmetric(rng: &mut Rng) -> SceneBuilder {
    let mut mesh = MeshBuilder::default();
    let nudge = |rng: &mut Rng| if rng.u8(..90) == 0 { one_of(rng, &[1e-12, 1e-5]) } else { 0.0 };
    let rows = |mesh: &mut MeshBuilder, y: [f64; 3], rng: &mut Rng| {
        y.map(|y| mesh.row([0.0, 1.0, 2.0, 3.0, 4.0].map(|x| [x, y + nudge(rng)])))
    };
    let lower = rows(&mut mesh, [0.0, 1.0, 2.0], rng);
    let upper = rows(&mut mesh, [2.0, 3.0, 4.0], rng);
    for (name, rows) in [("lower", &lower), ("upper", &upper)] {
        for (below, above) in [(&rows[0], &rows[1]), (&rows[1], &rows[2])] {
            for k in 0..4 {
                let [a, b, c, d] = [below[k], below[k + 1], above[k + 1], above[k]];
                let is_left = (k < 2) != (rng.u8(..200) == 0);
                let halves = if is_left { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
                mesh.triangles(name, halves);
            }
        }
    }
    mesh.edges("bottom", &lower[0]);
    mesh.edges("target", &lower[2]);
    mesh.edges("contact", &upper[0]);
    mesh.edges("top", &upper[2]);
    let modulus = one_of(rng, &[2e5, 2e5, 3e4]);
    let mut scene = SceneBuilder::new("symmetric", mesh.finish(), Plane::Strain)
        .material("lower", 3e4, 0.2)
        .material("upper", modulus, 0.3)
        .restrain("bottom", &[Axis::X, Axis::Y])
        .pressure("top", one_of(rng, &[1.0, 2.0]))
        .contact(Contact::new("contact", "target", 0.001));
    match rng.u8(..8) {
        0 => scene = scene.force(upper[2][1], [0.0, -1.0]),
        1 => scene = scene.force(upper[2][2], [0.0, -1.0]).in_stage(2),
        2 => scene = scene.force(upper[2][2], [1.0, 0.0]),
        3 => scene = scene.force(upper[2][1], [0.5, -1.0]).force(upper[2][3], [-0.5, -1.0]),
        4 => scene = scene.restrain_node(upper[1][0], &[Axis::X]),
        5 => scene = scene.restrain_node(upper[1][2], &[Axis::X]),
        6 => {
            scene =
                scene.restrain_node(upper[1][0], &[Axis::Y]).restrain_node(upper[1][4], &[Axis::Y])
        }
        _ => {}
    }
    scene
}

#[test]
fn symmetric_scenes() {
    let mut rng = Rng::with_seed(23);
    let mut text = String::new();
    for k in 0..60 {
        let scene = symmetric(&mut rng).build();
        writeln!(text, "{k}\n{}", read(scene)).expect("room");
    }
    assert_recorded_exactly("symmetric", &text);
}
