//! The register of claims: every number is the one that its command prints.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use serde_json::Value;

use crate::common::program::json;
use crate::common::tolerances::{CLAIM, assert_near};
use crate::texts;
use plane_contact::Scene;
use plane_contact::engine::{Request, distance, solve};
use plane_contact::output::json::line;
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::modelling::{Friction, Variant};
use plane_contact::studies::audit::claims::claim_tables::ESTIMATES;
use plane_contact::studies::audit::claims::{
    Basis, CLAIMS, ClaimId, JudgedClaim, Scope, Verdict, judge,
};
use plane_contact::studies::audit::evidence::BY_ROUNDING;
use plane_contact::studies::audit::prices::Price;
use plane_contact::studies::audit::range::{Parameter, Range, range};
use plane_contact::studies::audit::words::{self, Depth, WIDER, WIDTH};
use plane_contact::studies::audit::{Case, audit};

fn open(name: &str) -> Case {
    Case::new(Scene::open(name).expect("an embedded scene"))
}

static CASE: LazyLock<Case> = LazyLock::new(|| open("strand"));

/// The range of what the paper leaves open, whose runs are made once for all tests.
pub static RANGE: LazyLock<Range> =
    LazyLock::new(|| range(Reading::default()).expect("its values are allowed"));

/// The claims on the paper's example over the range.
pub static JUDGED: LazyLock<Vec<JudgedClaim>> = LazyLock::new(|| judge(CLAIMS, &CASE, &RANGE));

/// What `audit` prints of a scene: its first screen, all, and the JSON.
pub struct Audited {
    pub screen: String,
    pub full: String,
    json: Value,
    /// What each printed fault costs.
    pub prices: Vec<Price>,
}

impl Audited {
    fn new(case: &Case) -> Self {
        let audit = audit(case, &Range::new(), true, &|| ());
        let report = |depth, width| words::report(&audit, depth).text(width);
        Audited {
            screen: report(Depth::Screen, WIDTH),
            full: report(Depth::Full, usize::MAX),
            json: serde_json::from_str(&line(Some(&audit.scene), &audit)).expect("JSON"),
            prices: audit.prices.expect("it has a solution"),
        }
    }
}

/// The audit of the paper's example, which takes 42 s of a processor, once for all tests.
pub static STRAND: LazyLock<Audited> = LazyLock::new(|| Audited::new(&CASE));

/// What a command prints as JSON; of the audit of strand what the program would.
fn printed(command: &[&str]) -> Value {
    match command {
        ["audit", "strand", "--json"] => STRAND.json.clone(),
        _ => json(command),
    }
}

#[test]
fn the_program_prints_what_an_audit_finds() {
    let ([screen, full], json) = (
        [&["audit", "fig1"][..], &["audit", "fig1", "--full"]].map(texts::printed),
        json(&["audit", "fig1", "--json"]),
    );
    let audited = Audited::new(&open("fig1"));
    assert!(audited.json == json && audited.screen == screen && audited.full == full);
}

/// A claim on the paper's example over the range.
pub fn judged(id: ClaimId) -> &'static JudgedClaim {
    &JUDGED[id as usize]
}

#[test]
fn a_claims_number_is_the_one_that_its_command_prints() {
    let mut known: BTreeMap<Vec<&str>, Value> = BTreeMap::new();
    // What is measured on random scenes stands in a table.
    for judged in JUDGED.iter().filter(|judged| judged.claim.basis != Basis::Random) {
        let (id, number) = (judged.claim.id.name(), judged.measured.number);
        let command: Vec<&str> = judged.command.iter().map(String::as_str).collect();
        let json = known.entry(command).or_insert_with_key(|command| printed(command));
        let at = |pointer: &String| {
            let value = json.pointer(pointer).and_then(Value::as_f64);
            value.unwrap_or_else(|| panic!("{id}: no number at {pointer}"))
        };
        let expected = judged.at.iter().map(at).reduce(|over, under| over / under);
        assert_eq!(number.is_some(), expected.is_some(), "{id}");
        if let Some((number, expected)) = number.zip(expected) {
            assert_near(id, number, expected, expected, &CLAIM);
        }
        // What `audit` itself prints of the claim is that number too.
        let own = json["claims"].as_array().and_then(|all| all.iter().find(|c| c["id"] == id));
        if let Some((own, expected)) = own.and_then(|own| own["number"].as_f64()).zip(expected) {
            assert_near(id, own, expected, expected, &CLAIM);
        }
    }
}

/// P10 beside what `trade` measures of the same two tolerances. On strand a thousandth of c_tol leaves it to
/// rounding who is in contact: the verdict stays, without a figure.
#[test]
fn the_change_by_c_tol_is_that_of_trade() {
    let p10 = judged(ClaimId::P10);
    assert_eq!((p10.measured.verdict, p10.measured.number), (Verdict::False, None));
    assert_eq!(p10.measured.detail, BY_ROUNDING);
    let trade = json(&["trade", "fig1", "--only", "c_tll", "--runs", "1", "--json"]);
    let rows = trade["sections"][0]["rows"].as_array().expect("rows");
    let row = rows.iter().find(|row| row["variant"] == "stepped" && row["setting"] == "1e-6");
    let change = row.expect("a row")["change"]["displacement"].as_f64().expect("a number");
    let measured = p10.claim.measure(&open("fig1"));
    assert_near("P10", measured.number.expect("a number"), change, change, &CLAIM);
}

