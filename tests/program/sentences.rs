//! Every sentence that sums up a table is computed again from the table's own JSON: its numbers are
//! those of the rows that it names.

use std::path::Path;

use plane_contact::engine::estimates::Certainty;
use plane_contact::engine::{Request, solve};
use plane_contact::problem::modelling::{Friction, Variant};
use plane_contact::problem::scene::Scene;
use plane_contact::report::{comparison, trade as report};
use plane_contact::studies::benchmark::{Annulus, Strand};
use plane_contact::studies::calculix::{Comparison, Contact, Fields, Pair};
use plane_contact::studies::trade::{Options, Varied, measure};
use serde_json::Value;
use tempfile::TempDir;

use crate::common::program::run;

/// The parts of `text` in the places of `{}` of a pattern; nothing where it does not fit.
fn parts<'t>(text: &'t str, pattern: &str) -> Option<Vec<&'t str>> {
    let mut literals = pattern.split("{}");
    let mut rest = text.strip_prefix(literals.next()?)?;
    let mut parts = Vec::new();
    let literals: Vec<&str> = literals.collect();
    for (k, literal) in literals.iter().enumerate() {
        let is_last = k + 1 == literals.len();
        let at = match is_last {
            true => rest.strip_suffix(literal)?.len(),
            false => rest.find(literal)?,
        };
        parts.push(&rest[..at]);
        rest = &rest[at + literal.len()..];
    }
    rest.is_empty().then_some(parts)
}

/// Whether a number is printed as `text`: within half a unit of its last digit, a whole one exactly; a share in per cent
/// where it ends so, and without a value where `x` has none.
fn shows(text: &str, x: &Value) -> bool {
    let Some(x) = x.as_f64() else { return ["-", "", "an undefined share (of 0)"].contains(&text) };
    let (text, factor) = match text.strip_suffix(" %") {
        Some(text) => (text, 100.0),
        None => (text, 1.0),
    };
    let Ok(value) = text.parse::<f64>() else { return false };
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    let exponent: i32 = exponent.parse().expect("an exponent");
    // A whole number is exact.
    let step = if text.contains(['.', 'e']) { 10f64.powi(exponent - decimals) } else { 0.0 };
    (value - factor * x).abs() <= 0.501 * step
}

#[track_caller]
fn assert_shows(text: &str, x: &Value, sentence: &str) {
    assert!(shows(text, x), "{text} is not {x}: {sentence}");
}

#[test]
fn parts_and_numbers_are_read() {
    assert_eq!(parts("a 1 b 2.", "a {} b {}."), Some(vec!["1", "2"]));
    assert_eq!(parts("a 1 c 2.", "a {} b {}."), None);
    assert!(shows("15.21 %", &0.15214.into()) && !shows("16.19 %", &0.15214.into()));
    assert!(shows("3e-15", &3.4e-15.into()) && !shows("3e-15", &3.6e-15.into()));
    assert!(shows("-", &Value::Null) && !shows("0", &Value::Null));
}

/// A section of `trade --json`.
struct Section<'a> {
    /// Those of the variant that the sentence is about, or all.
    rows: Vec<&'a Value>,
}

impl<'a> Section<'a> {
    fn find(json: &'a Value, variant: Option<&str>) -> Self {
        let rows = json["rows"].as_array().expect("rows").iter();
        let rows = rows.filter(|row| variant.is_none_or(|variant| row["variant"] == variant));
        Section { rows: rows.collect() }
    }

    fn row(&self, setting: &str) -> &'a Value {
        let mut rows = self.rows.iter().filter(|row| row["setting"] == setting);
        rows.next().unwrap_or_else(|| panic!("no row {setting}"))
    }

    fn own(&self) -> &'a Value {
        self.rows.iter().find(|row| row["own"] == true).expect("a row of the scene itself")
    }

    /// The rows of which something is known.
    fn known(&self, what: &str) -> Vec<&'a Value> {
        self.rows.iter().copied().filter(|row| !row[what].is_null()).collect()
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::INFINITY)
}

fn setting(row: &Value) -> f64 {
    row["setting"].as_str().expect("a text").parse().expect("a number")
}

/// The larger of what a change does to displacements and to stresses.
fn seen(row: &Value) -> f64 {
    number(&row["change"]["displacement"]).max(number(&row["change"]["von_mises"]))
}

