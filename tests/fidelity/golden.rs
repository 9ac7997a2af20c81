//! Golden files: what each shipped scene must produce.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use crate::common::golden_file::assert_text;
use crate::common::same_text::same_text;
use plane_contact::engine::Request;
use plane_contact::mathcad::array::Table;
use plane_contact::paper::door;
use plane_contact::paper::mirror::{Km, Reading, c_cnt};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{SCENES, Scene};
use plane_contact::studies::snapshot::verified_file::{self as report, VerifiedFile};
use plane_contact::studies::snapshot::{Snapshot, verify};

/// A float for a golden file: 12 significant digits, 0 as `0`.
pub fn number(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{x:.11e}") }
}

/// `golden/*/snapshot.json`: facts of every iteration, displacements, stresses, reactions and the contact
/// surface; of every shipped scene, under each variant. A golden snapshot changes by
/// `plane-contact snapshot accept` only.
#[test]
fn golden_snapshots_are_verified() {
    let golden = concat!(env!("CARGO_MANIFEST_DIR"), "/golden");
    let mut verified = BTreeSet::new();
    for folder in std::fs::read_dir(golden).expect("a folder") {
        let file = folder.expect("an entry").path().join("snapshot.json");
        let Ok(text) = std::fs::read(&file) else { continue };
        let snapshot = Snapshot::read(&text).expect("a snapshot");
        let name = snapshot.input.name.clone();
        // A shipped scene as it is today, so that a change of scene.json is a difference too.
        let today = SCENES
            .iter()
            .find(|scene| scene.name == name)
            .map(|scene| Scene::open(scene.name).expect("embedded scenes are sound"));
        if today.is_some() {
            let variants: Vec<_> =
                snapshot.runs.iter().filter_map(|(_, run)| run.options.variant).collect();
            assert!(Variant::ALL.iter().all(|variant| variants.contains(variant)), "{variants:?}");
        }
        let found = verify(&snapshot, today.as_ref(), &|| ()).expect("it runs");
        assert_eq!(found.input, snapshot.input, "{name} is not of the scene beside it");
        let same = found.is_same();
        let file = file.display().to_string();
        let report =
            report::report(&[VerifiedFile { file, scene: None, verified: Ok(found) }], true);
        assert!(same, "{}", report.text(usize::MAX));
        verified.insert(name);
    }
    let shipped = SCENES.iter().map(|scene| scene.name.to_string());
    assert_eq!(verified, shipped.chain(["rubbing".to_string()]).collect());
}

/// MJS of `fig1` whole, a matrix row a line with its number.
#[test]
fn mjs_of_fig1() {
    let request = Request::new(&Scene::open("fig1").unwrap());
    let sheet = door::worksheet(&request.model().unwrap(), |x| x);
    let pairs = c_cnt(&sheet, &Reading::default(), &sheet.node).unwrap();
    let coupled = Km(&sheet, &Reading::default(), &pairs.k_cnt).unwrap().to_table();
    let free = Km(&sheet, &Reading::default(), &Table::filled(13, 4, 0.0)).unwrap().to_table();
    assert_text("golden/fig1/MJS.snap", &rows(&coupled), same_text);
    assert_text("golden/fig1/MJS-coupled-by-none.snap", &rows(&free), same_text);
}

fn rows(matrix: &Table<f64>) -> String {
    let mut text = String::new();
    for i in 1..=matrix.rows() {
        let cells: Vec<String> = matrix.row(i).map(|x| number(*x)).collect();
        writeln!(text, "{i}: {}", cells.join(" ")).unwrap();
    }
    text
}