/// What the conclusion says of wider ducts is so.
#[test]
fn in_wider_ducts_neither_p10_nor_p11_is_false() {
    assert!(WIDER.starts_with(
        "From a clearance of 0.9 mm on neither P10 nor P11 is false (true, or decided by rounding); from 5 mm on both"
    ));
    for judged in [ClaimId::P10, ClaimId::P11].map(judged) {
        let clearances = judged.elsewhere.iter();
        for at in clearances.filter(|at| at.place.parameter == Parameter::Clearance) {
            let (clearance, id) = (at.place.value, judged.claim.id);
            let verdict = at.measured.verdict;
            assert_eq!(verdict == Verdict::False, clearance < 0.9, "{id}, {clearance}");
            assert!(verdict == Verdict::True || at.measured.by_rounding || clearance < 0.9, "{id}");
            assert!(verdict == Verdict::True || clearance < 5.0, "{id}, {clearance}");
        }
    }
}

/// A verdict on runs has the error of the mesh in each of its runs, as `solve` prints them.
#[test]
fn verdicts_on_runs_name_the_errors_of_the_mesh() {
    let errors = |id: ClaimId| {
        let errors = judged(id).measured.mesh_errors.iter();
        errors.map(|error| error.energy_relative.expect("an estimate"))
    };
    for judged in &*JUDGED {
        let is_on_runs = judged.claim.basis == Basis::Runs;
        assert_eq!(judged.measured.mesh_errors.is_empty(), !is_on_runs, "{}", judged.claim.id);
    }
    let solved = |variant: &str| {
        let solved = json(&["solve", "strand", "--variant", variant, "--json"]);
        solved["error_estimates"]["mesh_energy_relative"].as_f64().expect("an estimate")
    };
    for (id, variant) in [(ClaimId::P1, "stepped"), (ClaimId::P11, "tied")] {
        let [own] = errors(id).collect::<Vec<_>>()[..] else { panic!("{id} rests on one run") };
        assert_near(id.name(), own, solved(variant), 1.0, &CLAIM);
    }
}

/// P2's value is the largest ratio over the path: with 0.1 % more friction all nodes stick, with 0.1 % less
/// they do not. At the end of the path the ratio is smaller.
#[test]
fn the_friction_that_ties_is_confirmed_by_a_run_on_either_side() {
    let judged = judged(ClaimId::P2);
    let value = judged.measured.number.expect("a coefficient");
    let scene = Scene::open("strand").expect("an embedded scene");
    let under = |friction: f64| {
        let mut request = Request::new(&scene).variant(Variant::Unilateral);
        request.contact.friction = Friction::new(friction).expect("a coefficient");
        solve(&request, &mut |_| ()).expect("an equilibrium")
    };
    let sticking = under(f64::INFINITY);
    let apart = |friction| distance(&under(friction), &sticking).displacement_relative;
    assert_eq!(apart(1.001 * value), 0.0);
    assert!(apart(0.999 * value) > 1e-6);
    let at_the_end = sticking.contact.iter().filter_map(|node| node.friction_needed);
    assert!(at_the_end.fold(0.0, f64::max) < 0.9 * value);
}

/// Under `stepped` a node that is not in contact ends inside the target.
#[test]
fn penetration_is_that_of_the_contact_surface() {
    let solved = json(&["solve", "strand", "--variant", "stepped", "--json"]);
    let number = |value: &Value| value.as_f64().expect("a number");
    let nodes = solved["contact"].as_array().expect("nodes");
    let gap = nodes.iter().map(|node| number(&node["gap"])).fold(0.0, f64::min);
    let bodies = solved["bodies"].as_array().expect("bodies").iter();
    let block = bodies.clone().find(|body| body["name"] == "block").expect("a body");
    let expected = -gap / number(&block["max_displacement"]);
    let judged = judged(ClaimId::P1);
    assert_near("P1", judged.measured.number.expect("a number"), expected, expected, &CLAIM);
    assert_eq!(judged.measured.verdict, Verdict::False);
}