/// Checks what a setting `moves`, in words: displacements and stresses.
fn assert_moves(words: &str, row: &Value, sentence: &str) {
    let numbers = parts(words, "displacements by {}, von Mises stresses by {}").expect(sentence);
    assert_shows(numbers[0], &row["change"]["displacement"], sentence);
    assert_shows(numbers[1], &row["change"]["von_mises"], sentence);
}

/// Checks `18 % at 1e-3, 7 % at 1e-6`: the errors of rows.
fn assert_far(words: &str, section: &Section, sentence: &str) {
    for words in words.split(", ") {
        let far = parts(words, "{} at {}").expect(sentence);
        assert_shows(far[0], &section.row(far[1])["error"]["displacement"], sentence);
    }
}

fn tolerance(words: &str, section: &Section) {
    let (own, known) = (section.own(), section.known("change"));
    let named = parts(words, "c_tll = {} is {}.{}").expect(words);
    assert_eq!(named[0].split(' ').next(), own["setting"].as_str(), "{words}");
    let smaller: Vec<&Value> =
        known.iter().copied().filter(|row| setting(row) < setting(own)).collect();
    let (words, far) =
        words.split_once(". From the equilibrium under the scene's own friction: ").expect(words);
    let (far, up) = match far.split_once(". Going up to ") {
        Some((far, up)) => (far, Some(up)),
        None => (far.trim_end_matches('.'), None),
    };
    assert_far(far, section, far);
    assert!(far.contains(&format!("at {}", own["setting"].as_str().unwrap())), "{far}");
    let larger = known.iter().filter(|row| setting(row) > setting(own));
    let largest = larger.max_by(|a, b| setting(a).total_cmp(&setting(b)));
    assert_eq!(up.is_some(), largest.is_some(), "{words}");
    if let Some((up, largest)) = up.zip(largest) {
        let up = parts(up, "{} moves {}.").expect(up);
        assert_eq!(up[0], largest["setting"], "{words}");
        assert_moves(up[1], largest, words);
    }
    let Some(most) = smaller.iter().copied().max_by(|a, b| seen(a).total_cmp(&seen(b))) else {
        assert!(words.ends_with("is the smallest that ran"), "{words}");
        return;
    };
    let (verdict, down) = words.split_once(" small enough: going down to ").expect(words);
    assert_eq!(verdict.ends_with("is not"), seen(most) >= 0.01, "{words}");
    let (down, worst) = match down.split_once("; of the smaller ones ") {
        Some((down, worst)) => (down, Some(worst)),
        None => (down, None),
    };
    let down = parts(down, "{} moves {}").expect(words);
    let least = smaller.iter().min_by(|a, b| setting(a).total_cmp(&setting(b))).expect("a row");
    assert_eq!(down[0], least["setting"], "{words}");
    assert_moves(down[1], least, words);
    match worst {
        Some(worst) => {
            let worst = parts(worst, "{} moves most: {}").expect(words);
            assert_eq!(seen(section.row(worst[0])), seen(most), "{words}");
            assert_moves(worst[1], section.row(worst[0]), words);
        }
        // In the digits printed the least moves as much.
        None => assert_moves(down[1], most, words),
    }
}

fn iterations(words: &str, section: &Section) {
    let pattern = "{} iterations are {}: {}; one more moves {}; {} of them move {}. From the \
                   equilibrium under the scene's own friction: {}.";
    let said = parts(words, pattern).expect(words);
    let (own, last) = (section.own(), *section.rows.last().expect("a row"));
    assert_eq!(said[0], own["setting"], "{words}");
    let next = section.row(&(setting(own) + 1.0).to_string());
    assert_eq!(said[1] == "enough", seen(next).max(seen(last)) < 0.01, "{words}");
    let state = match own["cycle"].as_u64() {
        Some(1) => "the contact state has settled".into(),
        Some(length) => format!("contact states repeat in a cycle of {length}, for ever"),
        None => "the contact state still changes".into(),
    };
    assert_eq!(said[2], state);
    assert_moves(said[3], next, words);
    assert_eq!(said[4], last["setting"], "{words}");
    assert_moves(said[5], last, words);
    assert_far(said[6], section, words);
}

