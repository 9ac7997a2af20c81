//! Mistakes, each with the message that it gets: `golden/mistakes.md`, for users.

use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::common::embedded::scene_json;
use crate::common::golden_file::assert_file;
use crate::common::program::run;

/// What is wrong with a scene: the mistake, and `fig1`'s fields with their wrong values, each a
/// JSON pointer and JSON; without a value the field is left out.
const SCENES: &[(&str, &[(&str, &str)])] = &[
    ("a field's name is mistyped", &[("/contact/c_tol", "0.001")]),
    ("a field is missing", &[("/materials", "")]),
    ("a word stands for a number", &[("/contact/c_tll", "\"small\"")]),
    ("a number stands for a word", &[("/variant", "3")]),
    ("a list stands for an object", &[("/contact", "[5, 6, 7]")]),
    ("an object stands for a list", &[("/restraints", "{\"on\": 11, \"fix\": [\"x\"]}")]),
    ("a choice is mistyped", &[("/plane", "\"strian\"")]),
    ("there is no such direction", &[("/restraints/0/fix", "[\"z\"]")]),
    ("a number is negative that must not be", &[("/contact/c_tll", "-0.001")]),
    ("the thickness is 0", &[("/thickness", "0")]),
    ("part of an iteration", &[("/iterations", "2.5")]),
    ("too many iterations", &[("/iterations", "10000000")]),
    ("the elastic modulus is 0", &[("/materials/1/E", "0")]),
    ("an incompressible material", &[("/materials/1/nu", "0.5")]),
    ("the shear modulus in place of nu", &[("/materials/1/G", "12500")]),
    ("a material of no group", &[("/materials/3", "{\"E\": 1, \"nu\": 0}")]),
    ("a group without a material", &[("/materials/2", "")]),
    ("a restraint on a group that is not there", &[("/restraints/0/on", "\"wall\"")]),
    ("a restraint of a node that is not there", &[("/restraints/1/node", "14")]),
    ("a restraint that fixes nothing", &[("/restraints/1/fix", "[]")]),
    ("a restraint of a node and of a group", &[("/restraints/1/on", "11")]),
    ("no restraint at all", &[("/restraints", "[]")]),
    ("a load of no kind", &[("/loads/0/pressure", "")]),
    ("a load of two kinds", &[("/loads/0/traction", "[0, -1]")]),
    ("a load on a side inside the body", &[("/elem/7", "[8, 1, 2, 21, 21, 6, 12]")]),
    ("a force with three components", &[("/loads/0", "{\"node\": 12, \"force\": [0, 1, 0]}")]),
    ("stage 2 without stage 1", &[("/loads/0/stage", "2")]),
    ("a contact node that is not there", &[("/contact/cnt", "[5, 77]")]),
    ("a contact node on the target", &[("/contact/cnt", "[5, 6, 2]")]),
    ("a target of triangles", &[("/contact/trg", "[10]")]),
    ("an empty target", &[("/contact/trg", "[]")]),
    (
        "nodes between contact nodes left out",
        &[
            ("/contact/cnt", "[5, 7, 9]"),
            ("/variant", "\"unilateral\""),
            ("/contact/friction", "0.3"),
        ],
    ),
    ("friction is left out", &[("/variant", "\"unilateral\"")]),
    ("a negative friction coefficient", &[("/contact/friction", "-0.3")]),
    ("friction is a word", &[("/contact/friction", "\"rough\"")]),
    (
        "the stamp is inside the block",
        &[
            ("/node/4/2", "-0.5"),
            ("/node/5/2", "-0.5"),
            ("/node/6/2", "-0.5"),
            ("/node/7/2", "-0.5"),
            ("/node/8/2", "-0.5"),
            ("/variant", "\"unilateral\""),
            ("/contact/friction", "0.3"),
        ],
    ),
    ("a triangle runs clockwise", &[("/elem/9", "[10, 2, 2, 1, 1, 1, 2, 10]")]),
    ("a triangle of no area", &[("/node/9", "[10, 2.0, 0.04, 0.0]")]),
    ("two triangles on the same nodes", &[("/elem/10", "[11, 2, 2, 1, 1, 10, 2, 1]")]),
    ("a quadrangle", &[("/elem/9", "[10, 3, 2, 1, 1, 1, 10, 11, 2]")]),
    ("an element of a node that is not there", &[("/elem/9", "[10, 2, 2, 1, 1, 1, 10, 99]")]),
    ("a node in no triangle", &[("/elem/17", "[18, 1, 2, 20, 20, 8, 9]")]),
    ("a node given twice", &[("/node/12/0", "12")]),
    ("the mesh is not plane", &[("/node/12/3", "1.0")]),
    ("a mesh file that is not there", &[("/mesh", "\"fig1.msh\""), ("/node", ""), ("/elem", "")]),
    ("a mesh file and tables", &[("/mesh", "\"fig1.msh\"")]),
];

