//! What is printed fits a width, and its tables are CSV.

use std::path::Path;

use plane_contact::report::printed::{fitted, tables};
use tempfile::TempDir;

use crate::common::program::run;
use crate::texts::commands;

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

/// A heading too long to have cells beside it.
#[test]
fn cells_stand_behind_headings_where_they_do_not_fit_beside_them() {
    let wide = "  id  what the listing does that the text does not say
  --  ------------------------------------------------
  C1  a node on a corner is found twice
";
    let narrow = "  id C1
    what the listing does that the text
      does not say: a node on a corner
      is found twice
";
    assert_eq!(fitted(wide, 40), narrow);
}

/// A word that is longer than a line is broken, behind a slash where it has one.
#[test]
fn words_longer_than_a_line_are_broken() {
    let pointer = "  P10: /sections/0/rows/6/change/displacement/of\n";
    let broken = "  P10:\n    /sections/0/rows/6/\n    change/displacement/\n    of\n";
    assert_eq!(fitted(pointer, 25), broken);
    assert_eq!(
        fitted(&"x".repeat(60), 25),
        format!("{0}\n{0}\n{1}\n", "x".repeat(25), "x".repeat(10))
    );
}

#[test]
fn nothing_printed_commands_a_terminal() {
    let controls = "\u{1b}[31m \u{7} \r \u{7f} \u{9b} \u{202e} \u{2066}";
    assert_eq!(fitted(&format!("a\t{controls} é\n"), 80), "a\t�[31m � � � � � � é\n");
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
        &["scene", "plan", "strand"],
        &["listing", "run", "c_cnt", "fig1"],
        &["scene", "list"],
        &["listing", "trace", "fig1"],
        &["listing", "trace", "fig1", "--summary"],
        &["listing", "trace", "fig1", "--listing", "Km", "--node", "7"],
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

const FACTORIAL: &str = "fact(n) :=
  trace(n)
  return 1 if n ≤ 1
  n·fact(n − 1)
";

/// Every text for people, of commands that end well and of others, in an order in which the files of
/// one are those of the next.
const TEXTS: &[&str] = &[
    "solve fig1 --no-pictures",
    "solve fig1 --variant printed --no-pictures --probe 0.5,-0.5",
    "solve fig1 --variant unilateral --accuracy 1e-3",
    "solve fig1 --variant tied --c-cnt c_cnt.txt",
    "audit fig1",
    "audit --finding C4",
    "scene plan fig1",
    "listing run c_cnt fig1",
    "scene list",
    "listing trace fig1",
    "listing trace fig1 --summary",
    "listing trace fig1 --listing Km --node 7",
    "listing trace fig1 --reading R4=left-to-right",
    "listing trace fig1 --listing c_cnt.txt",
    "extremes --list",
    "extremes offset",
    "audit --statuses --scenes 3",
    "trade fig1 --runs 1 --only solver",
    "trade fig1 --runs 1 --only mesh,c_tll",
    "compare fig1",
    "listing run c_cnt fig1 --reading R4=left-to-right",
    "scene mesh blocks",
    "scene copy fig1",
    "snapshot record fig1",
    "snapshot verify out/fig1.snapshot.json",
    "snapshot verify out/fig1.snapshot.json --scene two-blocks",
    "snapshot explain out/fig1.snapshot.json --scene two-blocks",
    "snapshot diff fig1 --variant tied,stepped",
    "snapshot accept out/fig1.snapshot.json --scene two-blocks --reason because",
    "sweep sweep.json",
    "listing evaluate fact.txt --call fact(3)",
    "listing evaluate fact.txt --call g(3)",
    "listing evaluate wrong.txt --call f(1)",
    "mathcad run w.xmcd",
    "lesson fig1",
    "report fig1 --no-audit --variant tied",
    "schema",
    "solve nosuch",
    "solve fig1 --varient x",
    "snapshot verify fact.txt",
];

/// Runs the program where lines have `columns` characters; returns both of its outputs.
fn in_columns(folder: &Path, columns: &str, args: &[&str]) -> String {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_plane-contact"))
        .args(args)
        .env("COLUMNS", columns)
        .current_dir(folder)
        .output()
        .expect("it starts");
    [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("UTF-8")).concat()
}

#[test]
fn every_text_fits_forty_columns_and_more() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    let listing = include_str!("../../listings/c_cnt.txt").replace('<', "≤");
    let sweep = r#"{"format":1,"scene":"fig1","list":[{"/scene/contact/c_tll":0.002}]}"#;
    let wrong = FACTORIAL.replace("n·fact", "n·(fact");
    for (name, text) in [
        ("c_cnt.txt", listing.as_str()),
        ("fact.txt", FACTORIAL),
        ("wrong.txt", wrong.as_str()),
        ("sweep.json", sweep),
    ] {
        std::fs::write(at.join(name), text).expect("it is written");
    }
    run(at, &["mathcad", "export", "fig1", "--to", "mathcad", "--out", "w.xmcd"]);
    let helps = commands().into_iter().map(|command| format!("{command} --help"));
    for line in TEXTS.iter().map(|line| line.to_string()).chain(["--help".into()]).chain(helps) {
        let args: Vec<&str> = line.split(' ').collect();
        for columns in [40, 60, 80] {
            let text = in_columns(at, &columns.to_string(), &args);
            assert!(!text.is_empty(), "{line}");
            let is_wide = |line: &&str| line.chars().count() > columns;
            let wide: Vec<&str> = text.lines().filter(is_wide).collect();
            assert!(wide.is_empty(), "{line} in {columns} columns: {wide:#?}");
        }
    }
    let fewer =
        ["20", "40"].map(|columns| in_columns(at, columns, &["listing", "run", "c_cnt", "fig1"]));
    assert_eq!(fewer[0], fewer[1]);
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
