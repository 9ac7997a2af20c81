//! The register of findings: each on its own scene, with the number worked out by hand, and on a
//! scene changed so that it cannot show; all of them on the scenes that the program carries.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::rc::Rc;
use std::sync::Arc;

use crate::common::golden_file::{assert_rows, assert_text};
use crate::common::json::build;
use crate::common::rows::scene_of;
use crate::common::same_text::same_text;
use crate::common::tolerances::assert_near;
use crate::golden::number;
use nalgebra::{DMatrix, DVector};
use plane_contact::engine::{self, Detail, Request};
use plane_contact::mathcad::{Array, Recorder};
use plane_contact::paper::door::{Call, free_stiffness, linked, worksheet};
use plane_contact::paper::listings::{self, Which};
use plane_contact::paper::mirror::{Km, Pairs, Reading};
use plane_contact::problem::model::{Dof, Model, NodeId};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{FINDING_SCENES, SCENES, Scene};
use plane_contact::studies::audit::Case;
use plane_contact::studies::audit::findings::{Evidence, FINDINGS, Finding, Presence, Repair};
use plane_contact::studies::lesson::{Switch, chapter};
use serde_json::Value;

testing::tolerances! {
    /// The number of a finding on its own scene, worked out by hand, relative to that number.
    FINDING = 1e-12, "a handful of operations, and LU of a few equations, on numbers of order 1";
}

fn finding(id: &str) -> &'static Finding {
    Finding::of(id.parse().expect("an id of the register"))
}

fn scene_json(id: &str) -> Value {
    let name = format!("findings/{id}");
    let embedded = FINDING_SCENES.iter().find(|s| s.name == name).expect("a scene for each id");
    serde_json::from_slice(embedded.scene).expect("scene files are JSON")
}

/// A finding's scene as a row names it, `ID/scene CHANGES`.
fn scene(row: &str) -> Scene {
    scene_of("golden/findings", row).expect("the changed scene is sound")
}

fn case(row: &str) -> Case {
    Case::new(scene(row)).with_equivalents(0)
}

/// The displacements under a variant, by degree of freedom.
fn displacements(row: &str, variant: Variant) -> DVector<f64> {
    let request = Request::new(&scene(row)).variant(variant);
    engine::solve(&request, &mut |_| ()).unwrap().u
}

/// The rows of `findings.txt`: what each finding measures on its scene, as it is or changed.
#[test]
fn findings_by_hand() {
    assert_rows("tests/fidelity/findings.txt", |row| {
        let (id, _) = row.split_once('/').expect("a finding");
        let Evidence { verdict, number, detail, .. } = finding(id).measure(&case(row));
        let number = (1e11 * number.expect("a number")).round() / 1e11;
        format!("{}, {number}: {detail}", verdict.name())
    });
    let rows = std::fs::read_to_string("tests/fidelity/findings.txt").expect("rows");
    let is_there =
        |finding: &Finding| rows.contains(&format!("\n{}/scene\n  present, ", finding.id));
    assert!(FINDINGS.iter().all(is_there));
}

/// Without contact there is nothing for the contact's findings to hold on.
#[test]
fn without_contact_no_finding_of_contact_is_present() {
    let case = Case::new(finding("K3").scene());
    for finding in FINDINGS.iter().filter(|f| !["K3", "K4"].contains(&f.id.name())) {
        let measured = finding.measure(&case);
        assert_eq!(measured.verdict, Presence::NotTriggered, "{}: {}", finding.id, measured.detail);
    }
}

/// C3: a vertical edge stops the listing, and then nothing else can be said of the scene's contact.
#[test]
fn a_vertical_edge_stops_c_cnt() {
    let case = case("C3/scene /node/1=[2,0.0,1.0,0.0] /node/3=[4,0.05,0.5,0.0]");
    for finding in FINDINGS.iter().filter(|f| !["C3", "K4"].contains(&f.id.name())) {
        assert_ne!(finding.measure(&case).verdict, Presence::Present, "{}", finding.id);
    }
}

/// C9: over a horizontal edge the sign rule fires at |yt| = c_tll exactly, where line 16 does not, and nowhere else.
/// C11: one unit in the last place of a coordinate decides on the neighbour.
#[test]
fn one_bit_decides() {
    let c9 = |y: f64| {
        format!("C9/scene c_tll=0.125 /node/3=[4,0.25,{y},0.0] /node/4=[5,0.75,-0.0625,0.0]")
    };
    let c11 = |y: f64| format!("C11/scene /node/3=[4,0.9,{y},0.0]");
    for (row, dy) in [
        (c9(0.125), [1, 1]),
        (c9(0.125_f64.next_up()), [0, 1]),
        (c11(0.3), [1, 1]),
        (c11(0.3_f64.next_up()), [1, 0]),
    ] {
        assert_eq!(case(&row).initial().expect("c_cnt runs").pairs.dy.as_slice(), dy, "{row}");
    }
}

