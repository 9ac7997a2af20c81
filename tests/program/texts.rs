//! What users read, under snapshot: the texts of commands on fixed scenes, and every page of help.
//!
//! Words are exact. A number may differ by one in its last printed digit, and is not compared where
//! it is rounding itself (below 1e-9): residuals and what rounding does to a displacement.

use std::path::Path;

use tempfile::TempDir;

use crate::common::golden::assert_golden_by;
use crate::common::program::run;

/// Numbers below this are rounding.
const NOISE: f64 = 1e-9;

/// Prints what the program prints, without the folder that it was run in.
fn printed(args: &[&str]) -> String {
    let folder = TempDir::new().expect("a temporary folder");
    let output = run(folder.path(), args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn assert_text(folder: &str, name: &str, args: &[&str]) {
    assert_golden_by(folder, name, &printed(args), same_text);
}

fn same_text(expected: &str, value: &str) -> bool {
    let (expected, value) = (expected.trim_end(), value.trim_end());
    let different = expected.lines().zip(value.lines()).find(|(e, v)| !same_line(e, v));
    if let Some((e, v)) = different {
        eprintln!("expected {e}\n     got {v}");
    }
    different.is_none() && expected.lines().count() == value.lines().count()
}

fn same_line(expected: &str, value: &str) -> bool {
    let (expected, value) = (words(expected), words(value));
    expected.len() == value.len() && expected.iter().zip(&value).all(|(e, v)| same_word(e, v))
}

/// The words of a line; a rule under a heading is as wide as its column, whatever that is.
fn words(line: &str) -> Vec<&str> {
    let word = |word: &&str| !(word.len() > 1 && word.chars().all(|c| c == '-'));
    line.split([' ', ',', ';', '(', ')', '=', '%']).filter(|w| !w.is_empty()).filter(word).collect()
}

fn same_word(expected: &str, value: &str) -> bool {
    let (Some((e, step)), Some((v, _))) = (float(expected), float(value)) else {
        return expected == value;
    };
    let is_noise = |x: f64| x.abs() < NOISE;
    is_noise(e) && is_noise(v) || (e - v).abs() <= 1.001 * step
}

/// A number that is not whole, and one in its last printed digit.
fn float(word: &str) -> Option<(f64, f64)> {
    let value: f64 = word.parse().ok().filter(|_| word.contains(['.', 'e']) || word == "0")?;
    let (mantissa, exponent) = word.split_once('e').unwrap_or((word, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let exponent: i32 = exponent.parse().ok()?;
    Some((value, 10f64.powi(exponent - i32::try_from(decimals).ok()?)))
}

#[test]
fn texts_differ_by_words_and_by_more_than_a_digit() {
    assert!(same_text("a 0.123  5e-17", "a 0.124  0"));
    assert!(!same_text("a 0.123", "a 0.125"));
    assert!(!same_text("a 3", "a 4"));
    assert!(!same_text("a 1.5e-3", "a 1.7e-3"));
    assert!(!same_text("nodes 5, 6", "nodes 5, 7"));
    assert!(same_text("---  ----\n1", "----  ---\n1"));
}

const SCENES: [&str; 3] = ["fig1", "two-blocks", "strand"];

#[test]
fn solve() {
    for scene in SCENES {
        for variant in ["printed", "tied", "stepped", "unilateral"] {
            let args = ["solve", scene, "--variant", variant, "--out", "out"];
            assert_text(scene, &format!("solve-{variant}"), &args);
        }
    }
}

#[test]
fn audit() {
    SCENES.iter().for_each(|scene| assert_text(scene, "audit", &["audit", scene]));
    assert_text("findings/C4", "audit", &["audit", "--finding", "C4"]);
}

#[test]
fn plan() {
    SCENES.iter().for_each(|scene| assert_text(scene, "plan", &["plan", scene]));
}

#[test]
fn c_cnt() {
    SCENES.iter().for_each(|scene| assert_text(scene, "c-cnt", &["c-cnt", scene]));
}

#[test]
fn trace() {
    assert_text("fig1", "trace-c_cnt", &["trace", "fig1"]);
    assert_text("fig1", "trace-Km", &["trace", "fig1", "--listing", "Km", "--node", "7"]);
}

#[test]
fn help() {
    assert_text("help", "plane-contact", &["--help"]);
    let commands = commands();
    assert!(commands.len() >= 12, "{commands:?}");
    for command in &commands {
        assert_text("help", command, &[command, "--help"]);
    }
    let files = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/help"));
    for file in files.expect("the folder of help pages") {
        let name = file.expect("a file").file_name().into_string().expect("UTF-8");
        let page = name.trim_end_matches(".snap").to_string();
        assert!(page == "plane-contact" || commands.contains(&page), "{name} is no command's");
    }
}

/// The commands, as the first page of help lists them.
pub fn commands() -> Vec<String> {
    let page = printed(&["--help"]);
    let list = page.split("Commands:").nth(1).expect("a list of commands");
    let lines = list.lines().skip(1).take_while(|line| !line.is_empty());
    let names = lines
        .filter(|line| !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(String::from).collect()
}
