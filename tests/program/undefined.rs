//! What has no value is `-` in tables and null in files, with its reason, and never inf or NaN.

use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::common::program::run;
use crate::oracles::sound::{nulls, text as has_no_undefined_number};

/// A block under a stamp that is held by itself and touches it; `load` acts on the stamp's one contact node.
fn scene(load: &str) -> String {
    include_str!("undefined.json").replace("LOAD", load)
}

/// Runs the program on `scene.json`; gives back its exit status and both of its outputs.
fn output(folder: &Path, scene: &str, args: &[&str]) -> (Option<i32>, String) {
    std::fs::write(folder.join("scene.json"), scene).unwrap();
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
    for load in ["-0.2", "0.0"] {
        let (status, text) =
            output(folder.path(), &scene(load), &["solve", "scene.json", "--out", "o"]);
        assert_eq!(status, Some(0), "{text}");
        has_no_undefined_number(&text);
        let file = folder.path().join("o/result.json");
        is_explained(&std::fs::read_to_string(file).expect("the file is there"));
    }
}

#[test]
fn a_trade_of_what_does_not_move_has_no_undefined_number() {
    let folder = TempDir::new().unwrap();
    let nothing = scene("0.0");
    for parameter in ["mesh", "solver", "arithmetic"] {
        let args = ["trade", "scene.json", "--runs", "1", "--only", parameter];
        let (status, text) = output(folder.path(), &nothing, &args);
        assert_eq!(status, Some(0), "{text}");
        has_no_undefined_number(&text);
        let (_, json) = output(folder.path(), &nothing, &[&args[..], &["--json"]].concat());
        is_explained(&json);
    }
}
