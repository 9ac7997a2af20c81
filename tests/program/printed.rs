//! What is printed fits a width, and its tables are CSV.

use std::path::Path;

use plane_contact::output::model::{Cell, Report, Table};
use plane_contact::output::text::fitted;
use tempfile::TempDir;

use crate::claims::STRAND;
use crate::common::golden_file::assert_file;
use crate::common::program::run;
use crate::texts::commands;

fn printed(folder: &Path, args: &[&str]) -> String {
    String::from_utf8(run(folder, args).stdout).expect("UTF-8")
}

fn report() -> Report {
    let rows = [
        (1, Cell::from("new"), Cell::from("a \"b\"")),
        (2, Cell::from("as in 1, a turn"), Cell::from(None::<f64>).because("nothing moves")),
    ];
    let table = Table::from_rows(rows)
        .column("k", |(k, ..)| *k as usize)
        .column("contact state", |(_, state, _)| state.clone())
        .column("remark", |(.., remark)| remark.clone());
    Report::titled("A run").table("Iterations (all)", table).note("(1) a note that is no row")
}

/// Compares with a file of `printed`.
#[track_caller]
fn assert_printed(name: &str, text: &str) {
    assert_file(format!("tests/program/printed/{name}"), text);
}

/// In 80 columns, in 25, and in 18, where the table turns to records.
#[test]
fn tables_turn_to_records() {
    assert_printed("text.txt", &[80, 25, 18].map(|width| report().text(width)).join("\n"));
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
fn nothing_printed_controls_a_terminal() {
    let controls = "\u{1b}[31m \u{7} \r \u{7f} \u{9b} \u{202e} \u{2066}";
    assert_eq!(fitted(&format!("a\t{controls} é\n"), 80), "a\t�[31m � � � � � � é\n");
    let cell = Table::new(["a\u{1b}"], [vec!["\u{202e}\n".into()]]);
    assert_eq!(Report::default().table("\u{7}", cell).text(80), "�\n  a�\n  --\n  �\n");
}

/// Numbers have all their digits, those that are missing none; a name that repeats has a number.
#[test]
fn tables_are_csv() {
    let table = Table::new(
        ["short", "share", "missing"],
        [vec![(1.0 / 3.0).into(), Cell::percent(0.125), Cell::decimals(f64::NAN, 1)]],
    );
    let report = report().table("Iterations, more", table);
    let first = "k,contact state,remark\r\n1,new,\"a \"\"b\"\"\"\r\n2,\"as in 1, a turn\",\r\n";
    let second = "short,share,missing\r\n0.3333333333333333,0.125,\r\n";
    let files = [("iterations", first), ("iterations-2", second)];
    assert_eq!(report.csv(), files.map(|(name, csv)| (name.to_string(), csv.to_string())));
}

/// Words that a spreadsheet would take for a formula stand behind an apostrophe; numbers stay as they are.
#[test]
fn no_cell_of_csv_is_a_formula() {
    let cells = ["=1+1", "+a", "-a", "@a", "\ta", "-1.5", "a=b", "\u{1b}a"];
    let row = cells.map(Cell::from).into_iter().chain([Cell::from(-2.5)]).collect();
    let csv = Table::new(["=h", "", "", "", "", "", "", "", ""], [row]).csv();
    assert_eq!(csv, "'=h,,,,,,,,\r\n'=1+1,'+a,'-a,'@a,'\ta,-1.5,a=b,�a,-2.5\r\n");
    let cells =
        ["a;=1+1", " =1", "＝1+1", "a|-b", "a;-1", "a - b"].map(|text| Cell::Text(text.into()));
    let csv = Table::new([""; 6], [cells.to_vec()]).csv();
    assert_eq!(csv, ",,,,,\r\na;'=1+1,' =1,'＝1+1,a|'-b,a;-1,a - b\r\n");
}

/// `format!` has no width beyond 65,535.
#[test]
fn a_cell_may_have_any_length() {
    let long = "x".repeat(70_000);
    let table = Table::new([&long[..], "b"], [vec![1.0.into(), (&long[..]).into()]]);
    let text = Report::default().table("", table.clone()).text(usize::MAX);
    assert_eq!(text.lines().next().map(str::len), Some(100));
    let narrow = Report::default().table("", table).text(80);
    assert_eq!(narrow.matches('x').count(), 140_000);
}

#[test]
fn a_report_is_markdown() {
    assert_printed("report.md.txt", &report().code("```\n").line("a_b").markdown());
}

/// Notes are lists, numbers stand to the right with all their digits beside them, nothing is markup.
#[test]
fn a_report_is_html() {
    let missing = Cell::from(None::<f64>).because("nothing moves");
    let table =
        Table::new(["a", "b"], [vec!["x".into(), Cell::percent(0.125)], vec!["".into(), missing]]);
    let report =
        Report::titled("A run").line("a <b> `c` &").note("one").detail("inner").note("two");
    let report = report.code("<x>\n").figure("Figure 4: \"m\"", "<svg/>").table("T", table);
    let part = Report::default().heading("P1: b").deeper(1).note("c");
    let unfolding = Report::default().heading("A part").then(part).heading("Another");
    assert_printed("report.html", &[report.html(), unfolding.html()].join("\n"));
}

const FACTORIAL: &str = "fact(n) :=
  trace(n)
  return 1 if n ≤ 1
  n·fact(n − 1)
";

/// Texts for people: of commands that end well, of errors, of a listing that fails.
const TEXTS: &[&str] = &[
    "solve fig1 --no-pictures",
    "solve fig1 --variant unilateral --check-rounding --no-pictures",
    "audit fig1",
    "audit --finding C4",
    "scene plan fig1",
    "listing run c_cnt fig1",
    "listing evaluate fact.txt --call fact(3)",
    "listing evaluate wrong.txt --call f(1)",
    "snapshot record fig1",
    "solve nosuch",
    "solve fig1 --varient x",
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
    let wrong = FACTORIAL.replace("n·fact", "n·(fact");
    for (name, text) in [("fact.txt", FACTORIAL), ("wrong.txt", wrong.as_str())] {
        std::fs::write(at.join(name), text).expect("it is written");
    }
    let helps = commands().into_iter().map(|command| format!("{command} --help"));
    for line in TEXTS.iter().map(|line| line.to_string()).chain(["--help".into()]).chain(helps) {
        let args: Vec<&str> = line.split(' ').collect();
        for columns in [40, 80] {
            let text = in_columns(at, &columns.to_string(), &args);
            assert!(!text.is_empty(), "{line}");
            let is_wide = |line: &&str| line.chars().count() > columns;
            let wide: Vec<&str> = text.lines().filter(is_wide).collect();
            assert!(wide.is_empty(), "{line} in {columns} columns: {wide:#?}");
        }
    }
}

/// Where no terminal says how wide it is, a table has at most 100 columns; prose has whole lines.
#[test]
fn tables_fit_a_hundred_columns() {
    let folder = TempDir::new().expect("a folder");
    for scene in ["strand", "fig1", "two-blocks"] {
        for command in [
            "solve SCENE --no-pictures --out o",
            "solve SCENE --variant unilateral --no-pictures --out u",
            "solve SCENE --variant tied --no-pictures --iterations --out t",
            "audit SCENE",
            "audit SCENE --full",
            "trade SCENE --only mesh",
            "scene plan SCENE",
            "listing run c_cnt SCENE",
        ] {
            let command = command.replace("SCENE", scene);
            let text = match &*command {
                "trade strand --only mesh" => continue,
                "audit strand" => STRAND.screen.clone(),
                "audit strand --full" => STRAND.full.clone(),
                other => printed(folder.path(), &other.split(' ').collect::<Vec<_>>()),
            };
            let lines: Vec<&str> = text.lines().collect();
            let is_rule =
                |line: &str| line.starts_with("  -") && line.chars().all(|c| c == '-' || c == ' ');
            for (k, _) in lines.iter().enumerate().filter(|(_, line)| is_rule(line)) {
                let rows = lines[k..].iter().take_while(|line| line.starts_with("  "));
                for line in rows.take(6).chain([&lines[k - 1]]) {
                    assert!(line.chars().count() <= 100, "{command}: {line}");
                }
            }
        }
    }
}

/// A column is broken between words before a table turns to records.
#[test]
fn columns_are_broken_between_words() {
    let rows = [("C1", "a node on a corner is found twice", 1.5), ("C2", "short", 22.0)];
    let rows = rows.map(|(id, what, value)| vec![id.into(), what.into(), value.into()]);
    let table = Table::new(["id", "what it is", "value, mm"], rows);
    assert_printed("columns.txt", &Report::default().table("", table).text(31));
}
