//! What has no value is `-` in tables and null in files, with its reason, and never inf or NaN.

use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;
use crate::oracles::sound::{nulls, text as has_no_undefined_number};

/// A block under a stamp that is held by itself and pushed into it: `load` acts on the stamp's one
/// contact node, `gap` above the block.
fn scene(load: f64, gap: f64) -> Value {
    json!({
        "plane": "strain",
        "node": [
            [1, 0.0, 0.0, 0.0], [2, 1.0, 0.0, 0.0], [3, 0.0, -1.0, 0.0], [4, 1.0, -1.0, 0.0],
            [5, 0.5, gap, 0.0], [6, 1.5, 1.0, 0.0], [7, 0.5, 1.0, 0.0]
        ],
        "elem": [
            [1, 1, 2, 10, 10, 1, 2], [2, 2, 2, 1, 1, 1, 3, 2], [3, 2, 2, 1, 1, 3, 4, 2],
            [4, 2, 2, 2, 2, 5, 6, 7]
        ],
        "materials": { "1": { "E": 4.0, "nu": 0.0 }, "2": { "E": 4.0, "nu": 0.0 } },
        "restraints": [
            { "node": 3, "fix": ["x", "y"] }, { "node": 4, "fix": ["x", "y"] },
            { "node": 6, "fix": ["x", "y"] }, { "node": 7, "fix": ["x", "y"] }
        ],
        "loads": [{ "node": 5, "force": [0.0, load] }],
        "contact": { "cnt": [5], "trg": [1], "c_tll": 0.1, "coupling": "nts", "friction": "stick" },
        "variant": "unilateral"
    })
}

/// Runs the program on `scene.json`; gives back its exit status and both of its outputs.
fn output(folder: &Path, scene: &Value, args: &[&str]) -> (Option<i32>, String) {
    std::fs::write(folder.join("scene.json"), scene.to_string()).unwrap();
    let output = run(folder, args);
    let text = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    (output.status.code(), text.concat())
}

#[track_caller]
fn is_explained(text: &str) {
    let document: Value = serde_json::from_str(text).expect("JSON");
    let found = nulls(&document, "");
    assert!(!found.is_empty(), "there is no null: {text}");
    for field in found {
        let reason = document["nulls"][field].as_str().unwrap_or_default();
        assert!(reason.len() > 10 && reason != "there is none", "{field}: {reason:?}");
    }
}

#[test]
fn a_share_of_nothing_is_a_dash_with_its_reason() {
    let folder = TempDir::new().unwrap();
    for load in [-0.2, 0.0] {
        let (status, text) =
            output(folder.path(), &scene(load, 0.0), &["solve", "scene.json", "--out", "o"]);
        assert_eq!(status, Some(0), "{text}");
        has_no_undefined_number(&text);
        let file = folder.path().join("o/result.json");
        is_explained(&std::fs::read_to_string(file).expect("the file is there"));
    }
}

#[test]
fn a_trade_of_what_does_not_move_has_no_undefined_number() {
    let folder = TempDir::new().unwrap();
    let nothing = scene(0.0, 0.0);
    for parameter in ["mesh", "solver", "arithmetic"] {
        let args = ["trade", "scene.json", "--runs", "1", "--only", parameter];
        let (status, text) = output(folder.path(), &nothing, &args);
        assert_eq!(status, Some(0), "{text}");
        has_no_undefined_number(&text);
        let (_, json) = output(folder.path(), &nothing, &[&args[..], &["--json"]].concat());
        is_explained(&json);
    }
}
