//! What is printed fits a width, and its tables are CSV.

use std::path::Path;

use plane_contact::report::printed::{fitted, tables};
use tempfile::TempDir;

use crate::common::program::run;

fn printed(folder: &Path, args: &[&str]) -> String {
    String::from_utf8(run(folder, args).stdout).expect("UTF-8")
}

fn longest(text: &str) -> usize {
    text.lines().map(|line| line.chars().count()).max().unwrap_or(0)
}

const TEXT: &str = "Iterations (all)
  k  contact state    remark
  -  ---------------  ------
  1  new              a \"b\"
  2  as in 1, a turn
  (1) a note that is no row of the table
";

#[test]
fn tables_turn_to_records() {
    assert_eq!(fitted(TEXT, 80), TEXT, "it fits");
    let narrow = "Iterations (all)
  k 1
    contact state  new
    remark         a \"b\"
  k 2
    contact state  as in
                   1, a
                   turn
  (1) a note that is no
    row of the table
";
    assert_eq!(fitted(TEXT, 25), narrow);
}

#[test]
fn tables_are_csv() {
    let csv = "k,contact state,remark\r\n1,new,\"a \"\"b\"\"\"\r\n2,\"as in 1, a turn\",\r\n";
    assert_eq!(tables(TEXT), [("iterations".to_string(), csv.to_string())]);
}

/// Every command with tables fits 80 and 120 columns, and loses no row; without a terminal and
/// without the variable its lines are whole.
#[test]
fn every_table_fits() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    for args in [
        &["audit", "fig1"][..],
        &["audit", "--finding", "C4"],
        &["solve", "fig1", "--no-pictures"],
        &["plan", "strand"],
        &["c-cnt", "fig1"],
        &["scenes"],
        &["trace", "fig1"],
        &["trace", "fig1", "--summary"],
        &["trace", "fig1", "--listing", "Km", "--node", "7"],
    ] {
        let whole = printed(at, args);
        for width in [80, 120] {
            let text = fitted(&whole, width);
            assert!(longest(&text) <= width, "{args:?} at {width}: {}", longest(&text));
            let cells = tables(&whole).iter().map(|(_, csv)| csv.lines().count()).sum::<usize>();
            assert!(text.lines().count() >= cells, "{args:?}: rows are lost");
        }
    }
    let narrow = std::process::Command::new(env!("CARGO_BIN_EXE_plane-contact"))
        .args(["audit", "fig1"])
        .env("COLUMNS", "80")
        .output()
        .expect("it starts");
    assert!(longest(&String::from_utf8(narrow.stdout).expect("UTF-8")) <= 80);
    assert!(String::from_utf8(narrow.stderr).expect("UTF-8").starts_with("auditing fig1"));
}

#[test]
fn tables_are_written_as_csv() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    printed(at, &["solve", "fig1", "--no-pictures", "--csv", "tables"]);
    let csv = std::fs::read_to_string(at.join("tables/iterations.csv")).expect("a table");
    assert_eq!(csv.lines().count(), 1 + 20);
    assert!(csv.starts_with("k,in contact,"), "{csv}");
    for name in ["bodies", "contact-surface"] {
        assert!(at.join(format!("tables/{name}.csv")).exists(), "{name}");
    }
    let refused = run(at, &["solve", "fig1", "--json", "--csv", "tables"]);
    assert_eq!(refused.status.code(), Some(2));
}
