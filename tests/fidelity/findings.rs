//! The register of findings: each on its own scene, with the number worked out by hand; each on a
//! scene changed so that it cannot show; all of them on the scenes that the program carries.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::rc::Rc;
use std::sync::Arc;

use crate::common::golden_floats::assert_golden;
use crate::common::json::build;
use crate::common::tolerances::{Tolerance, assert_near};
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
use serde_json::{Value, json};

/// The number of a finding on its own scene, worked out by hand, relative to that number.
const FINDING: Tolerance = Tolerance {
    limit: 1e-12,
    reason: "a handful of operations, and LU of a few equations, on numbers of order 1",
};

fn finding(id: &str) -> &'static Finding {
    Finding::of(id.parse().expect("an id of the register"))
}

fn scene_json(id: &str) -> Value {
    let name = format!("findings/{id}");
    let embedded = FINDING_SCENES.iter().find(|s| s.name == name).expect("a scene for each id");
    serde_json::from_slice(embedded.scene).expect("scene files are JSON")
}

/// What finding `id` measures on its scene once `change` has been made.
fn measured(id: &str, change: impl FnOnce(&mut Value)) -> Evidence {
    let mut json = scene_json(id);
    change(&mut json);
    finding(id).measure(&case(&json))
}

fn case(json: &Value) -> Case {
    Case::new(build(json).expect("the changed scene is sound")).with_equivalents(0)
}

/// What `c_cnt` finds at the initial shape: dy.
fn initial_dy(json: &Value) -> Vec<usize> {
    case(json).initial().expect("c_cnt runs").pairs.dy.as_slice().to_vec()
}

/// The displacements under a variant, by degree of freedom.
fn displacements(json: &Value, variant: Variant) -> DVector<f64> {
    let request = Request::new(&build(json).unwrap()).variant(variant);
    engine::solve(&request, &mut |_| ()).unwrap().u
}

/// Moves node `n`.
fn at(json: &mut Value, n: usize, x: f64, y: f64) {
    json["node"][n - 1] = json!([n, x, y, 0.0]);
}

#[track_caller]
fn shows(id: &str, measured: &Evidence, number: f64, words: &[&str]) {
    assert_eq!(measured.verdict, Presence::Present, "{id}: {}", measured.detail);
    let scale = if number == 0.0 { 1.0 } else { number };
    assert_near(id, measured.number.expect("a number"), number, scale, &FINDING);
    for word in words {
        assert!(measured.detail.contains(word), "{id}: {word:?} is not in {:?}", measured.detail);
    }
}

