//! What has no value is `-` in tables and null in files, with its reason, and never inf or NaN; and
//! what tables would leave to be guessed is said.

use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;
use crate::oracles::sound::{nulls, text as has_no_undefined_number};

/// A block under a stamp that is held by itself and pushed into it: `load` acts on the stamp's one
/// contact node, `gap` above the block.
pub fn scene(load: f64, gap: f64) -> Value {
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
fn is_explained(file: &Path) {
    let text = std::fs::read_to_string(file).expect("the file is there");
    let document: Value = serde_json::from_str(&text).expect("JSON");
    let found = nulls(&document, "");
    assert!(!found.is_empty(), "{} has no null", file.display());
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
        is_explained(&folder.path().join("o/result.json"));
    }
    let (_, text) = output(folder.path(), &scene(-0.2, 0.0), &["solve", "scene.json"]);
    assert!(text.contains("  -: the value compared with is 0\n"), "{text}");
}

#[test]
fn a_trade_of_what_does_not_move_has_no_undefined_number() {
    let folder = TempDir::new().unwrap();
    let nothing = scene(0.0, 0.0);
    for parameter in ["mesh", "solver", "arithmetic"] {
        let args = ["trade", "scene.json", "--runs", "1", "--out", "t", "--only", parameter];
        let (status, text) = output(folder.path(), &nothing, &args);
        assert_eq!(status, Some(0), "{text}");
        has_no_undefined_number(&text);
        is_explained(&folder.path().join("t/trade.json"));
    }
}

/// Under `tied` the block's free stamp is not held: its first contact fails.
#[test]
fn a_first_contact_that_fails_names_gap_tolerance_and_a_way_out() {
    let folder = TempDir::new().unwrap();
    let mut free = scene(-0.2, 0.25);
    free["restraints"] =
        json!([{ "node": 3, "fix": ["x", "y"] }, { "node": 4, "fix": ["x", "y"] }]);
    let (status, text) =
        output(folder.path(), &free, &["solve", "scene.json", "--variant", "tied"]);
    assert_eq!(status, Some(3), "{text}");
    let words = "the gap nearest to 0 is 2.5e-1, and c_tll is 1e-1; move the bodies together, or give a \
                 larger c_tll";
    assert!(text.contains(words), "{text}");
}

#[test]
fn every_option_that_changes_the_result_is_in_the_folder() {
    let folder = TempDir::new().unwrap();
    let options = [
        "--coupling mortar",
        "--friction 0.3",
        "--geometry initial",
        "--load-steps 8",
        "--status intersection",
        "--scalar f32",
        "--solver dense-lu",
        "--inputs decimal",
        "--reading R3=nested",
        "--reading R3=per-node",
        "--accuracy 1e-3",
        "--variant printed",
        "",
    ];
    for option in options {
        let args: Vec<&str> =
            ["solve", "fig1"].into_iter().chain(option.split_whitespace()).collect();
        assert_eq!(run(folder.path(), &args).status.code(), Some(0), "{option}");
    }
    let folders = std::fs::read_dir(folder.path().join("out")).unwrap().count();
    assert_eq!(folders, options.len());
}

/// Under `unilateral` what rounding does is measured where that is asked for, under the paper's variants as it is.
#[test]
fn what_rounding_does_is_measured() {
    let folder = TempDir::new().unwrap();
    let args = ["solve", "two-blocks", "--variant", "unilateral", "--check-rounding", "--json"];
    let (status, text) = output(folder.path(), &scene(-0.2, 0.0), &args);
    assert_eq!(status, Some(0), "{text}");
    let document: Value = serde_json::from_str(&text).expect("JSON");
    let measured = &document["rounding"];
    assert_eq!((&measured["runs"], &measured["contact"]), (&json!(3), &Value::Null));
    assert!(measured["displacement"].as_f64().is_some_and(|part| part < 1e-9), "{measured}");
}

/// What `trade` is asked stands in the name of its folder.
#[test]
fn the_folder_of_trade_names_its_options() {
    let folder = TempDir::new().unwrap();
    for (options, name) in [
        ("--only symmetry", "trade-fig1-symmetry"),
        ("--only symmetry,status", "trade-fig1-symmetry-status"),
        ("--only symmetry --runs 1", "trade-fig1-symmetry-runs-1"),
        ("--only symmetry --reading R3=nested", "trade-fig1-R3=nested-symmetry"),
    ] {
        let args: Vec<&str> =
            ["trade", "fig1"].into_iter().chain(options.split_whitespace()).collect();
        assert_eq!(run(folder.path(), &args).status.code(), Some(0), "{options}");
        let out = folder.path().join("out").join(name);
        assert!(out.join("trade.json").exists(), "{options}: no {name}");
    }
}

#[test]
fn printed_says_what_its_pressures_are() {
    let folder = TempDir::new().unwrap();
    let text = |variant| {
        let output = run(folder.path(), &["solve", "fig1", "--variant", variant]);
        String::from_utf8(output.stdout).unwrap()
    };
    let words = "none of it reaches the other body";
    assert!(text("printed").contains(words));
    assert!(!text("tied").contains(words));
}