fn nearest(words: &str, section: &Section) {
    let said = parts(words, "{} ({} from the equilibrium under the scene's own friction).");
    let said = said.expect(words);
    let known = section.known("error");
    let listed: Vec<&str> = said[1].split(", ").collect();
    assert_eq!(listed.len(), known.len(), "{words}");
    let error = |row: &Value| number(&row["error"]["displacement"]);
    for (listed, row) in listed.iter().zip(&known) {
        let (label, far) = listed.split_once(' ').expect("a setting and its error");
        assert_eq!(label, row["setting"], "{words}");
        assert_shows(far, &row["error"]["displacement"], words);
    }
    let least = known.iter().map(|row| error(row)).fold(f64::INFINITY, f64::min);
    let best = known.iter().filter(|row| error(row) == least);
    let best: Vec<&str> = best.map(|row| row["setting"].as_str().unwrap()).collect();
    let verdict = match best.len() {
        all if all == known.len() => "all the same".into(),
        1 => format!("{} is nearest", best[0]),
        _ => format!("{} are nearest", best.join(" and ")),
    };
    assert_eq!(said[0], verdict);
}

/// Checks a sentence that names its variant.
fn of_variant(parameter: &str, sentence: &str, json: &Value) {
    let (variant, words) = sentence.split_once(": ").expect(sentence);
    let section = Section::find(json, Some(variant));
    let mut words = words;
    // What is said of rounding names the rows that were run in more digits.
    for (marker, end, certainty) in [
        (" At ", " rounding in f64 may decide who is in contact", "in-double-double"),
        (" At ", " it is not known whether rounding decides", "unknown"),
    ] {
        let rows = section.rows.iter().filter(|row| row["certainty"] == certainty);
        let rows: Vec<&str> = rows.map(|row| row["setting"].as_str().unwrap()).collect();
        let said = format!("{marker}{}{end}", rows.join(", "));
        assert_eq!(sentence.contains(end), !rows.is_empty(), "{sentence}");
        assert!(rows.is_empty() || sentence.contains(&said), "{said}: {sentence}");
    }
    if let Some((before, _)) = words.split_once(". At ") {
        words = &words[..before.len() + 1];
    }
    match parameter {
        "c_tll" => tolerance(words, &section),
        "iterations" => iterations(words, &section),
        "status" | "coupling" => nearest(words, &section),
        other => panic!("no sentences are known of {other}"),
    }
}

/// Checks a sentence of `arithmetic` or `solver`.
fn of_numbers(sentence: &str, json: &Value) {
    let section = Section::find(json, None);
    let error = |setting: &str| &section.row(setting)["error"]["displacement"];
    if let Some(said) = parts(
        sentence,
        "Rounding changes displacements by {} of the largest in f32, by {} in f64; {}",
    ) {
        assert_shows(said[0], error("f32"), sentence);
        assert_shows(said[1], error("f64"), sentence);
    } else if let Some(said) =
        parts(sentence, "Exact numbers were left out: they may take {} s here.")
    {
        assert_shows(said[0], &json["exact_seconds"], sentence);
        assert!(section.rows.iter().all(|row| row["setting"] != "exact"));
    } else if let Some(said) = parts(
        sentence,
        "Direct solvers in f64 differ from f64x2 by {} of the largest displacement at most.",
    ) {
        let direct =
            ["dense-lu", "dense-cholesky", "sparse-cholesky"].map(|name| number(error(name)));
        assert_shows(said[0], &direct.into_iter().fold(0.0, f64::max).into(), sentence);
    } else {
        let said =
            parts(sentence, "A residual is no error: {} by {} of the largest.").expect(sentence);
        let loose = section.row("cg to 1e-4");
        assert_shows(
            said[1].trim_start_matches("wrong by "),
            &loose["error"]["displacement"],
            sentence,
        );
    }
}