/// The README of each scene works these numbers out.
#[test]
fn each_finding_is_present_on_its_scene() {
    let expected: &[(&str, f64, &[&str])] = &[
        (
            "C1",
            1.0,
            &[
                "node 4 lies 0.02 below edge 1 and is in contact",
                "it has no edge and is not in contact",
            ],
        ),
        (
            "C2",
            1.0,
            &[
                "node 5 lies 0.15 below edge 2 and is not in contact",
                "it lies on edge 1 and is in contact",
            ],
        ),
        (
            "C3",
            1.0,
            &[
                "node 4 lies 0.15 above edge 1 and is not in contact",
                "0.09 from it along the normal",
            ],
        ),
        (
            "C4",
            2.0,
            &[
                "node 4 lies 0.3 above edge 1 and is in contact, but upside down it lies 0.3 below edge 1 and is not",
                "node 5 lies 0.3 below edge 1 and is not in contact, but upside down it lies 0.3 above edge 1 and is in",
            ],
        ),
        (
            "C5",
            2.0,
            &[
                "node 4 lies 0.3 below edge 1 and is not in contact; node 5 lies 0.3 below edge 1 and is not",
            ],
        ),
        ("C6", 0.5, &["node 5 the weights 1.5 and -0.5"]),
        (
            "C7",
            2.0,
            &[
                "node 1 is a mate of nodes 4, 5, but keeps node 5 alone, with the weight 1",
                "node 2 is a mate of nodes 4, 5, but keeps node 5 alone, with the weight 1",
            ],
        ),
        (
            "C8",
            1.0,
            &[
                "node 4 lies on edge 1 and is not in contact; by lines 17 and 18, node 5 lies 0.3 above edge 1 and is in",
            ],
        ),
        (
            "C9",
            1.0,
            &[
                "node 5 lies 0.3 below edge 1, inside the target, and the search finds no edge for it",
            ],
        ),
        ("C10", -0.05, &["c_cnt, line 18", "index of yt = 0"]),
        (
            "C11",
            1.0,
            &[
                "node 5 lies 0.3 above edge 1 and is in contact once its neighbour moves down",
                "else not",
            ],
        ),
        ("C12", 2.0, &["node 4 is listed 2 times, and its weights add up to 2"]),
        (
            "C13",
            4.0,
            &["an entry of MJS changes by 2 once cnt is reversed; the largest entry is 5.5"],
        ),
        ("C14", 1.0, &["node 4 lies on edge 1, and the search finds no edge for it"]),
        (
            "C15",
            1.0,
            &["node 5 lies 0.3 above edge 1 and is in contact, as a node beside it touches"],
        ),
        ("K1", 0.0, &["the stamp moves by 0.05, the target by 0"]),
        ("K2", 1.0, &["pair 1 of triangle 2 has the weights 0.75, 0.25, and fl keeps the last"]),
        (
            "K3",
            20000.0,
            &["restrained equations have 1 on the diagonal, the others 10000 to 20000"],
        ),
        ("K4", 2.0, &["0 rows of zeros without such a node, 2 with it, 2 if S holds it"]),
        ("K5", 2.0, &["the contact state alternates with 1, 0 nodes in contact"]),
        ("K6", 1.0, &["the released stamp with one linked node is singular, with two solvable"]),
        ("K7", 1.0, &["pair 1 of triangle 2 has the weights 0.75, 0, and fl keeps the last"]),
        ("K8", -7.0, &["the least diagonal entry of MJS is -7, at y of node 1"]),
        ("K9", 1.0, &["node 4 stays in contact although it pulls with 0.6"]),
    ];
    assert_eq!(
        expected.iter().map(|(id, ..)| *id).collect::<Vec<_>>(),
        FINDINGS.iter().map(|f| f.id.name()).collect::<Vec<_>>()
    );
    for (id, number, words) in expected {
        let case = Case::new(finding(id).scene()).with_equivalents(0);
        shows(id, &finding(id).measure(&case), *number, words);
    }
}

/// A change of the scene that takes away what the finding needs.
type Change = fn(&mut Value);