/// C12: eq. (1) with the weights of a node listed twice moves it twice as far as the target below
/// it.
#[test]
fn c12_the_stamp_moves_twice_as_far_as_the_target() {
    let u = displacements(
        "C12/scene /iterations=1 \
         /restraints=[{\"node\":3,\"fix\":[\"x\",\"y\"]},{\"node\":1,\"fix\":[\"x\"]},\
         {\"node\":5,\"fix\":[\"x\",\"y\"]},{\"node\":6,\"fix\":[\"x\",\"y\"]}] \
         /loads=[{\"node\":1,\"force\":[0.0,-0.02]},{\"node\":2,\"force\":[0.0,-0.02]}]",
        Variant::Tied,
    );
    let v = |number: usize| NodeId::from_number(number).components(&u)[1];
    let target = 0.75 * v(1) + 0.25 * v(2);
    assert!(target < 0.0);
    assert_near("v of node 4", v(4), 2.0 * target, target, &FINDING);
}

/// C13: the order of `cnt` changes the printed displacements too, by more than half.
#[test]
fn c13_the_printed_displacements_depend_on_the_order_of_cnt() {
    let in_order = |cnt: &str| {
        let row = format!(r#"C13/scene cnt={cnt} /loads=[{{"node":4,"force":[0.0,-0.01]}}]"#);
        displacements(&row, Variant::Printed)
    };
    let (as_is, reversed) = (in_order("[4,5]"), in_order("[5,4]"));
    assert!((as_is - &reversed).amax() > 0.1 * reversed.amax());
}

/// K1: MJS of the scene, by hand: 3 from the target's triangle at node 1 plus half of the stamp's
/// at node 5.
#[test]
fn k1_the_stamp_is_added_to_the_target_and_the_target_to_the_stamp() {
    let model = Request::new(&finding("K1").scene()).model().unwrap();
    let call = Call::c_cnt(&model, &Reading::default(), &model.nodes).unwrap();
    let mjs = Km(&call.sheet, &Reading::default(), &call.pairs.k_cnt).unwrap().to_table();
    assert_near("MJS[1,1]", mjs[(1, 1)], 3.0 + 0.5 * 1.0, 1.0, &FINDING);
    assert_near("MJS[2,2]", mjs[(2, 2)], 3.0 + 0.5 * 2.0, 1.0, &FINDING);
    assert!((1..=4).all(|i| (9..=10).all(|j| mjs[(i, j)] == 0.0 && mjs[(j, i)] == 0.0)));
    assert_eq!(mjs.as_matrix(), &mjs.as_matrix().transpose(), "MJS stays symmetric");
}

/// K4 needs nothing but the listing: it holds wherever there is a triangle.
#[test]
fn k4_is_present_on_every_scene() {
    for scene in FINDING_SCENES {
        let case = Case::new(Scene::open(scene.name).unwrap());
        assert_eq!(finding("K4").measure(&case).number, Some(2.0), "{}", scene.name);
    }
}

/// Every finding on every scene that the program carries; none is contradicted anywhere.
#[test]
fn verdicts() {
    let mut text = String::new();
    for scene in SCENES {
        writeln!(text, "{}", scene.name).unwrap();
        let case = Case::new(Scene::open(scene.name).unwrap()).with_equivalents(0);
        for finding in FINDINGS {
            let measured = finding.measure(&case);
            println!("{} {}: {}", scene.name, finding.id, measured.detail);
            assert_ne!(measured.verdict, Presence::Contradicted, "{}", finding.id);
            let (verdict, number) =
                (measured.verdict.name(), number(measured.number.expect("a number")));
            writeln!(text, "  {}: {verdict}: {number}", finding.id).unwrap();
        }
    }
    assert_text("golden/findings/verdicts.snap", &text, same_text);
}

/// Each finding has its folder, with the numbers by hand, and each folder its finding.
#[test]
fn every_folder_is_a_findings() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/findings");
    let folders: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    assert_eq!(folders, FINDINGS.iter().map(|f| f.id.to_string()).collect());
    for id in folders {
        let file = "README.md";
        assert!(std::fs::exists(format!("{folder}/{id}/{file}")).unwrap(), "{id}/{file}");
    }
}

