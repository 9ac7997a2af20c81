//! The register of claims: every number is the one that its command prints.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use serde_json::Value;
use tempfile::TempDir;

use crate::common::program::run;
use crate::common::tolerances::{CLAIM, assert_near};
use plane_contact::Request;
use plane_contact::Scene;
use plane_contact::paper::mirror::Reading;
use plane_contact::studies::audit::Case;
use plane_contact::studies::audit::claims::{CLAIMS, JudgedClaim, Scope, Verdict, judge};
use plane_contact::studies::audit::range::{Range, range};
use plane_contact::studies::trade::{Section, geometry};

fn open(name: &str) -> Case {
    Case::new(Scene::open(name).expect("an embedded scene"))
}

/// The range of what the paper leaves open, whose runs are made once for all tests.
pub static RANGE: LazyLock<Range> =
    LazyLock::new(|| range(Reading::default()).expect("its values are allowed"));

/// The claims on the paper's example over the range.
pub static JUDGED: LazyLock<Vec<JudgedClaim>> =
    LazyLock::new(|| judge(CLAIMS, &open("strand"), &RANGE));

/// What `trade` says of the range.
pub static GEOMETRY: LazyLock<Section> = LazyLock::new(|| {
    // Its runs are made once, by one test: see `Case::prepare`.
    LazyLock::force(&JUDGED);
    let strand = Scene::open("strand").expect("an embedded scene");
    geometry(&Request::new(&strand), &RANGE, &|_| ())
});

#[test]
fn a_claims_number_is_the_one_that_its_command_prints() {
    let folder = TempDir::new().expect("a temporary folder");
    let mut printed: BTreeMap<&[&str], Value> = BTreeMap::new();
    for claim in CLAIMS {
        let json = printed.entry(claim.command).or_insert_with(|| {
            let output = run(folder.path(), claim.command);
            serde_json::from_slice(&output.stdout).expect("the command prints JSON")
        });
        let at = |pointer: &&str| {
            let value = json.pointer(pointer).and_then(Value::as_f64);
            value.unwrap_or_else(|| panic!("{}: no number at {pointer}", claim.id))
        };
        let values: Vec<f64> = claim.at.iter().map(at).collect();
        let expected = values.iter().copied().reduce(|over, under| over / under);
        let judged =
            JUDGED.iter().find(|judged| judged.claim.id == claim.id).expect("it is judged");
        let number = judged.measured.number;
        assert_eq!(number.is_some(), expected.is_some(), "{}", claim.id);
        if let Some((number, expected)) = number.zip(expected) {
            assert_near(claim.id, number, expected, expected, &CLAIM);
        }
        // What `audit` itself prints of the claim is that number too.
        let own =
            json["claims"].as_array().and_then(|all| all.iter().find(|c| c["id"] == claim.id));
        if let Some((own, expected)) = own.and_then(|own| own["number"].as_f64()).zip(expected) {
            assert_near(claim.id, own, expected, expected, &CLAIM);
        }
    }
}

#[test]
fn claims_stand_in_the_order_of_the_text_each_once() {
    let ids: BTreeSet<&str> = CLAIMS.iter().map(|claim| claim.id).collect();
    assert_eq!(ids.len(), CLAIMS.len());
    assert!(CLAIMS.windows(2).all(|pair| pair[0].line <= pair[1].line));
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
