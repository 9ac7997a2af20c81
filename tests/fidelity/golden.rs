//! Golden files: what each shipped scene must produce.

use std::fmt::Write as _;

use crate::common::golden_floats::{assert_golden, same_text};
use crate::common::outcome::solve;
use plane_contact::answer::contact::Outcome;
use plane_contact::paper::mathcad::array::Table;
use plane_contact::paper::mirror::{Km, Pairs, Reading, Worksheet, c_cnt};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{SCENES, Scene};

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

/// c_cnt's outcome at every iteration: ct, yt and dy by contact node, then the rows of k_cnt that are not zero.
#[test]
fn pairs_at_every_iteration() {
    for scene in SCENES {
        for variant in Variant::ALL {
            let (_, outcome) = solve(scene.name, *variant);
            assert_golden(scene.name, &format!("c_cnt-{variant}"), &iterations(&outcome));
        }
    }
}

fn iterations(outcome: &Outcome) -> String {
    let mut text = String::new();
    let mut last = None;
    for it in &outcome.iterations {
        writeln!(text, "iteration {}", it.k).unwrap();
        if last == Some(&it.pairs) {
            writeln!(text, "  as before").unwrap();
        } else {
            text += &pairs(&outcome.sheet, &it.pairs);
        }
        last = Some(&it.pairs);
    }
    text
}

fn pairs(sheet: &Worksheet<f64>, pairs: &Pairs<f64>) -> String {
    let mut text = String::new();
    for i1 in (1..=sheet.cnt.rows()).filter(|&i1| pairs.ct[i1] > 0) {
        let (cnt, ct, dy, yt) = (sheet.cnt[i1], pairs.ct[i1], pairs.dy[i1], number(pairs.yt[i1]));
        writeln!(text, "  i1 {i1}: cnt {cnt} ct {ct} dy {dy} yt {yt}").unwrap();
    }
    for n in 1..=sheet.R() {
        let row: Vec<f64> = pairs.k_cnt.row(n).copied().collect();
        if row.iter().any(|x| *x != 0.0) {
            let (k1, k2) = (number(row[1]), number(row[3]));
            writeln!(text, "  k_cnt {n}: {} {k1} {} {k2}", row[0], row[2]).unwrap();
        }
    }
    text
}

/// MJS of `fig1` whole, a matrix row a line with its number.
#[test]
fn mjs_of_fig1() {
    let sheet = Scene::open("fig1").unwrap().worksheet(&Reading::default()).unwrap();
    let pairs = c_cnt(&sheet, &Reading::default(), &sheet.node).unwrap();
    let coupled = Km(&sheet, &Reading::default(), &pairs.k_cnt).unwrap();
    let free = Km(&sheet, &Reading::default(), &Table::filled(13, 4, 0.0)).unwrap();
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

/// The summary of every variant: iterations, then bodies. A float a line, for the tolerance is relative to the line.
#[test]
fn summary_of_every_variant() {
    for scene in SCENES {
        let mut text = String::new();
        for variant in Variant::ALL {
            let (scene, outcome) = solve(scene.name, *variant);
            text += &summary(&scene, &outcome);
        }
        assert_golden(scene.name, "summary", &text);
    }
}

fn summary(scene: &Scene, outcome: &Outcome) -> String {
    let mut text = format!("variant {}\n", outcome.variant);
    for it in &outcome.iterations {
        let cycle =
            it.cycle.as_ref().map_or("new".to_string(), |c| format!("cycle {:?}", c.members));
        let (u, force) = (number(it.max_displacement), number(it.target_force));
        writeln!(text, "  {}: in contact {} u {u} force {force} {cycle}", it.k, it.in_contact)
            .unwrap();
    }
    for body in &scene.bodies {
        let of =
            |f: &dyn Fn(usize) -> f64| body.triangles.iter().map(|n| f(n - 1)).fold(0.0, f64::max);
        let stress = number(of(&|n| outcome.elements[n].von_mises_stress));
        let strain = number(of(&|n| outcome.elements[n].von_mises_strain));
        writeln!(text, "  body {}:", body.name).unwrap();
        writeln!(text, "     von Mises stress {stress}\n     von Mises strain {strain}").unwrap();
    }
    text
}

/// No golden file is left that no test compares with.
#[test]
fn every_golden_file_is_used() {
    for scene in SCENES {
        let mut expected: Vec<String> =
            Variant::ALL.iter().map(|variant| format!("c_cnt-{variant}.snap")).collect();
        expected.push("summary.snap".into());
        if scene.name == "fig1" {
            expected.extend(["MJS.snap".into(), "MJS-coupled-by-none.snap".into()]);
            expected
                .extend(["tied", "unilateral", "pair"].map(|deck| format!("calculix-{deck}.snap")));
        }
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/golden");
        for entry in std::fs::read_dir(format!("{folder}/{}", scene.name)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            assert!(!name.ends_with(".snap") || expected.contains(&name), "{name} is not compared");
        }
    }
}