#[test]
fn each_finding_vanishes_where_its_cause_does() {
    let changes: &[(&str, Change)] = &[
        // Over the middle of the edge both boxes hold the node.
        ("C1", |s| at(s, 4, 0.5, 0.0)),
        // Over the first edge alone.
        ("C2", |s| at(s, 5, 0.5, 0.0)),
        // Beyond c_tll along the normal too: 0.2 · 0.6 = 0.12.
        ("C3", |s| at(s, 4, 0.3, 0.6)),
        // Both apart: no change of sign.
        ("C4", |s| at(s, 5, 1.5, 1.8)),
        // One node alone inside.
        ("C5", |s| at(s, 4, 0.5, 0.8)),
        // Straight down on its own edge.
        ("C6", |s| s["loads"][0]["force"] = json!([0.0, -0.6])),
        // One contact node.
        ("C7", |s| s["contact"]["cnt"] = json!([4])),
        // No node on the edge.
        ("C8", |s| at(s, 4, 0.5, 0.75)),
        // Not deeper than the box.
        ("C9", |s| at(s, 5, 0.75, -0.09)),
        // The first node is down.
        ("C10", |s| at(s, 4, 0.5, -0.05)),
        // Off its edge by more than rounding.
        ("C11", |s| at(s, 4, 0.9, 0.29)),
        ("C12", |s| s["contact"]["cnt"] = json!([4])),
        ("C13", |s| s["contact"]["cnt"] = json!([4])),
        // The edge written the other way rises towards −x: its box grows.
        ("C14", |s| s["elem"][0] = json!([1, 1, 2, 10, 10, 2, 1])),
        // The touching node a little above its edge.
        ("C15", |s| at(s, 4, 0.5, 0.55)),
        // No contact.
        ("K1", |s| at(s, 5, 0.5, 0.2)),
        // One node, over the middle: equal weights.
        ("K2", |s| {
            at(s, 4, 0.5, 0.0);
            s["contact"]["cnt"] = json!([4]);
        }),
        // A unit in which E = 4.
        ("K3", |s| s["materials"]["1"]["E"] = json!(4.0)),
        // The gap closed from the start.
        ("K5", |s| at(s, 4, 0.5, 0.0)),
        // Off the edge's end.
        ("K7", |s| at(s, 5, 0.75, 0.0)),
        // Inside the edge's ends.
        ("K8", |s| at(s, 5, 0.75, 0.0)),
        // Pressed down.
        ("K9", |s| s["loads"][0]["force"] = json!([0.0, -0.6])),
    ];
    for (id, change) in changes {
        let measured = measured(id, change);
        assert_eq!(measured.verdict, Presence::NotTriggered, "{id}: {}", measured.detail);
    }
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
    let mut json = scene_json("C3");
    at(&mut json, 2, 0.0, 1.0);
    at(&mut json, 4, 0.05, 0.5);
    let case = case(&json);
    shows("C3", &finding("C3").measure(&case), 0.0, &["c_cnt, line 10", "Division by zero"]);
    for finding in FINDINGS.iter().filter(|f| !["C3", "K4"].contains(&f.id.name())) {
        assert_ne!(finding.measure(&case).verdict, Presence::Present, "{}", finding.id);
    }
}

/// C4 is an effect of the sign rule: C1 is kept out, though upside down the edge's box shrinks.
#[test]
fn c4_leaves_out_nodes_that_lose_their_edge() {
    let measured = measured("C4", |s| {
        at(s, 4, 0.05, 0.05);
        at(s, 5, 1.5, 1.8);
    });
    assert_eq!(measured.verdict, Presence::NotTriggered, "{}", measured.detail);
}

/// C5 with the target above: of three nodes deep inside between two apart, the ends are flagged and
/// the middle is lost.
#[test]
fn c5_keeps_the_ends_of_a_run_when_the_target_is_above() {
    let mut json = scene_json("C5");
    let places = [(0.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.5, 0.2), (0.75, 1.05), (1.0, 1.3)]
        .into_iter()
        .chain([(1.25, 1.55), (1.5, 1.2), (1.0, -1.0)]);
    json["node"] = (1..).zip(places).map(|(n, (x, y))| json!([n, x, y, 0.0])).collect();
    let fan = [[1, 1, 2, 3], [2, 9, 5, 4], [2, 9, 6, 5], [2, 9, 7, 6], [2, 9, 8, 7]];
    let triangles =
        (2..).zip(fan).map(|(e, [group, a, b, c])| json!([e, 2, 2, group, group, a, b, c]));
    json["elem"] = std::iter::once(json!([1, 1, 2, 10, 10, 1, 2])).chain(triangles).collect();
    json["restraints"][1] = json!({ "on": 2, "fix": ["x", "y"] });
    json["contact"]["cnt"] = json!([4, 5, 6, 7, 8]);
    shows(
        "C5",
        &finding("C5").measure(&case(&json)),
        1.0,
        &["node 6 lies 0.3 above edge 1 and is not in contact"],
    );
}

/// C9: over a horizontal edge the sign rule fires at |yt| = c_tll exactly, where line 16 does not,
/// and nowhere else.
#[test]
fn c9_the_sign_rule_over_a_horizontal_edge_acts_at_c_tll_exactly() {
    let dy = |y: f64| {
        let mut json = scene_json("C9");
        json["contact"]["c_tll"] = json!(0.125);
        at(&mut json, 4, 0.25, y);
        at(&mut json, 5, 0.75, -0.0625);
        initial_dy(&json)
    };
    assert_eq!(dy(0.125), [1, 1]);
    assert_eq!(dy(0.125_f64.next_up()), [0, 1]);
}