/// What a finding's scene has before and after its repair, in the listing's own arrays: dy, ct, then
/// where it says so a row of `k_cnt` or entries of `MJS`.
#[test]
fn each_repair_takes_its_finding_away() {
    let is_edit = |finding: &&Finding| matches!(finding.edit, Repair::Edit { .. });
    let repaired: Vec<(&str, [Run; 2])> =
        FINDINGS.iter().filter(is_edit).map(|finding| (finding.id.name(), runs(finding))).collect();
    let both = |id: &str| &repaired.iter().find(|(other, _)| *other == id).expect("an id").1;
    let run = |id: &str| &both(id)[1];
    let pairs = |run: &Run| run.pairs.clone().expect("c_cnt ends with pairs");
    let matrix = |run: &Run| run.matrix.clone().expect("Km ends with a matrix");
    let statuses = [
        ("C4", vec![0, 1]),
        ("C5", vec![1, 1]),
        ("C8", vec![1, 1, 0]),
        ("C11", vec![1, 0]),
        ("C15", vec![1, 0]),
    ];
    for (id, dy) in statuses {
        assert_eq!(pairs(run(id)).dy.as_slice(), dy, "{id}");
    }
    assert_eq!(pairs(run("C3")).dy.as_slice(), [1], "0.09 along the normal is within 0.1");
    assert_eq!(pairs(run("C14")).ct.as_slice(), [1], "the node on its edge is found");
    let edges = |id: &str| both(id).each_ref().map(|run| pairs(run).ct.as_slice().to_vec());
    assert_eq!(edges("C1"), [[0], [1]], "the edge reversed");
    assert_eq!(edges("C2"), [[2], [1]], "the nearest edge");
    assert_eq!(edges("C9"), [[1, 0], [1, 1]], "the deep node too");
    let weights = |id: &str, n: usize| pairs(run(id)).k_cnt.row(n).copied().collect::<Vec<_>>();
    assert_eq!(weights("C12", 4), [1.0, 0.75, 2.0, 0.25]);
    assert_eq!(weights("K8", 5), [1.0, 0.0, 2.0, 1.0], "the end of the edge");
    assert_eq!(both("C10").each_ref().map(|run| run.pairs.is_some()), [false, true]);
    let diagonal: Vec<f64> = (1..=6).map(|e| *matrix(run("K3")).at(e - 1, e - 1)).collect();
    assert!(diagonal.iter().all(|x| (1e4..=3e4).contains(x)), "{diagonal:?}");
    let last = both("K4").each_ref().map(|run| *matrix(run).at(7, 7));
    assert_eq!(last, [0.0, 1.0], "the equations of the node of no triangle");
    let [printed, repaired] = both("K7");
    assert_eq!(printed.additions[1], 0, "fl is 0 in the stamp's triangle");
    assert_eq!(repaired.additions[1], 36, "node 4 adds with its own weight");
}

/// Both listings on the initial shape under a switch.
struct Run {
    model: Arc<Model>,
    /// What `c_cnt` returns; nothing where it fails.
    pairs: Option<Pairs<f64>>,
    /// What `Km` returns on them; nothing where one of the two fails.
    matrix: Option<Rc<Array>>,
    /// How often line 23 of `Km` is executed in each triangle.
    additions: Vec<usize>,
}

impl Run {
    fn new(scene: &Scene, switch: &Switch) -> Run {
        let model = switch.model(scene).expect("a sound model");
        let (call, settings) = (Call::without_contact(&model), switch.settings());
        let [c_cnt, km] = [Which::CCnt, Which::Km].map(|which| switch.listing(which));
        let found = listings::c_cnt(&c_cnt, &settings, &call.sheet, &call.sheet.node, None).ok();
        let pairs =
            if model.has_contact() { found.map(|(pairs, _)| pairs) } else { Some(call.pairs) };
        let mut additions = vec![];
        let mut recorder = Recorder::new(|done| match done.line {
            3 => additions.push(0),
            23 => *additions.last_mut().expect("in a triangle") += 1,
            _ => (),
        });
        let matrix = pairs.as_ref().and_then(|pairs| {
            let run = listings::km(&km, &settings, &call.sheet, &pairs.k_cnt, Some(&mut recorder));
            Some(run.ok()?.0)
        });
        drop(recorder);
        Run { model, pairs, matrix, additions }
    }
}

