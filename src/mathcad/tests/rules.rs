//! Each rule of `src/mathcad/README.md` on the smallest program that shows it: `rules.txt`; and what the page's
//! interpreter lacks, which runs those too: `edges.txt`.
//!
//! ```text
//! # What is shown.
//! under origin=0              settings, where they are others
//! a[2] ← 7                    the lines of a program of x = 5, v = (1 2 3)ᵀ and m = (1 2; 3 4)
//! a ⇒ 0; 0; 7                 its last line and its value, or `!` and where and why it fails
//! ```
//!
//! `INSTA_UPDATE=always` writes values and failures anew.

use super::{outcome, program, xmcd};

use mathcad::failure::Fallible;
use mathcad::{Ended, Settings};
use testing::golden_file::is_written;

struct Rule {
    settings: Settings,
    /// All that stands before the arrow.
    text: String,
    lines: String,
    expected: String,
}

fn rules(text: &str) -> Vec<Rule> {
    let mut rules = Vec::new();
    let (mut before, mut lines, mut settings) = (String::new(), String::new(), "");
    for line in text.lines() {
        let under = line.strip_prefix("under ");
        match line.rsplit_once(" ⇒ ") {
            Some((last, expected)) => {
                rules.push(Rule {
                    settings: std::mem::take(&mut settings).parse().expect("settings"),
                    text: std::mem::take(&mut before) + last,
                    lines: std::mem::take(&mut lines) + last,
                    expected: expected.into(),
                });
                continue;
            }
            None if under.is_some() => settings = under.unwrap_or_default(),
            None if lines.is_empty() && (line.is_empty() || line.starts_with('#')) => (),
            None => lines += &format!("{line}\n"),
        }
        before += &format!("{line}\n");
    }
    rules
}

fn in_words(outcome: Fallible<Ended>) -> String {
    match outcome {
        Ok(ended) => ended.value.to_string(),
        Err(failure) => format!("! line {}: {}", failure.line, failure.cause),
    }
}

#[track_caller]
fn hold(file: &str) {
    let path = format!("{}/tests/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect("rules");
    let (mut written, mut wrong) = (String::new(), Vec::new());
    for Rule { settings, text, lines, expected } in rules(&text) {
        let found = in_words(outcome(&lines, &settings));
        written += &format!("{text} ⇒ {found}\n");
        if found != expected {
            wrong.push(format!("{lines} ⇒ {found}\nin place of {expected}"));
        }
    }
    if is_written() {
        std::fs::write(path, written).expect("rules");
    } else {
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
        assert_eq!(written, text, "what stands behind the last rule?");
    }
}

#[test]
fn rules_hold() {
    hold("rules.txt");
}

#[test]
fn edges_hold() {
    hold("edges.txt");
}

const BOTH: &str = concat!(include_str!("rules.txt"), include_str!("edges.txt"));

/// The names of all functions stand in quotation marks in their table.
#[test]
fn every_function_has_a_line() {
    let table = include_str!("../function.rs").split("static BUILTINS").nth(1).expect("a table");
    let rows = table.split("\n};").next().expect("its end");
    let names = rows.split(['"']).skip(1).step_by(2).filter(|name| !name.contains(' '));
    let missing: Vec<&str> = names.filter(|name| !BOTH.contains(&format!("{name}("))).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// None is lost, and the worksheet that they make is the same again.
#[test]
fn programs_come_back_from_worksheets() {
    for Rule { settings, lines, .. } in rules(BOTH) {
        let listing = program(&lines);
        let once = xmcd::there_and_back(&listing).expect("a worksheet");
        let body = once.split_once('\n').map_or("", |(_, body)| body).replace("\n  ", "\n");
        let [own, again] = [&lines[..], body.trim_start_matches("  ")]
            .map(|lines| outcome(lines, &settings).map(|ended| ended.value.to_string()));
        let kind = |failure: Box<mathcad::Failure>| std::mem::discriminant(&failure.cause);
        assert_eq!(again.map_err(kind), own.map_err(kind), "{lines}\n{once}");
    }
}