/// Other mistakes: what it is, the content of a file named as in the command, and the command.
const OTHERS: &[(&str, &str, &str)] = &[
    ("a scene that is not there", "", "solve nosuch"),
    ("a mistyped name of an embedded scene", "", "solve strnd"),
    ("JSON that ends too early", "{\"plane\": \"strain\",", "solve FILE"),
    ("a scene that is no JSON", "plane: strain", "solve FILE"),
    ("a mistyped variant", "", "solve fig1 --variant tyed"),
    ("a mistyped option", "", "solve fig1 --varient tied"),
    ("a reading that is not there", "", "solve fig1 --reading R9=odd"),
    ("another program in place of c_cnt", "f(n) :=\n  n\n", "solve fig1 --c-cnt FILE"),
    ("a finding that is not there", "", "audit --finding X9"),
    ("a generator that is not there", "", "scene mesh donut"),
    (
        "a listing with a bracket too few",
        "f(n) :=\n  (n + 1\n",
        "listing evaluate FILE --call f(1)",
    ),
    (
        "a call of a program that is not there",
        "f(n) :=\n  n\n",
        "listing evaluate FILE --call g(1)",
    ),
    ("a snapshot that is none", "{}", "snapshot verify FILE"),
    ("a sweep without a format", "{\"scene\": \"fig1\"}", "sweep run FILE"),
    ("a worksheet that is no XML", "worksheet", "mathcad run FILE"),
];

/// Changes the field at a JSON pointer to `value`, or leaves it out.
fn change(scene: &mut Value, pointer: &str, value: &str) {
    let (parent, field) = pointer.rsplit_once('/').expect("a pointer");
    let parent = scene.pointer_mut(parent).expect(pointer);
    match (parent, value) {
        (Value::Object(fields), "") => drop(fields.remove(field).expect("a field")),
        (Value::Object(fields), value) => {
            let value = serde_json::from_str(value).expect("JSON");
            fields.insert(field.into(), value);
        }
        (Value::Array(items), value) => {
            let k: usize = field.parse().expect("a place");
            items[k] = serde_json::from_str(value).expect("JSON");
        }
        _ => panic!("{pointer} is in no object and no list"),
    }
}

/// The row of a mistake: what it is, the exit status, and the message.
#[track_caller]
fn row(folder: &Path, mistake: &str, command: &str, file: &str) -> String {
    let name = "input.json";
    std::fs::write(folder.join(name), file).expect("it is written");
    let args: Vec<&str> =
        command.split(' ').map(|word| if word == "FILE" { name } else { word }).collect();
    let output = run(folder, &args);
    let text = String::from_utf8(output.stderr).expect("UTF-8");
    let status = output.status.code().expect("it exits by itself");
    assert_eq!(status, 2, "{mistake}: {text}");
    let message = text.strip_prefix("error: ").unwrap_or_else(|| panic!("{mistake}: {text}"));
    // The command line's own messages end with how to get help.
    let message = message.split("\n\nUsage").next().expect("a text").trim_end();
    for word in ["panicked", "struct ", "f64", "usize", "u64", "NaN"] {
        assert!(!message.contains(word), "{mistake}: {word:?} is in {message}");
    }
    let message = message.replace('|', "\\|").replace('\n', "<br>");
    format!("| {mistake} | {message} |\n")
}

#[test]
fn mistakes_have_their_messages() {
    let folder = TempDir::new().expect("a folder");
    let mut table = String::from(
        "# Mistakes and their messages\n\nEach ends with exit status 2 and writes no file; under \
         `--json` the message is a document. Scenes are `fig1` with the mistake in it.\n\n\
         | mistake | message |\n|---|---|\n",
    );
    for (mistake, changes) in SCENES {
        let mut scene = scene_json("fig1");
        changes.iter().for_each(|(pointer, value)| change(&mut scene, pointer, value));
        table += &row(folder.path(), mistake, "solve FILE", &scene.to_string());
    }
    for (mistake, file, command) in OTHERS {
        table += &row(folder.path(), mistake, command, file);
    }
    let left = std::fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(left, 1, "no file is written but the mistakes'");
    assert!(SCENES.len() + OTHERS.len() >= 60);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    assert_file(&root.join("golden/mistakes.md"), &table);
}
