//! Golden files: what each shipped scene must produce.

use std::fmt::Write as _;

use crate::common::golden_floats::{assert_golden, same_text};
use plane_contact::engine::Request;
use plane_contact::mathcad::array::Table;
use plane_contact::paper::door;
use plane_contact::paper::mirror::{Km, Reading, c_cnt};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{SCENES, Scene};
use plane_contact::report::snapshot::{self as report, VerifiedFile};
use plane_contact::studies::snapshot::{Snapshot, verify};

/// A float for a golden file: 12 significant digits, 0 as `0`.
pub fn number(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{x:.11e}") }
}

#[test]
fn integers_are_exact_and_floats_within_the_tolerance_of_their_line() {
    assert!(same_text("1: 2 0.5e0 1.0e3", "1: 2 0.5000001e0 1.0e3"));
    assert!(!same_text("1: 2 0.5e0 1.0e3", "1: 2 0.51e0 1.0e3"));
    assert!(!same_text("1: 2 0.5e0", "1: 3 0.5e0"));
    assert!(!same_text("1: 2", "1: 2\n2: 2"));
    assert!(!same_text("yes", "no"));
}

/// `golden/<scene>/snapshot.json` of every shipped scene: facts of every iteration, displacements,
/// stresses, reactions and the contact surface of every variant. A golden snapshot changes by
/// `plane-contact snapshot accept` only.
#[test]
fn snapshots_of_every_scene_and_variant() {
    for scene in SCENES {
        let file = format!("{}/golden/{}/snapshot.json", env!("CARGO_MANIFEST_DIR"), scene.name);
        let text = std::fs::read(&file).expect("the scene has a snapshot");
        let snapshot = Snapshot::read(&text).expect("a snapshot");
        let variants: Vec<_> =
            snapshot.runs.iter().filter_map(|(_, run)| run.options.variant).collect();
        assert!(Variant::ALL.iter().all(|variant| variants.contains(variant)), "{variants:?}");
        // The scene as it is today, so that a change of scene.json is a difference too.
        let today = Scene::open(scene.name).expect("embedded scenes are sound");
        let verified = verify(&snapshot, Some(&today), &|| ()).expect("it runs");
        let same = verified.is_same();
        assert_eq!(verified.input, snapshot.input, "{file} is not of the scene beside it");
        assert!(
            same,
            "{}",
            report::report(&[VerifiedFile { file, verified: Ok(verified) }]).text(usize::MAX)
        );
    }
}

/// MJS of `fig1` whole, a matrix row a line with its number.
#[test]
fn mjs_of_fig1() {
    let request = Request::new(&Scene::open("fig1").unwrap());
    let sheet = door::worksheet(&request.model().unwrap(), |x| x);
    let pairs = c_cnt(&sheet, &Reading::default(), &sheet.node).unwrap();
    let coupled = Km(&sheet, &Reading::default(), &pairs.k_cnt).unwrap().to_table();
    let free = Km(&sheet, &Reading::default(), &Table::filled(13, 4, 0.0)).unwrap().to_table();
    assert_golden("fig1", "MJS", &rows(&coupled));
    assert_golden("fig1", "MJS-coupled-by-none", &rows(&free));
}

fn rows(matrix: &Table<f64>) -> String {
    let mut text = String::new();
    for i in 1..=matrix.rows() {
        let cells: Vec<String> = matrix.row(i).map(|x| number(*x)).collect();
        writeln!(text, "{i}: {}", cells.join(" ")).unwrap();
    }
    text
}

/// No golden file is left that no test compares with.
#[test]
fn every_golden_file_is_used() {
    for scene in SCENES {
        // By this program, and by `tests/program/texts.rs`.
        let by_variant = |variant: &Variant| format!("solve-{variant}.snap");
        let once = ["audit", "plan", "c_cnt"].map(|name| format!("{name}.snap"));
        let mut expected: Vec<String> = Variant::ALL.iter().map(by_variant).chain(once).collect();
        if scene.name == "fig1" {
            let decks = ["tied", "unilateral", "pair"].map(|deck| format!("calculix-{deck}"));
            let matrices = ["MJS", "MJS-coupled-by-none"].map(String::from);
            let texts = ["claim", "report", "report-ru"].map(String::from);
            let own = matrices.into_iter().chain(texts).chain(decks);
            expected.extend(own.map(|name| name + ".snap"));
        }
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/golden");
        for entry in std::fs::read_dir(format!("{folder}/{}", scene.name)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            assert!(!name.ends_with(".snap") || expected.contains(&name), "{name} is not compared");
        }
    }
}
