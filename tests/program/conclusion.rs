//! The conclusion of an audit: its numbers are those of the rows that it is drawn of.

use serde_json::Value;
use tempfile::TempDir;

use crate::common::program::run;
use crate::common::tolerances::{CLAIM, assert_near};

fn json_of(folder: &TempDir, args: &[&str]) -> Value {
    serde_json::from_slice(&run(folder.path(), args).stdout).expect("the command prints JSON")
}

/// The distances that a list of an audit has at a pointer.
fn distances<'a>(audit: &'a Value, list: &str, at: &'a str) -> impl Iterator<Item = f64> + 'a {
    let rows = audit[list].as_array().expect("a list").iter();
    rows.filter_map(move |row| row.pointer(at)?.as_f64())
}

#[test]
fn a_conclusion_has_the_numbers_of_its_rows() {
    let folder = TempDir::new().expect("a temporary folder");
    for scene in ["strand", "fig1", "two-blocks"] {
        let audit = json_of(&folder, &["audit", scene, "--json"]);
        let conclusion = |at: &str| audit["conclusion"].pointer(at).and_then(Value::as_f64);
        let k1 = json_of(&folder, &["audit", scene, "--finding", "K1", "--json"]);
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