/// Checks a sentence on meshes.
fn of_meshes(sentence: &str, json: &Value) {
    let section = Section::find(json, None);
    let orders = json["orders"].as_array().expect("orders");
    let list = |words: &str, numbers: &Value| {
        let words: Vec<&str> = words.split(", ").collect();
        assert_eq!(words.len(), numbers.as_array().expect("numbers").len(), "{sentence}");
        words
            .iter()
            .zip(numbers.as_array().unwrap())
            .for_each(|(w, x)| assert_shows(w, x, sentence));
    };
    let order = |quantity: &str| {
        orders
            .iter()
            .find(|order| order["quantity"] == quantity)
            .unwrap_or_else(|| panic!("{sentence}"))
    };
    if let Some(said) = parts(
        sentence,
        "From the finest mesh that ran the scene's own differs by {} of the largest displacement, {} in the energy norm, and in a body's largest von Mises stress by {} of it.",
    ) {
        let error = &section.own()["error"];
        for (text, name) in said.iter().zip(["displacement", "energy", "von_mises"]) {
            assert_shows(text, &error[name], sentence);
        }
    } else if let Some(said) =
        parts(sentence, "The {} shows no order of convergence on these meshes (differences {}).")
    {
        assert!(order(said[0])["order"].is_null(), "{sentence}");
        list(said[1], &order(said[0])["differences"]);
    } else if let Some(said) = parts(
        sentence,
        "The {} converges with order {} (differences from mesh to mesh {}; the differences leave the fitted line by a factor of {} at most); the finest mesh is about {} from the limit, the scene's own {}.",
    ) {
        let order = order(said[0]);
        assert_shows(said[1], &order["order"], sentence);
        list(said[2], &order["differences"]);
        assert_shows(said[3], &order["scatter"], sentence);
        let errors = order["errors"].as_array().expect("errors");
        assert_shows(said[4], errors.last().expect("an error"), sentence);
        assert_shows(said[5], &errors[0], sentence);
    } else if let Some(said) = parts(
        sentence,
        "In the energy norm the squares of the differences add, {}: over three meshes in turn they miss the square of the whole by {} at most.",
    ) {
        assert_shows(said[1], &json["ladder"]["departure"], sentence);
    } else if let Some(said) = parts(
        sentence,
        "What solve estimates of these meshes, each from itself alone: {}. The ladder has {}",
    ) {
        let errors = order("energy norm")["errors"].as_array().expect("errors").iter();
        let estimates = json["ladder"]["estimates"].as_array().expect("estimates").iter();
        let both: Vec<_> =
            estimates.zip(errors).filter(|(estimate, _)| !estimate.is_null()).collect();
        let said: Vec<&str> = said[0].split(", ").collect();
        assert_eq!(said.len(), both.len(), "{sentence}");
        for (said, (estimate, error)) in said.iter().zip(both) {
            let said = parts(said, "{} for {}").expect(sentence);
            assert_shows(said[0], estimate, sentence);
            assert_shows(said[1], error, sentence);
        }
    } else if let Some(said) = parts(
        sentence,
        "The arcs are true on every mesh but the scene's own, {} of radius {} and {} mm, and {}",
    ) {
        assert_shows(said[1], &json["limit"]["radii"][0], sentence);
        assert_shows(said[2], &json["limit"]["radii"][1], sentence);
    } else if let Some(said) = parts(sentence, "By hand ({}): half width {} mm, peak {} MPa, {}.") {
        let forms = json["limit"]["closed_forms"].as_array().expect("closed forms");
        let form = forms.iter().find(|form| form["author"] == said[0]).expect(sentence);
        assert_shows(said[1], &form["half_width"], sentence);
        assert_shows(said[2].trim_start_matches("pressure "), &form["peak_pressure"], sentence);
    } else if let Some(said) = parts(sentence, "The {}; the scene's own mesh gives {}, {} that.") {
        let quantities = json["limit"]["quantities"].as_array().expect("quantities");
        let value = |words: &'_ str| words.split(' ').next().map(String::from).expect("a number");
        let of_this = |q: &&Value| said[0].starts_with(q["quantity"].as_str().expect("a name"));
        let quantity = quantities.iter().find(of_this).expect(sentence);
        match parts(said[0], "{} converges with order {} to {}") {
            Some(said) => {
                assert_shows(said[1], &quantity["order"], sentence);
                assert_shows(&value(said[2]), &quantity["limit"], sentence);
            }
            None => {
                let pattern = "{} differs by {} over the last 3 meshes, and is on the finest {}";
                let said = parts(said[0], pattern).expect(sentence);
                let values = quantity["values"].as_array().expect("values");
                let last: Vec<f64> = values[values.len() - 3..].iter().map(number).collect();
                let [most, least] = [f64::max, f64::min].map(|f| last.iter().copied().reduce(f));
                let spread = (most.expect("three") - least.expect("three")) / last[2];
                assert_shows(said[1], &spread.into(), sentence);
                assert_shows(&value(said[2]), &last[2].into(), sentence);
            }
        }
        assert_shows(&value(said[1]), &quantity["own"], sentence);
        let missed = number(&quantity["missed"]).abs();
        assert_shows(
            &said[2].replace(" above", "").replace(" below", ""),
            &missed.into(),
            sentence,
        );
    } else {
        assert!(!sentence.contains(|c: char| c.is_ascii_digit()), "no table has it: {sentence}");
    }
}