/// What the table of verdicts by reading says of a reading is what an audit under it prints.
#[test]
fn a_verdict_by_reading_is_that_of_an_audit_under_it() {
    let as_printed = json(&["audit", "fig1", "--json"]);
    let node_n = json(&["audit", "fig1", "--reading", "R5=node_n", "--json"]);
    let rows = as_printed["by_reading"].as_array().expect("rows");
    let row = rows.iter().find(|row| row["reading"] == "R5 = node_n").expect("R5 is tried");
    for verdict in row["claims"].as_array().expect("claims") {
        let claims = node_n["claims"].as_array().expect("claims").iter();
        let claim =
            claims.clone().find(|claim| claim["id"] == verdict["id"]).expect("it is judged");
        for key in ["verdict", "number", "detail"] {
            assert_eq!(claim[key], verdict[key], "{}", verdict["id"]);
        }
    }
    let verdict = |json: &Value, id: &str| {
        let claims = json["claims"].as_array().expect("claims");
        claims.iter().find(|claim| claim["id"] == id).expect("a claim")["verdict"].clone()
    };
    // The search takes current coordinates whatever the weights take.
    assert_eq!([verdict(&as_printed, "P4"), verdict(&node_n, "P4")], ["true", "true"]);
    // Under it two variants are equally near: both are named.
    let claims = node_n["claims"].as_array().expect("claims");
    let p12 = claims.iter().find(|claim| claim["id"] == "P12").expect("it is judged");
    assert_eq!(p12["detail"], "stepped and tied are equally near");
}

/// The corrected algorithm is no reading of the print: of a reading only what changes the model matters.
#[test]
fn of_a_reading_prices_follow_the_model_alone() {
    let prices =
        |reading: &str| json(&["audit", "fig1", "--reading", reading, "--json"])["prices"].clone();
    let as_printed = prices("R1=beside");
    assert!(as_printed["Ok"].is_array());
    assert_eq!(prices("R1=inside,R5=node_n"), as_printed);
    assert_ne!(prices("R6=stress"), as_printed);
}

#[test]
fn every_claim_has_the_papers_words_and_ours() {
    assert!(CLAIMS.iter().all(|claim| ![claim.quote, claim.translation].contains(&"")));
}

/// What is said of the estimate of the error of the mesh is what its table has.
#[test]
fn the_estimates_are_those_of_the_table() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/tables/mesh_errors.md");
    let table = fs::read_to_string(file).expect("the table");
    let last = |row: &str| row.trim_end_matches(" |").rsplit("| ").next()?.parse::<f64>().ok();
    let mut quotients: Vec<f64> = table.lines().filter_map(last).collect();
    quotients.sort_by(f64::total_cmp);
    let below = quotients.iter().filter(|quotient| **quotient < 1.0).count();
    let expected = format!(
        "it was below the error in {below} of {} runs, at the median {:.2} of it",
        quotients.len(),
        quotients[quotients.len() / 2]
    );
    assert!(ESTIMATES.contains(&expected), "{expected}");
}

/// A verdict is said to hold over the range only where every place was tried and has the same.
#[test]
fn a_scope_is_what_was_tried() {
    for judged in &*JUDGED {
        let same =
            judged.elsewhere.iter().all(|other| other.measured.verdict == judged.measured.verdict);
        match judged.scope {
            Scope::AnyScene | Scope::Drawn | Scope::Nowhere => {
                assert!(judged.elsewhere.is_empty(), "{}", judged.claim.id)
            }
            Scope::Range => assert!(same && judged.elsewhere.len() == RANGE.len()),
            Scope::OneScene => assert!(!same, "{}", judged.claim.id),
        }
    }
    for judged in judge(CLAIMS, &open("fig1"), &Range::new()) {
        assert!(judged.elsewhere.is_empty() && judged.scope != Scope::Range);
        let known =
            judged.measured.number.is_some() || judged.measured.verdict == Verdict::NotCheckable;
        assert!(known, "{}", judged.claim.id);
    }
}

/// The distances that a list of an audit has at a pointer.
fn distances<'a>(audit: &'a Value, list: &str, at: &'a str) -> impl Iterator<Item = f64> + 'a {
    let rows = audit[list].as_array().expect("a list").iter();
    rows.filter_map(move |row| row.pointer(at)?.as_f64())
}

/// The conclusion of an audit: its numbers are those of the rows that it is drawn of.
#[test]
fn a_conclusion_has_the_numbers_of_its_rows() {
    for scene in ["strand", "fig1", "two-blocks"] {
        let audit = printed(&["audit", scene, "--json"]);
        let conclusion = |at: &str| audit["conclusion"].pointer(at).and_then(Value::as_f64);
        let k1 = json(&["audit", scene, "--finding", "K1", "--json"]);
        assert_eq!(conclusion("/coupled/joins"), k1["number"].as_f64(), "{scene}");
        let of_the_paper = audit["variants"].as_array().expect("variants").iter();
        let of_the_paper = of_the_paper.filter(|row| row["variant"] != "unilateral");
        let of_the_paper =
            of_the_paper.filter_map(|row| row.pointer("/distance/energy_relative")?.as_f64());
        let is_apart = |run: &Value, far: f64| run["energy"].as_f64() == Some(far);
        let apart = audit.pointer("/conclusion/nearest/apart").and_then(Value::as_array);
        let apart = apart.expect("runs of another plane problem");
        let readings = distances(&audit, "readings", "/equilibrium_error");
        let readings = readings.filter(|far| !apart.iter().any(|run| is_apart(run, *far)));
        let least = of_the_paper.chain(readings).reduce(f64::min).expect("a run ends");
        let nearest = conclusion("/nearest/runs/0/energy").expect("a nearest run");
        assert_near(scene, nearest, least, least, &CLAIM);
    }
}
