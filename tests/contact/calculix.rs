//! CalculiX: its decks, its results, and what it computes where `ccx` is installed. Where
//! `REQUIRE_CCX` is set it must be.

use crate::common::golden_file::assert_text;
use crate::common::outcome::solve;
use crate::common::program;
use crate::common::rows::scene_of;
use crate::common::tolerances::assert_near;
use crate::common::tools::has_ccx;
use crate::scenes::FOLDER;
use crate::unilateral::models;
use nalgebra::DVector;
use plane_contact::engine::{self, Request, Solution};
use plane_contact::paper::corrected::{Bound, STEPS, Worksheet};
use plane_contact::problem::modelling::{ContactModel, Friction, Variant};
use plane_contact::problem::scene::Scene;
use plane_contact::studies::calculix::{Contact, Pair, Part, deck, float, parse, run};
use plane_contact::studies::compare::Beside;
use tempfile::TempDir;

testing::tolerances! {
    /// The same for the largest von Mises stress of a body, relative to it.
    PENALTY_STRESS = 5e-2,
        "ccx pushes along the normal of the target's face, unilateral along one that turns from face to face: 2.3e-2 \
         on the strand, whatever the penalty; the default penalty adds 2e-3";
    /// CalculiX's contact pair beside `unilateral`, node to segment, relative to the largest displacement.
    PENALTY = 1e-2,
        "bodies penetrate by pressure over penalty, h/(10 E) of the pressure: on two-blocks 3e-6 mm of 4.2e-4 mm";
    /// CalculiX beside this program on the same equations, relative to the largest displacement, or von Mises stress.
    CCX_PRINTS = 1e-6,
        "ccx prints seven digits: each of two components is rounded by at most 5e-7 of itself, and so is each of the \
         parts of a sum";
    /// Displacements of the corrected algorithm on the strand beside those of ccx's own contact, relative to the
    /// largest.
    CORRECTED_CCX = 0.01, "its contact yields by a penalty: 0.6 % measured, normal and both";
    /// Displacements under friction beside those of ccx's own contact and friction, relative to the largest.
    CCX_FRICTION = 0.01, "its contact and its sticking yield by a penalty: 0.2 % measured at 0.2";
}

/// What `ccx` printed for the deck `golden/fig1/calculix-tied.snap`.
const PRINTED: &str = include_str!("calculix/fig1.dat");

fn last_deck(scene: &Scene, solution: &Solution, parts: &[Part]) -> String {
    deck(&scene.title, &solution.model, &parts.last().unwrap().contact).unwrap()
}

const FIG1: &str = "golden/fig1";

/// Words to the letter, numbers to twelve digits.
fn same_deck(golden: &str, deck: &str) -> bool {
    let digits = |word: &str| word.parse().map_or(word.into(), |x: f64| format!("{x:.11e}"));
    let words = |text: &str| text.split([',', '\n']).map(digits).collect::<Vec<String>>();
    words(golden) == words(deck)
}

#[test]
fn decks_of_fig1() {
    for variant in [Variant::Tied, Variant::Unilateral] {
        let (scene, solution) = solve("fig1", variant);
        let parts = Contact::parts(&solution).unwrap();
        let text = last_deck(&scene, &solution, &parts);
        assert_text(format!("{FIG1}/calculix-{variant}.snap"), &text, same_deck);
    }
    let (scene, solution) = solve("fig1", Variant::Tied);
    let pair = |friction| Pair::new(&solution.model, Some(1e7), friction);
    let of = |friction| last_deck(&scene, &solution, &[pair(friction).into()]);
    assert_text(format!("{FIG1}/calculix-pair.snap"), &of(Friction::STICK), same_deck);
    assert!(of(Friction::STICK).contains("*FRICTION"));
    assert!(!of(Friction::NONE).contains("*FRICTION"));
}

