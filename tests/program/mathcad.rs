//! The commands of Mathcad's users: `listing evaluate`, `mathcad`.

use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::program::run;
use crate::common::tolerances::{OCTAVE, assert_near};

/// Runs the program in `folder`; returns its exit status, its output and its messages.
fn ran(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = run(folder, args);
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("a status"), text(output.stdout), text(output.stderr))
}

const FACTORIAL: &str = "# two functions, one of which calls itself
fact(n) :=
  trace(n)
  return 1 if n ≤ 1
  n·fact(n − 1)
both(v) :=
  for k ∈ 1 .. rows(v)
    w[k] ← fact(v[k])
  w
";

#[test]
fn evaluate_runs_any_program() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    std::fs::write(at.join("fact.txt"), FACTORIAL).expect("a file");
    let evaluate = |args: &[&str]| ran(at, &[&["listing", "evaluate", "fact.txt"], args].concat());
    let (status, text, _) =
        evaluate(&["--call", "both(v)", "--inputs", "{\"v\": [3, 4]}", "--json"]);
    assert_eq!(status, 0);
    let value: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(value["value"], json!([[6.0], [24.0]]));
    assert_eq!(value["trace"], json!(["3", "2", "1", "4", "3", "2", "1"]));
    assert_eq!(value["format"], 1);
    assert_eq!(
        evaluate(&["--inputs", "{\"n\": 2}"]).1,
        "trace: 2\ntrace: 1\n2\n",
        "the first by name"
    );
    let (status, text, why) = evaluate(&["--call", "both(3)", "--json"]);
    assert_eq!((status, why.is_empty()), (2, false));
    let error: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!((&error["error"]["line"], &error["error"]["text"]), (&json!(3), &json!("v[k]")));
    assert!(evaluate(&["--call", "fact(1000)"]).2.contains("levels of calls"));
    assert_eq!(evaluate(&["--call", "fact(0)", "--settings", "origin=0"]).0, 0);
    for wrong in [
        &["--call", "fact("][..],
        &["--inputs", "[1]"],
        &["--inputs", "{\"n\": {}}"],
        &["--settings", "origin=x"],
        &["--settings", "colour=1"],
    ] {
        assert_eq!(evaluate(wrong).0, 2, "{wrong:?}");
    }
    std::fs::write(at.join("fact.txt"), "f(x) :=\n  x\n\ng(x) :=\n  x +\n").expect("a file");
    let (status, _, why) = evaluate(&["--call", "f(1)"]);
    assert_eq!(status, 2);
    assert!(why.contains("line 5 of the file"), "{why}");
}

#[test]
fn what_is_no_worksheet_is_refused() {
    let folder = TempDir::new().expect("a folder");
    std::fs::write(folder.path().join("no.xmcd"), "<html/>").expect("a file");
    let (status, _, why) = ran(folder.path(), &["mathcad", "run", "no.xmcd"]);
    assert_eq!(status, 2);
    assert!(why.contains("no worksheet but <html>"), "{why}");
    for (start, words) in
        [("PK\u{3}\u{4}x", "Mathcad Prime"), (".MCAD 304 1", "Mathcad 11 or an older")]
    {
        std::fs::write(folder.path().join("no.xmcd"), start).expect("a file");
        let (status, _, why) = ran(folder.path(), &["mathcad", "run", "no.xmcd"]);
        assert!(status == 2 && why.contains(words), "{why}");
    }
}

/// One result agrees, and another region fails here where nothing is saved.
#[test]
fn a_region_that_fails_here_alone_counts() {
    let folder = TempDir::new().expect("a folder");
    let one = "<real>1</real>";
    let text = format!(
        "<worksheet><regions><region><math><eval>{one}<result>{one}</result></eval></math></region>\
         <region><math><eval><apply><div/>{one}<real>0</real></apply></eval></math></region></regions>\
         </worksheet>"
    );
    std::fs::write(folder.path().join("s.xmcd"), text).expect("a file");
    let (status, said, _) = ran(folder.path(), &["mathcad", "run", "s.xmcd"]);
    assert_eq!(status, 1);
    assert!(said.contains("1 results same to the last bit"), "{said}");
    assert!(said.contains("1 regions fail here alone"), "{said}");
}

/// Exports a scene, and returns the differences that the worksheet shows between what it computes
/// and what it was given as ours.
fn differences(at: &Path, scene: &str) -> Vec<f64> {
    assert_eq!(
        ran(at, &["mathcad", "export", scene, "--to", "mathcad", "--out", "sheet.xmcd"]).0,
        0
    );
    let (_, text, _) = ran(at, &["mathcad", "run", "sheet.xmcd", "--json"]);
    let sheet: Value = serde_json::from_str(&text).expect("JSON");
    let regions = sheet["regions"].as_array().expect("regions").iter();
    let is =
        |region: &&Value| region["tag"].as_str().is_some_and(|tag| tag.starts_with("difference"));
    regions.filter(is).map(|region| region["value"].as_f64().expect("a number")).collect()
}

/// A strand of 269 nodes, near the most that are exported, runs through all its iterations.
#[test]
fn the_largest_worksheets_end() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    let mesh = [
        "scene", "mesh", "strand", "--duct", "12.2", "--strand", "12", "--size", "1.9", "--out",
        "small",
    ];
    assert!(ran(at, &mesh).1.starts_with("269 nodes"));
    let [pairs, displacements, stresses] = differences(at, "small")[..] else { panic!("three") };
    assert_eq!(pairs, 0.0, "bit for bit");
    // Its largest displacement and stress are of these sizes, in mm and MPa.
    assert_near("displacements", displacements, 0.0, 0.1, &OCTAVE);
    assert_near("stresses", stresses, 0.0, 100.0, &OCTAVE);
}

#[test]
fn scenes_become_worksheets() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    let differences = differences(at, "fig1");
    let [pairs, matrix, displacements, stresses] = differences[..] else {
        panic!("{differences:?}")
    };
    assert_eq!([pairs, matrix], [0.0, 0.0], "bit for bit");
    // fig1's largest displacement and stress are of these sizes, in mm and MPa.
    assert_near("displacements", displacements, 0.0, 1e-4, &OCTAVE);
    assert_near("stresses", stresses, 0.0, 8.0, &OCTAVE);
    let (status, _, why) = ran(at, &["mathcad", "export", "strand", "--to", "mathcad"]);
    assert_eq!(status, 2);
    assert!(why.contains("at most 300 are written"), "{why}");
    assert_eq!(ran(at, &["mathcad", "export"]).0, 2, "no scene");
}