/// Checks a sentence on halves.
fn of_halves(sentence: &str, json: &Value) {
    if let Some(said) =
        parts(sentence, "The mesh is symmetric within {}; half of it has {} of {} equations.")
    {
        let within = said[0].split(' ').next().expect("a number");
        assert_shows(within, &json["asymmetry"], sentence);
        let [half, whole] =
            ["half", "whole"].map(|name| &Section::find(json, None).row(name)["equations"]);
        assert_shows(said[1], half, sentence);
        assert_shows(said[2], whole, sentence);
    } else {
        let pattern = "{}: the half differs from the whole by {} of the largest displacement ({} nodes in \
                       contact, {} in the half).";
        let said = parts(sentence, pattern).expect(sentence);
        let section = Section::find(json, Some(said[0]));
        let [half, whole] = ["half", "whole"].map(|name| section.row(name));
        assert_shows(said[1], &half["error"]["displacement"], sentence);
        assert_shows(said[2], &whole["in_contact"], sentence);
        assert_shows(said[3], &half["in_contact"], sentence);
    }
}

/// Checks every sentence of `trade` on a request; returns how many there are.
fn check_trade(request: &Request, only: &[Varied]) -> usize {
    let options = Options { runs: 1, only: only.to_vec(), finest: 0.1 };
    let trade = measure(request, &options, |_| None, |_| ()).expect("it is measured");
    let json: Value = serde_json::from_str(&report::json(&request.scene, &trade)).expect("JSON");
    let mut count = 0;
    for section in json["sections"].as_array().expect("sections") {
        let parameter = section["parameter"].as_str().expect("a name");
        for sentence in section["answers"].as_array().expect("sentences") {
            let sentence = sentence.as_str().expect("a text");
            count += 1;
            match parameter {
                _ if section["rows"].as_array().expect("rows").is_empty() => {
                    assert!(!sentence.contains(|c: char| c.is_ascii_digit()), "{sentence}");
                }
                "arithmetic" | "solver" => of_numbers(sentence, section),
                "mesh" => of_meshes(sentence, section),
                "symmetry" => of_halves(sentence, section),
                _ => of_variant(parameter, sentence, section),
            }
        }
    }
    count
}

fn open(name: &str) -> Scene {
    Scene::open(name).expect("an embedded scene")
}

#[test]
fn sentences_of_trade_are_those_of_its_rows() {
    let parameters: Vec<Varied> =
        Varied::ALL.iter().copied().filter(|parameter| *parameter != Varied::Geometry).collect();
    for scene in ["fig1", "two-blocks"] {
        let count = check_trade(&Request::new(&open(scene)), &parameters);
        assert!(count >= 15, "{scene}: {count}");
    }
    let annulus = Annulus { radial: 4, around: 8 }.generate().and_then(|b| b.build());
    check_trade(&Request::new(&annulus.expect("in range")), &parameters);
    // The own setting at either end of the sweep, and beyond it.
    for (tolerance, iterations) in [(1e-6, 1), (1e-7, 320), (0.1, 400), (0.5, 2)] {
        let mut request = Request::new(&open("fig1"));
        (request.tolerance, request.iterations) = (Some(tolerance), iterations);
        check_trade(&request, &[Varied::Tolerance, Varied::Iterations]);
    }
}

/// The paper's example, where the smallest c_tll is not the one that moves most; and a coarser one.
#[test]
fn sentences_of_trade_on_the_example_are_those_of_its_rows() {
    let parameters =
        [Varied::Tolerance, Varied::Iterations, Varied::Status, Varied::Coupling, Varied::Symmetry];
    assert!(check_trade(&Request::new(&open("strand")), &parameters[..1]) == 2);
    assert!(check_trade(&Request::new(&open("strand")), &[Varied::Mesh]) == 10);
    let coarse = Strand { size: 0.9, ..Strand::default() }.generate().and_then(|b| b.build());
    check_trade(&Request::new(&coarse.expect("in range")), &parameters);
}

fn printed(folder: &Path, args: &[&str]) -> String {
    String::from_utf8(run(folder, args).stdout).expect("UTF-8")
}

fn json_of(folder: &Path, args: &[&str]) -> Value {
    serde_json::from_str(&printed(folder, &[args, &["--json"]].concat())).expect("JSON")
}