/// A solution with stepped load is the sum of its contact states, each with its share; one with
/// total load is its last step.
#[test]
fn the_shares_of_the_parts_sum_to_one() {
    for (variant, several) in [(Variant::Tied, false), (Variant::Stepped, true)] {
        let (_, solution) = solve("strand", variant);
        let parts = Contact::parts(&solution).unwrap();
        assert_eq!(parts.len() > 1, several);
        let sum: f64 = parts.iter().map(|part| part.share).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    }
    let (_, solution) = solve("fig1", Variant::Printed);
    let error = Contact::parts(&solution).err().expect("printed ties nothing");
    assert!(error.what.contains("no equations"), "{error}");
}

#[test]
fn printed_results_read_back() {
    let u = parse(PRINTED, 13).unwrap();
    assert_eq!(u.as_slice()[18..20], [0.0, 0.0]);
    assert_eq!(u.as_slice()[24..26], [0.0, -2.015804e-4]);
    let (_, solution) = solve("fig1", Variant::Tied);
    assert_same(&solution, u, "fig1 as stored");
    assert_same_stresses(&solution, PRINTED);
}

/// The stresses that `ccx` printed itself are those of this program: the program does not read them.
#[track_caller]
fn assert_same_stresses(solution: &Solution, printed: &str) {
    let (mut triangles, mut is_stress) = (0, false);
    let largest = solution.elements.iter().map(|state| state.von_mises_stress).fold(0.0, f64::max);
    for line in printed.lines().filter(|line| !line.trim().is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        if words[0].parse::<usize>().is_err() {
            is_stress = words[0] == "stresses";
        } else if let (true, "1") = (is_stress, words[1]) {
            let state = &solution.elements[words[0].parse::<usize>().unwrap() - 1];
            for (ours, at) in state.sigma.iter().zip([2, 3, 5]) {
                let theirs = float(words[at]).unwrap();
                assert_near(line, theirs, *ours, largest, &CCX_PRINTS);
            }
            triangles += 1;
        }
    }
    assert_eq!(triangles, solution.elements.len());
}

#[test]
fn of_several_increments_the_last_counts() {
    let earlier = PRINTED.replace("-2.015804E-04", "-9.000000E-04");
    let u = parse(&(earlier + PRINTED), 13).unwrap();
    assert_eq!(u, parse(PRINTED, 13).unwrap());
}

#[test]
fn results_that_are_not_whole_are_refused() {
    let refused = |text: &str, nodes, words: &str| {
        let error = parse(text, nodes).unwrap_err();
        assert!(error.what.contains(words), "{error}");
    };
    refused(PRINTED, 14, "node 14 is not in them");
    refused(PRINTED, 12, "is not understood");
    refused(&PRINTED.replace("-2.015804E-04", "NaN"), 13, "NaN");
    refused("", 13, "its last line has no end");
    // What an earlier increment had is no part of the last one, whose end is lost.
    let earlier = PRINTED.replace("0.1000000E+01", "0.1000000E+00");
    let nodes: Vec<&str> = PRINTED.lines().take(9).collect();
    refused(&(earlier.clone() + &nodes.join("\n") + "\n"), 13, "node 7 is not in them at time 1");
    refused(&(earlier + &nodes.join("\n")), 13, "its last line has no end");
}

/// Displacements relative to the largest.
#[track_caller]
fn assert_same(solution: &Solution, u: DVector<f64>, what: &str) {
    let beside = Beside::new(solution, u).unwrap();
    let far = beside.distance.displacement_relative;
    eprintln!("{what}: displacement {far}");
    assert_near(&format!("{what}, node {}", beside.worst(1)[0]), far, 0.0, 1.0, &CCX_PRINTS);
}

/// GOAL: two blocks whose nodes do not match, every kind of row in the equations.
/// MESH: 2 x 1 mm each, 10 x 5 and 7 x 4 cells of two triangles.
/// BOUNDARY CONDITIONS: bottom restrained in y, one corner of each block in x; the top is pushed
/// down and aside, and so is a contact node.
/// PARAMETERS: E = 30000 and 210000 MPa, nu = 0.2 and 0.3, thickness 0.7 mm.
fn scenes() -> Vec<(&'static str, Scene)> {
    vec![
        ("two-blocks", Scene::open("two-blocks").unwrap()),
        ("strand", Scene::open("strand").unwrap()),
        ("blocks that do not match", scene_of(FOLDER, "unmatched").unwrap()),
    ]
}

