//! What Mathcad itself saved: expressions of public worksheets with their results (`evidence.json`,
//! each with its source), evaluated here, bit for bit.

use mathcad::{Limits, Listing, Sheet, Value, json};
use serde_json::Value as Json;

/// The numbers of a saved result, in order; Mathcad spells them with 15 digits or 17.
fn numbers(json: &Json, found: &mut Vec<f64>) {
    match json {
        Json::String(text) => found.push(text.parse().expect("a number")),
        Json::Array(list) => list.iter().for_each(|entry| numbers(entry, found)),
        other => panic!("{other} is no saved result"),
    }
}

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Number(x) => vec![*x],
        Value::Array(a) => a.entries().copied().collect(),
        other => panic!("{} is no array of numbers", other.kind()),
    }
}

/// How many expressions are evaluated, how many numbers Mathcad saved of them, and how many of
/// those have the same bits here.
pub fn counts() -> [usize; 3] {
    let cases: Vec<Json> =
        serde_json::from_str(include_str!("evidence.json")).expect("the figures are JSON");
    let (mut saved, mut same) = (0, 0);
    for case in &cases {
        let mut sheet = Sheet::default();
        for (name, value) in case["inputs"].as_object().expect("inputs") {
            sheet.define(name, json::read(value).expect("an input"));
        }
        let settings = &case["settings"];
        let settings = format!(
            "origin={},zero-over-zero={},exact-boolean={}",
            settings["origin"],
            settings["zero_over_zero"].as_str().expect("a setting"),
            settings["exact_boolean"]
        );
        let text = format!("_() :=\n  {}", case["expression"].as_str().expect("an expression"));
        let limits = Limits { characters: 10_000, ..Limits::default() };
        let listing = Listing::parse_within("figure", &text, &limits)
            .unwrap_or_else(|error| panic!("{}: {error}", case["source"]));
        let run = listing.runner(&sheet, &settings.parse().expect("settings"), &limits).call(&[]);
        let ours = run.unwrap_or_else(|failure| panic!("{}: {failure}", case["source"])).value;
        let mut expected = vec![];
        numbers(&case["saved"], &mut expected);
        let ours = flat(&ours);
        assert_eq!(ours.len(), expected.len(), "{} {}", case["source"], case["region"]);
        saved += expected.len();
        same += ours.iter().zip(&expected).filter(|(x, y)| x == y).count();
    }
    [cases.len(), saved, same]
}

#[test]
fn every_saved_number_has_the_same_bits() {
    let [cases, saved, same] = counts();
    assert_eq!(saved, same, "of {cases} expressions");
    assert_eq!([cases, saved], [153, 561]);
}