/// The rows of a table that a command wrote to the folder `csv`, as cells.
fn cells(folder: &Path, name: &str) -> Vec<Vec<String>> {
    rows(&std::fs::read_to_string(folder.join(format!("csv/{name}.csv"))).expect(name))
}

/// The rows of a table in CSV, as cells.
fn rows(csv: &str) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    for line in csv.lines().skip(1) {
        let (mut row, mut cell, mut quoted) = (Vec::new(), String::new(), false);
        for c in line.chars() {
            match c {
                '"' => quoted = !quoted,
                ',' if !quoted => row.push(std::mem::take(&mut cell)),
                c => cell.push(c),
            }
        }
        row.push(cell);
        rows.push(row);
    }
    rows
}

fn largest(json: &Value) -> f64 {
    json.as_array().expect("numbers").iter().map(number).fold(0.0, f64::max)
}

/// The largest stresses of bodies in a sentence: `block 45.5, stamp 40.8`.
fn assert_stresses(words: &str, bodies: &Value, sentence: &str) {
    let bodies = bodies.as_array().expect("bodies");
    let words: Vec<&str> = words.split(", ").collect();
    assert_eq!(words.len(), bodies.len(), "{sentence}");
    for (words, body) in words.iter().zip(bodies) {
        let (name, stress) = words.rsplit_once(' ').expect(sentence);
        assert_eq!(name, body["name"], "{sentence}");
        assert_shows(stress, &body["max_von_mises_stress"], sentence);
    }
}

#[test]
fn sentences_and_tables_of_audit_are_those_of_its_json() {
    let folder = TempDir::new().expect("a folder");
    for scene in ["fig1", "two-blocks"] {
        let args = ["audit", scene];
        let text = printed(folder.path(), &[&args[..], &["--csv", "csv"]].concat());
        let json = json_of(folder.path(), &args);
        for (what, key) in [
            ("  error: against the equilibrium under the scene's own friction", "equilibrium"),
            ("  the reference solution", "reference"),
        ] {
            let line = text.lines().find(|line| line.starts_with(&format!("{what} (")));
            let line = line.unwrap_or_else(|| panic!("{scene}: {what}"));
            let rest = line.strip_prefix(what).expect("it starts so");
            let said =
                parts(rest, " ({}): {} in contact, largest von Mises stress {}").expect(line);
            assert_shows(said[1], &json[key]["in_contact"], line);
            assert_stresses(said[2], &json[key]["bodies"], line);
        }
        for row in cells(folder.path(), "3-variants-side-by-side") {
            let of = json["variants"].as_array().expect("variants").iter();
            let of = of.clone().find(|of| of["variant"] == row[0]).expect("a variant");
            let line = row.join(" | ");
            assert_shows(&row[1], of["in_contact"].as_array().unwrap().last().unwrap(), &line);
            assert_shows(&row[3], &of["target_share"], &line);
            assert_shows(&row[4], &of["eq1_residual"], &line);
            assert_stresses(&row[5], &of["bodies"], &line);
            assert_shows(&row[6], &of["distance"]["displacement_relative"], &line);
            assert_shows(&row[7], &of["distance"]["energy_relative"], &line);
            assert_shows(&row[8], &of["friction_needed"], &line);
            assert_eq!(row[9], of["pulling"].as_array().unwrap().len().to_string(), "{line}");
        }
        for row in cells(folder.path(), "2-findings") {
            let of = json["findings"].as_array().expect("findings").iter();
            let of = of.clone().find(|of| of["id"] == row[0]).expect("a finding");
            assert_shows(&row[3], &of["number"], &row.join(" | "));
            assert_eq!(
                (row[2].as_str(), row[4].as_str()),
                (of["verdict"].as_str().unwrap(), of["of"].as_str().unwrap())
            );
        }
        for row in cells(folder.path(), "claims-of-the-paper") {
            let of = json["claims"].as_array().expect("claims").iter();
            let of = of.clone().find(|of| of["id"] == row[0]).expect("a claim");
            assert_shows(&row[5], &of["number"], &row.join(" | "));
        }
    }
}