fn runs(finding: &Finding) -> [Run; 2] {
    switches(finding).map(|switch| Run::new(&finding.scene(), &switch))
}

/// The listings as printed, and with the repair.
fn switches(finding: &Finding) -> [Switch; 2] {
    let chapter = <[Switch; 2]>::try_from(chapter(finding));
    chapter.unwrap_or_else(|_| panic!("{} has a repair", finding.id))
}

/// K1, and with it C7, C13 and K2: the repaired `Km` is Tᵀ·K·T, with the rows of the free equations
/// as products of matrices give them, in either order of `cnt`.
#[test]
fn the_repair_of_k1_joins_the_bodies() {
    for id in ["K1", "C7", "C13", "K2"] {
        let [own, reversed] = [false, true].map(|reverse| {
            let mut json = scene_json(id);
            if reverse {
                json["contact"]["cnt"].as_array_mut().expect("a list").reverse();
            }
            // The target can move.
            json["restraints"].as_array_mut().expect("a list").retain(|r| r["on"] != 1);
            let [_, repaired] = switches(finding(id));
            let run = Run::new(&build(&json).expect("a sound scene"), &repaired);
            let mjs = run.matrix.expect("Km ends with a matrix");
            (DMatrix::from_fn(mjs.rows(), mjs.cols(), |i, j| *mjs.at(i, j)), run.model)
        });
        let expected = constrained(&own.1);
        assert!(expected.amax() > 1.0);
        assert_near(id, (&own.0 - &expected).amax(), 0.0, expected.amax(), &FINDING);
        assert_near(id, (reversed.0 - &expected).amax(), 0.0, expected.amax(), &FINDING);
    }
}

/// Tᵀ·K·T of a model in its initial shape, 1 on the diagonal of the equations without an entry.
fn constrained(model: &Model) -> DMatrix<f64> {
    let call = Call::c_cnt(model, &Reading::default(), &model.nodes).expect("c_cnt runs");
    let free = free_stiffness(&call.sheet, &Reading::default()).expect("finite").into_matrix();
    let mut t = DMatrix::identity(free.nrows(), free.nrows());
    for bound in linked(&call.sheet, &call.pairs) {
        for e in bound.node.dofs().map(|dof| dof.index()) {
            t[(e, e)] = 0.0;
        }
        for (master, weight) in bound.masters {
            for (e, m) in bound.node.dofs().into_iter().zip(master.dofs()) {
                t[(e.index(), m.index())] = weight;
            }
        }
    }
    for e in (0..free.nrows()).filter(|e| model.is_restrained(Dof::new(*e))) {
        t.column_mut(e).fill(0.0);
        t.row_mut(e).fill(0.0);
    }
    let mut mjs = t.transpose() * free * t;
    for e in 0..mjs.nrows() {
        if mjs[(e, e)] == 0.0 {
            mjs[(e, e)] = 1.0;
        }
    }
    mjs
}

/// What the chapters without a repair of a listing say in its place.
#[test]
fn each_finding_without_a_repair_has_a_reason_that_holds() {
    let mut ids = Vec::new();
    for finding in FINDINGS {
        if let Repair::None { reason } = finding.edit {
            assert!(reason.contains(&format!("solve findings/{}", finding.id)), "{reason}");
            ids.push(finding.id.name());
        }
    }
    assert_eq!(ids, ["C6", "K5", "K6", "K9"]);
    let solved = |id: &str, change: &dyn Fn(Request) -> Request| {
        let request = change(Request::new(&finding(id).scene()));
        engine::solve(&request, &mut |_| ()).expect("it runs")
    };
    let current = solved("C6", &|request| request.reading("R5=node_n".parse().unwrap()));
    let found = current.steps.iter().filter_map(|step| match &step.detail {
        Detail::Published(found) => Some(linked(&worksheet(&current.model, |x| x), found)),
        Detail::Unilateral(_) => None,
    });
    let weights: Vec<f64> =
        found.flatten().flat_map(|bound| bound.masters.map(|(_, weight)| weight)).collect();
    assert!(!weights.is_empty() && weights.iter().all(|k| (0.0..=1.0).contains(k)), "{weights:?}");
    let stepped = solved("K5", &|request| request.variant(Variant::Stepped));
    assert!(stepped.steps.iter().all(|step| step.cycle.as_ref().is_none_or(|c| c.length == 1)));
    solved("K6", &|request| request);
    let released = solved("K9", &|request| request.variant(Variant::Unilateral));
    assert_eq!(released.in_contact().count(), 0);
}