/// C11: one unit in the last place of a coordinate decides on the neighbour.
#[test]
fn c11_one_bit_of_a_neighbour_decides() {
    let dy = |y: f64| {
        let mut json = scene_json("C11");
        at(&mut json, 4, 0.9, y);
        initial_dy(&json)
    };
    assert_eq!(dy(0.3), [1, 1]);
    assert_eq!(dy(0.3_f64.next_up()), [1, 0]);
}

/// C12: eq. (1) with the weights of a node listed twice moves it twice as far as the target below
/// it.
#[test]
fn c12_the_stamp_moves_twice_as_far_as_the_target() {
    let mut json = scene_json("C12");
    json["restraints"] = json!([{ "node": 3, "fix": ["x", "y"] }, { "node": 1, "fix": ["x"] },
        { "node": 5, "fix": ["x", "y"] }, { "node": 6, "fix": ["x", "y"] }]);
    json["loads"] =
        json!([{ "node": 1, "force": [0.0, -0.02] }, { "node": 2, "force": [0.0, -0.02] }]);
    json["iterations"] = json!(1);
    let u = displacements(&json, Variant::Tied);
    let v = |number: usize| NodeId::from_number(number).components(&u)[1];
    let target = 0.75 * v(1) + 0.25 * v(2);
    assert!(target < 0.0);
    assert_near("v of node 4", v(4), 2.0 * target, target, &FINDING);
}

/// C13: the order of `cnt` changes the printed displacements too, by more than half.
#[test]
fn c13_the_printed_displacements_depend_on_the_order_of_cnt() {
    let in_order = |cnt: [usize; 2]| {
        let mut json = scene_json("C13");
        json["contact"]["cnt"] = json!(cnt);
        json["loads"] = json!([{ "node": 4, "force": [0.0, -0.01] }]);
        displacements(&json, Variant::Printed)
    };
    let (as_is, reversed) = (in_order([4, 5]), in_order([5, 4]));
    assert!((as_is - &reversed).amax() > 0.1 * reversed.amax());
}

/// C14: at the height 2 · c_tll of the falling edge the box vanishes; at other heights it holds the
/// node again.
#[test]
fn c14_the_box_vanishes_at_twice_c_tll() {
    for (height, missed) in [(0.0625, false), (0.125, true), (0.25, false)] {
        let measured = measured("C14", |s| {
            s["contact"]["c_tll"] = json!(0.0625);
            at(s, 1, 0.0, height / 2.0);
            at(s, 2, 1.0, -height / 2.0);
            at(s, 4, 0.375, height / 8.0);
        });
        assert_eq!(
            measured.verdict == Presence::Present,
            missed,
            "height {height}: {}",
            measured.detail
        );
    }
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

/// K4 and K6 need nothing but the listing: they hold wherever there is a triangle, or a contact.
#[test]
fn k4_and_k6_are_present_on_every_scene_with_contact() {
    for scene in FINDING_SCENES {
        let case = Case::new(Scene::open(scene.name).unwrap());
        assert_eq!(finding("K4").measure(&case).number, Some(2.0), "{}", scene.name);
    }
    let apart = measured("K6", |s| {
        at(s, 4, 0.25, 0.2);
        at(s, 5, 0.75, 0.2);
        s["restraints"][1]["fix"] = json!(["x", "y"]);
        s["restraints"][2]["fix"] = json!(["x", "y"]);
        s["loads"] = json!([]);
    });
    assert_eq!(apart.verdict, Presence::NotTriggered, "{}", apart.detail);
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
    assert_golden("findings", "verdicts", &text);
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
        Detail::Published(found) => Some(linked(&worksheet(&current.model, |x| x), &found.whole())),
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
