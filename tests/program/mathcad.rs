//! Worksheets that `mathcad export` writes, executed.

use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::common::program::ran;
use crate::common::tolerances::{OCTAVE, assert_near};

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
}