/// The tables of `compare`, of two runs of our own: CalculiX need not be installed.
#[test]
fn tables_of_compare_are_those_of_its_json() {
    let scene = open("fig1");
    let solved =
        |variant| solve(&Request::new(&scene).variant(variant), &mut |_| ()).expect("it runs");
    let [ours, theirs] = [Variant::Tied, Variant::Unilateral].map(solved);
    let contact = Contact::Pair(Pair::new(&scene.model, None, Friction::STICK));
    let comparison =
        Comparison::new(&scene.model, Fields::from_solution(&ours), Fields::from_solution(&theirs));
    let compared = comparison::Compared {
        scene: &scene,
        model: &scene.model,
        variant: Variant::Tied,
        certainty: Certainty::Certain,
        contact: &contact,
        decks: 1,
        version: "2.20",
        comparison: &comparison,
    };
    let report = comparison::report(&compared);
    let text = report.text(usize::MAX);
    let json: Value = serde_json::from_str(&comparison::json(&compared)).expect("JSON");
    let penalty = text.lines().find_map(|line| line.strip_prefix("contact pair, penalty "));
    assert_shows(
        penalty.expect("it is said").split(' ').next().unwrap(),
        &json["contact"]["penalty"],
        &text,
    );
    let all: Vec<_> = report.csv().iter().map(|(_, csv)| rows(csv)).collect();
    for (row, of) in all[0].iter().zip(["displacement", "stress"]) {
        let largest = &json[of]["largest"];
        assert_shows(&row[1], &largest["difference"], &row.join(" | "));
        assert_shows(&row[2], &largest["relative"], &row.join(" | "));
        assert_shows(&row[3], &largest["scale"], &row.join(" | "));
        assert_shows(&row[6], &json[of]["rms"], &row.join(" | "));
        let place = row[4].rsplit(' ').next().unwrap();
        assert_eq!(place, largest["at"].to_string());
        let rows =
            json[if of == "stress" { "elements" } else { "nodes" }].as_array().expect("rows");
        let most = rows.iter().map(|row| number(&row["difference"])).fold(0.0, f64::max);
        assert_eq!(most, number(&largest["difference"]), "{of}");
    }
    for (row, body) in all[1].iter().zip(json["bodies"].as_array().expect("bodies")) {
        let [ours, theirs] = ["ours", "calculix"].map(|name| number(&body[name]));
        assert_shows(&row[1], &body["ours"], &row.join(" | "));
        assert_shows(&row[2], &body["calculix"], &row.join(" | "));
        assert_shows(&row[3], &((ours - theirs) / theirs).into(), &row.join(" | "));
    }
}

/// Where a method breaks down is where the sweep's own row first has fewer digits.
#[test]
fn the_summary_of_extremes_is_that_of_its_sweep() {
    let folder = TempDir::new().expect("a folder");
    let args = ["extremes", "offset"];
    printed(folder.path(), &[&args[..], &["--out", "o", "--csv", "csv"]].concat());
    let json = json_of(folder.path(), &args);
    let of = &json["rows"][0];
    let columns = of["columns"].as_array().expect("columns");
    let printed = cells(folder.path(), "limits-of-offset");
    assert_eq!(printed.len(), columns.len());
    for (row, column) in printed.iter().zip(columns) {
        assert_eq!(row[0], column["name"]);
        let carried = number(&column["carried"]);
        let digits = |verdict: &Value| match verdict["verdict"].as_str() {
            Some("exact") => carried,
            Some("digits") => number(&verdict["detail"]).min(carried),
            _ => 0.0,
        };
        let verdicts = column["verdicts"].as_array().expect("verdicts");
        let most = verdicts.iter().map(digits).fold(0.0, f64::max).floor();
        assert_eq!(row[1].parse(), Ok(most), "{row:?}");
        for (cell, side) in [(&row[2], "below"), (&row[4], "above")] {
            match &column[side] {
                Value::Null => assert_eq!(cell, ""),
                found => assert_eq!(*cell, format!("1e{:.0}", number(&found["exponent"]).round())),
            }
        }
        // Every magnitude on the way to the place keeps its digits; the first beyond it does not.
        let magnitudes = of["magnitudes"].as_array().expect("magnitudes").iter().map(number);
        for (magnitude, verdict) in magnitudes.zip(verdicts) {
            let exponent = magnitude.log10();
            let beyond = |side: &str| column[side]["exponent"].as_f64();
            let sound = beyond("below").is_none_or(|at| exponent > at)
                && beyond("above").is_none_or(|at| exponent < at);
            assert!(
                !sound || digits(verdict) >= 3.0 || verdict["verdict"] == "unknown",
                "{row:?} at {magnitude}"
            );
        }
    }
}

