//! Golden files: what each shipped scene must produce.

use std::fmt::Write as _;

use crate::common::golden_floats::{assert_golden, same_text};
use crate::common::outcome::solve;
use plane_contact::answer::contact::{Pairing, Status};
use plane_contact::answer::{Detail, Request, Solution, Step};
use plane_contact::paper::door;
use plane_contact::paper::mathcad::array::{Column, Table};
use plane_contact::paper::mirror::{Km, Pairs, Reading, c_cnt};
use plane_contact::problem::element::State;
use plane_contact::problem::model::{Model, TriangleId};
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

/// What c_cnt finds at every iteration: ct, yt and dy by contact node, then the rows of k_cnt that
/// are not zero.
#[test]
fn pairs_at_every_iteration() {
    for scene in SCENES {
        for variant in Variant::ALL {
            let (_, solution) = solve(scene.name, *variant);
            assert_golden(scene.name, &format!("c_cnt-{variant}"), &steps(&solution));
        }
    }
}

fn steps(solution: &Solution) -> String {
    let mut text = String::new();
    let mut last = None;
    for step in &solution.steps {
        writeln!(text, "iteration {}", step.k).unwrap();
        let found = found(&solution.model, step);
        if last.as_ref() == Some(&found) {
            writeln!(text, "  as before").unwrap();
        } else {
            text += &pairs(&solution.model, &found);
        }
        last = Some(found);
    }
    text
}

/// What c_cnt found; under `unilateral` the same in its terms: ct the edge that a node faces, yt
/// the gap along the normal, dy 1 where it is closed.
fn found(model: &Model, step: &Step) -> Pairs<f64> {
    let step = match &step.detail {
        Detail::Published(step) => return step.pairs.clone(),
        Detail::Unilateral(step) => step,
    };
    let edge = |p: &Option<Pairing>| p.as_ref().map_or(0, |p| model.edge(p.edge).number);
    let gap = |p: &Option<Pairing>| p.as_ref().map_or(0.0, |p| p.gap);
    Pairs {
        ct: Column::from_vec(step.pairings.iter().map(edge).collect()),
        yt: Column::from_vec(step.pairings.iter().map(gap).collect()),
        dy: Column::from_vec(
            step.statuses.iter().map(|s| usize::from(*s != Status::Open)).collect(),
        ),
        ..Pairs::none(model.nodes.len())
    }
}

fn pairs(model: &Model, pairs: &Pairs<f64>) -> String {
    let mut text = String::new();
    for (i1, cnt) in (1..).zip(&model.contact.nodes).filter(|(i1, _)| pairs.ct[*i1] > 0) {
        let (ct, dy, yt) = (pairs.ct[i1], pairs.dy[i1], number(pairs.yt[i1]));
        writeln!(text, "  i1 {i1}: cnt {cnt} ct {ct} dy {dy} yt {yt}").unwrap();
    }
    for node in model.node_ids() {
        let row: Vec<f64> = pairs.k_cnt.row(node.number()).copied().collect();
        if row.iter().any(|x| *x != 0.0) {
            let (k1, k2) = (number(row[1]), number(row[3]));
            writeln!(text, "  k_cnt {node}: {} {k1} {} {k2}", row[0], row[2]).unwrap();
        }
    }
    text
}

/// MJS of `fig1` whole, a matrix row a line with its number.
#[test]
fn mjs_of_fig1() {
    let request = Request::new(&Scene::open("fig1").unwrap());
    let sheet = door::worksheet(&request.model().unwrap(), |x| x);
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

/// The summary of every variant: iterations, then bodies. A float a line, for the tolerance is
/// relative to the line.
#[test]
fn summary_of_every_variant() {
    for scene in SCENES {
        let mut text = String::new();
        for variant in Variant::ALL {
            let (_, solution) = solve(scene.name, *variant);
            text += &summary(&solution);
        }
        assert_golden(scene.name, "summary", &text);
    }
}

fn summary(solution: &Solution) -> String {
    let mut text = format!("variant {}\n", solution.request.variant);
    for it in &solution.steps {
        let cycle =
            it.cycle.as_ref().map_or("new".to_string(), |c| format!("cycle {:?}", c.members));
        let (u, force) = (number(it.max_displacement), number(it.target_force));
        writeln!(text, "  {}: in contact {} u {u} force {force} {cycle}", it.k, it.in_contact)
            .unwrap();
    }
    for body in &solution.model.bodies {
        let state = |id: &TriangleId| &solution.elements[id.index()];
        let of = |f: &dyn Fn(&State) -> f64| {
            body.triangles.iter().map(|id| f(state(id))).fold(0.0, f64::max)
        };
        let stress = number(of(&|state| state.von_mises_stress));
        let strain = number(of(&|state| state.von_mises_strain));
        writeln!(text, "  body {}:", body.name).unwrap();
        writeln!(text, "     von Mises stress {stress}\n     von Mises strain {strain}").unwrap();
    }
    text
}

/// No golden file is left that no test compares with.
#[test]
fn every_golden_file_is_used() {
    for scene in SCENES {
        // By this program, and by `tests/program/texts.rs`.
        let by_variant = |variant: &Variant| {
            ["c_cnt", "fields", "solve"].map(|what| format!("{what}-{variant}.snap"))
        };
        let once = ["summary", "audit", "plan", "c-cnt"].map(|name| format!("{name}.snap"));
        let mut expected: Vec<String> =
            Variant::ALL.iter().flat_map(by_variant).chain(once).collect();
        if scene.name == "fig1" {
            let decks = ["tied", "unilateral", "pair"].map(|deck| format!("calculix-{deck}"));
            let own = ["MJS", "MJS-coupled-by-none", "trace-c_cnt", "trace-Km"].map(String::from);
            expected.extend(own.into_iter().chain(decks).map(|name| name + ".snap"));
        }
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/golden");
        for entry in std::fs::read_dir(format!("{folder}/{}", scene.name)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            assert!(!name.ends_with(".snap") || expected.contains(&name), "{name} is not compared");
        }
    }
}
