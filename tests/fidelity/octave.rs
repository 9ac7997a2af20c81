//! Octave, an interpreter that is not ours, on the exported listings.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use plane_contact::engine::{self, Request};
use plane_contact::mathcad::array::Table;
use plane_contact::output::exports::{Export, octave};
use plane_contact::paper::mirror::{Km, Pairs, Reading, Worksheet, c_cnt};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use tempfile::TempDir;

use crate::common::program::run;
use crate::common::random::fixed;
use crate::common::tolerances::{OCTAVE, assert_near};
use crate::common::tools::has;
use testing::worksheets::{draw, initial, reading, worksheet};

/// What Octave printed of a program: by name, the numbers column by column; nothing if it failed.
type Printed = BTreeMap<String, Vec<f64>>;

fn octave_is_there() -> bool {
    has("octave-cli --version", "REQUIRE_OCTAVE")
}

/// Runs the scripts in `folder`, each in turn, from another folder.
fn execute(folder: &Path, names: &[String]) -> Vec<Option<Printed>> {
    let each = |name: &String| {
        format!("disp('BEGIN'); try; source('{name}'); catch e; disp('FAILED'); end\n")
    };
    let driver: String = names.iter().map(each).collect();
    let elsewhere = folder.join("elsewhere");
    std::fs::create_dir_all(&elsewhere).expect("a folder");
    std::fs::write(elsewhere.join("driver.m"), driver).expect("a file");
    let output = Command::new("octave-cli")
        .args(["--no-init-file", "--eval", "driver"])
        .current_dir(elsewhere)
        .output()
        .expect("Octave starts");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let runs: Vec<_> = text.split("BEGIN\n").skip(1).map(printed).collect();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(runs.len(), names.len(), "Octave stopped: {errors}");
    runs
}

fn printed(text: &str) -> Option<Printed> {
    let line = |line: &str| {
        let mut words = line.split(' ');
        let name = words.next().expect("a name").to_string();
        (name, words.skip(2).map(|word| word.parse().expect("a number")).collect())
    };
    (!text.contains("FAILED")).then(|| text.lines().map(line).collect())
}

/// Checks that Octave's pairs and matrix have the mirror's bits.
fn assert_same(printed: &Printed, pairs: &Pairs<f64>, mjs: &Table<f64>, what: &str) {
    let whole = |column: &[usize]| column.iter().map(|n| *n as f64).collect::<Vec<_>>();
    assert_eq!(printed["ct"], whole(pairs.ct.as_slice()), "ct of {what}");
    assert_eq!(printed["dy"], whole(pairs.dy.as_slice()), "dy of {what}");
    assert_eq!(printed["yt"], pairs.yt.as_slice(), "yt of {what}");
    assert_eq!(printed["k_cnt"], pairs.k_cnt.as_matrix().as_slice(), "k_cnt of {what}");
    assert_eq!(printed["MJS"], mjs.as_matrix().as_slice(), "MJS of {what}");
}

#[test]
fn octave_has_the_mirror_s_bits_on_random_scenes() {
    if !octave_is_there() {
        return;
    }
    let folder = TempDir::new().expect("a folder");
    let mut runner = proptest::test_runner::TestRunner::new(fixed(1));
    let (mut names, mut expected) = (vec![], vec![]);
    while expected.len() < 200 {
        let draw = draw().new_tree(&mut runner).expect("a scene").current();
        let reading = reading().new_tree(&mut runner).expect("a reading").current();
        let (sheet, node_n): (Worksheet<f64>, _) = worksheet(&draw);
        // Octave knows no overflow: scenes on which the listings run.
        let Ok(pairs) = c_cnt(&sheet, &reading, &node_n) else { continue };
        let Ok(mjs) = Km(&sheet, &reading, &pairs.k_cnt).map(|m| m.to_table()) else { continue };
        if sheet.B.iter().any(|b| b.iter().any(|x| !x.is_finite())) {
            continue;
        }
        let name = format!("../scene-{}.m", expected.len());
        let export = Export {
            title: "random",
            sheet: &sheet,
            reading: &reading,
            node_n: &node_n,
            thickness: 1.0,
            run: None,
        };
        std::fs::write(folder.path().join(&name[3..]), octave::program(&export)).expect("a file");
        names.push(name);
        expected.push((pairs, mjs));
    }
    for (k, printed) in execute(folder.path(), &names).iter().enumerate() {
        let printed = printed.as_ref().unwrap_or_else(|| panic!("Octave failed on scene {k}"));
        assert_same(printed, &expected[k].0, &expected[k].1, &names[k]);
    }
}

#[test]
fn octave_has_our_displacements_on_shipped_scenes() {
    if !octave_is_there() {
        return;
    }
    let folder = TempDir::new().expect("a folder");
    for scene in ["fig1", "two-blocks"] {
        let file = format!("{scene} 1.m");
        let written = run(
            folder.path(),
            &["mathcad", "export", scene, "--to", "octave", "--out", file.as_str()],
        );
        assert!(written.status.success(), "{}", String::from_utf8_lossy(&written.stderr));
        let printed = execute(folder.path(), &[format!("../{file}")]).remove(0).expect("it runs");
        let sheet = initial(scene);
        let reading = Reading::default();
        let pairs = c_cnt(&sheet, &reading, &sheet.node).unwrap();
        assert_same(
            &printed,
            &pairs,
            &Km(&sheet, &reading, &pairs.k_cnt).unwrap().to_table(),
            scene,
        );
        let request = Request::new(&Scene::open(scene).unwrap()).variant(Variant::Printed);
        let u = engine::solve(&request, &mut |_| ()).unwrap().u;
        let largest = u.amax();
        for (ours, theirs) in u.iter().zip(&printed["U"]) {
            assert_near(scene, *theirs, *ours, largest, &OCTAVE);
        }
        // Beside each result stands ours, and the largest difference.
        assert_eq!(printed["ours_U"], u.as_slice(), "{scene}");
        assert_near(scene, printed["difference_U"][0], 0.0, largest, &OCTAVE);
        for name in ["ct", "yt", "dy", "k_cnt"] {
            assert_eq!(printed[&format!("ours_{name}")], printed[name], "{name} of {scene}");
            assert_eq!(printed[&format!("difference_{name}")], [0.0], "{name} of {scene}");
        }
    }
}

/// The corrected algorithm in Octave, whose solver is another, ends where ours does.
#[test]
fn octave_executes_the_corrected_algorithm() {
    if !octave_is_there() {
        return;
    }
    let folder = TempDir::new().expect("a folder");
    for scene in ["fig1", "two-blocks"] {
        let file = format!("{scene}.m");
        let export = ["mathcad", "export", scene, "--corrected", "--to", "octave", "--out", &file];
        assert!(run(folder.path(), &export).status.success(), "{scene}");
        let printed = execute(folder.path(), &[format!("../{file}")]).remove(0).expect("it runs");
        let ours = &printed["ours_U"];
        let largest = ours.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(largest > 0.0, "{scene}");
        assert_near(scene, printed["difference_U"][0], 0.0, largest, &OCTAVE);
    }
}