/// The sentences of `solve` have the numbers of `result.json`.
#[test]
fn sentences_of_solve_are_those_of_its_result() {
    let folder = TempDir::new().expect("a folder");
    for (scene, variant, options) in [
        ("fig1", "printed", ""),
        ("fig1", "tied", ""),
        ("fig1", "stepped", ""),
        ("fig1", "unilateral", ""),
        ("two-blocks", "unilateral", "--friction 0.3"),
        ("two-blocks", "unilateral", "--friction 0 --geometry initial"),
    ] {
        let mut args = vec!["solve", scene, "--variant", variant, "--no-pictures", "--out", "o"];
        args.extend(["--csv", "csv"]);
        args.extend(options.split_whitespace());
        let text = printed(folder.path(), &args);
        let result = std::fs::read_to_string(folder.path().join("o/result.json")).expect("a file");
        let result: Value = serde_json::from_str(&result).expect("JSON");
        let line = |start: &str| text.lines().find_map(|line| line.trim().strip_prefix(start));
        let last = result["iterations"].as_array().expect("iterations").last().expect("one");
        let dy = last["dy"].as_array().expect("numbers").iter().filter(|dy| **dy == 1).count();
        let named = line("In contact at the end: ").expect("it is said");
        let count = if named == "no node" { 0 } else { named.split(", ").count() };
        assert_eq!(
            (count, last["in_contact"].as_u64()),
            (dy, Some(dy as u64)),
            "{scene} {variant}"
        );
        let bodies = cells(folder.path(), "bodies");
        for (row, body) in bodies.iter().zip(result["bodies"].as_array().expect("bodies")) {
            assert_shows(&row[3], &body["max_displacement"], &row.join(" | "));
            assert_shows(&row[4], &body["max_von_mises_stress"], &row.join(" | "));
            assert_shows(&row[8], &body["max_von_mises_strain"], &row.join(" | "));
        }
        let surface = result["contact"].as_array().expect("nodes").iter();
        let surface: Vec<&Value> = surface.filter(|node| node["dy"] == 1).collect();
        if !surface.is_empty() {
            for (row, node) in cells(folder.path(), "contact-surface").iter().zip(surface) {
                let names = ["arc", "gap", "force", "pressure", "shear", "friction_needed"];
                for (cell, name) in row[1..7].iter().zip(names) {
                    assert_shows(cell, &node[name], &format!("{name}: {}", row.join(" | ")));
                }
            }
        }
        let equilibrium = &result["equilibrium"];
        if let Some(said) =
            line("Geometry: its last update changed no displacement component by more than ")
        {
            assert_shows(said.split(' ').next().unwrap(), &equilibrium["shape_change"], said);
        }
        if let Some(change) = text.lines().find_map(|line| {
            line.split_once("Half as many steps change a displacement component by at most ")
        }) {
            let said = parts(change.1, "{} = {} of the largest |u|").expect(change.1);
            assert_shows(said[0].split(' ').next().unwrap(), &result["path_change"], change.1);
            let moved = largest(&Value::from(
                result["bodies"]
                    .as_array()
                    .unwrap()
                    .iter()
                    .map(|b| b["max_displacement"].clone())
                    .collect::<Vec<_>>(),
            ));
            assert_shows(said[1], &(number(&result["path_change"]) / moved).into(), change.1);
        }
        for (what, key) in [
            ("reference solution", "distance"),
            (
                "equilibrium under the scene's own friction and geometry",
                "distance_from_equilibrium",
            ),
        ] {
            let Some(at) = text.find(&format!("Distance from the {what} ")) else { continue };
            let text = &text[at..];
            let distance = &result[key];
            let said = |what: &str| {
                let line = text.lines().find(|line| line.trim().starts_with(what)).expect(what);
                line.split_once(": ").expect("a number").1
            };
            let moved = said("largest difference of a displacement");
            let (length, share) = moved.split_once(" = ").expect("a length and a share");
            assert_shows(length, &distance["displacement"], moved);
            assert_shows(share, &distance["displacement_relative"], moved);
            let energy = said("energy norm of the difference");
            assert_shows(energy, &distance["energy_relative"], energy);
            let table = what.replace([' ', '\''], "-");
            let rows = cells(folder.path(), &format!("distance-from-the-{table}"));
            for (row, body) in rows.iter().zip(distance["bodies"].as_array().expect("bodies")) {
                assert_shows(&row[1], &body["von_mises_stress"], &row.join(" | "));
                assert_shows(&row[2], &body["reference"], &row.join(" | "));
                assert_shows(&row[3], &body["relative"], &row.join(" | "));
            }
        }
    }
}