fn solution(scene: &Scene, variant: Variant) -> Solution {
    engine::solve(&Request::new(scene).variant(variant), &mut |_| ()).unwrap()
}

#[test]
fn ccx_solves_the_same_equations() {
    if !has_ccx() {
        return;
    }
    for (name, mut scene) in scenes() {
        for variant in [Variant::Tied, Variant::Stepped] {
            assert_equations(name, &scene, variant);
        }
        for model in models() {
            scene.contact = model;
            assert_equations(&format!("{name} {model:?}"), &scene, Variant::Unilateral);
        }
    }
}

#[track_caller]
fn assert_equations(name: &str, scene: &Scene, variant: Variant) {
    let solution = solution(scene, variant);
    let parts = Contact::parts(&solution).unwrap();
    let ran = run("ccx", &scene.title, &solution.model, &parts).unwrap();
    assert_same(&solution, ran.u, &format!("{name} {variant}"));
}

/// ccx's own friction beside ours on the strand: its contact yields by its penalty, its friction by
/// the slope at which a node sticks (a tenth of the penalty, `STICK_SLOPE`), and its steps are its
/// own.
#[test]
fn ccx_rubs_alike_but_for_its_penalty() {
    if !has_ccx() {
        return;
    }
    let mut scene = Scene::open("strand").unwrap();
    for mu in [0.1, 0.2, 0.4] {
        let friction = Friction::new(mu).unwrap();
        scene.contact = ContactModel { friction, ..ContactModel::default() };
        let solution = solution(&scene, Variant::Unilateral);
        let pair = Pair::new(&solution.model, None, friction);
        let ran = run("ccx", &scene.title, &solution.model, &[pair.into()]).unwrap();
        let far = Beside::new(&solution, ran.u).unwrap().distance.displacement_relative;
        assert_near(&format!("friction {mu}"), far, 0.0, 1.0, &CCX_FRICTION);
    }
}

/// ccx's own contact beside `unilateral` without friction.
#[test]
fn ccx_finds_the_same_contact_but_for_its_penalty() {
    if !has_ccx() {
        return;
    }
    for (name, mut scene) in scenes() {
        scene.contact = ContactModel { friction: Friction::NONE, ..ContactModel::default() };
        let solution = solution(&scene, Variant::Unilateral);
        let pair = Pair::new(&solution.model, None, Friction::NONE);
        let ran = run("ccx", &scene.title, &solution.model, &[pair.into()]).unwrap();
        let distance = Beside::new(&solution, ran.u).unwrap().distance;
        eprintln!("{name}: {distance:?}");
        assert_near(name, distance.displacement_relative, 0.0, 1.0, &PENALTY);
        for body in &distance.bodies {
            assert_near(&body.name, body.relative, 0.0, 1.0, &PENALTY_STRESS);
        }
    }
}

/// The corrected algorithm beside ccx's own contact under the same friction: along the normal without any,
/// with both components where nothing slides.
#[test]
fn ccx_finds_what_the_corrected_algorithm_finds() {
    if !has_ccx() {
        return;
    }
    let scene = Scene::open("strand").unwrap();
    for (bound, friction) in [(Bound::Normal, Friction::NONE), (Bound::Both, Friction::STICK)] {
        let own = Worksheet::new(&scene.model, bound).iterate(&[], STEPS).unwrap().u;
        let pair = Pair::new(&scene.model, None, friction);
        let theirs = run("ccx", &scene.title, &scene.model, &[pair.into()]).unwrap().u;
        let difference = own.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        eprintln!("{bound}: {:.3} %", 100.0 * difference / theirs.amax());
        assert_near(bound.name(), difference, 0.0, theirs.amax(), &CORRECTED_CCX);
    }
}

#[test]
fn export_writes_the_deck() {
    let folder = TempDir::new().unwrap();
    let printed = program::run(folder.path(), &["scene", "export", "fig1", "--variant", "tied"]);
    let (scene, solution) = solve("fig1", Variant::Tied);
    let parts = Contact::parts(&solution).unwrap();
    assert_eq!(String::from_utf8(printed.stdout).unwrap(), last_deck(&scene, &solution, &parts));
}
