//! What a worksheet's regions say, in the elements of its file: the worksheets beside this file, with what becomes of
//! each region; and how deep, long and nested they may be.

use std::fmt::Write;

use fastrand::Rng;
use mathcad::worksheet::{Agreement, ExecutedRegion, execute};
use mathcad::xmcd::document::{self, Content};
use mathcad::xmcd::write;
use mathcad::{Limits, Listing, Value};
use testing::golden_file::assert_text;

/// A line for each region: its id and text, its value, how it agrees with what Mathcad saved, and the regions whose saved
/// values went into it.
fn rows(sheet: &document::Worksheet) -> String {
    let mut rows = String::new();
    for ExecutedRegion { id, text, agreement, inputs, value, .. } in
        execute(sheet, &Limits::default())
    {
        let value = value.map(|value| format!(" = {value}")).unwrap_or_default();
        let inputs = inputs.into_iter().fold(String::new(), |all, id| all + " from " + &id);
        let text = text.trim_end().replace('\n', "\n   ");
        writeln!(rows, "{id}: {text} |{value} | {agreement:?}{inputs}").expect("room");
    }
    rows
}

#[test]
fn worksheets() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/worksheets");
    let entries = std::fs::read_dir(folder).expect("worksheets");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    let mut all = String::new();
    for path in paths {
        let text = std::fs::read_to_string(&path).expect("a worksheet");
        let name = path.file_stem().expect("a name").to_string_lossy();
        let sheet = document::read(&text, &name).expect("a worksheet");
        writeln!(all, "{name}\n{}", rows(&sheet)).expect("room");
    }
    assert_text("tests/worksheets.snap", &all, |golden, is| golden == is);
}

fn worksheet(regions: &str) -> document::Worksheet {
    let text = format!("<worksheet><regions>{regions}</regions></worksheet>");
    document::read(&text, "sheet").unwrap()
}

/// Executes evaluations of these elements.
fn evaluated(expressions: &[String]) -> Vec<ExecutedRegion> {
    let region = |inside: &String| format!("<region><math><eval>{inside}</eval></math></region>");
    let regions: String = expressions.iter().map(region).collect();
    execute(&worksheet(&regions), &Limits::default())
}

fn apply(operator: &str, operands: &[&str]) -> String {
    format!("<apply><{operator}/>{}</apply>", operands.concat())
}

fn real(x: f64) -> String {
    format!("<real>{x}</real>")
}

/// Areas within areas are looked into, but not without end.
#[test]
fn areas_are_entered_thirty_deep() {
    let nested = |depth: usize| {
        let math = format!("<region><math><eval>{}</eval></math></region>", real(1.0));
        let [open, close] = ["<region><area>", "</area></region>"].map(|tag| tag.repeat(depth));
        worksheet(&format!("{open}{math}{close}")).regions
    };
    assert!(matches!(nested(30)[..], [document::Region { content: Content::Evaluation(_), .. }]));
    assert!(matches!(nested(31)[..], [document::Region { content: Content::Silent, .. }]));
}

/// The elements of a region stand at most 299 deep, the text of the innermost included.
#[test]
fn regions_are_read_three_hundred_deep() {
    let deep = |parens: usize| {
        let [open, close] = ["<parens>", "</parens>"].map(|tag| tag.repeat(parens));
        match &evaluated(&[format!("{open}{}{close}", real(1.0))])[0].agreement {
            Agreement::Unsupported { construct: words } => words.clone(),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(deep(296), "its size or form: found brackets more than 64 deep");
    assert_eq!(deep(297), "an expression nested too deeply");
    assert_eq!(deep(2_000), "an expression nested too deeply");
}

#[test]
fn files_are_read_up_to_their_largest_size() {
    let [open, close] = ["<worksheet>", "</worksheet>"];
    let mut text = open.to_owned() + &" ".repeat(document::LARGEST - open.len() - close.len());
    text += close;
    assert_eq!(document::read(&text, "sheet").unwrap().regions.len(), 0);
    text += " ";
    assert!(document::read(&text, "sheet").is_err());
}

/// The document, its root, and 2^23 times an element and a text: two nodes beyond 2^24.
#[test]
fn files_of_too_many_nodes_are_refused() {
    let text = format!("<worksheet>{}</worksheet>", "<a/> ".repeat(1 << 23));
    let why = document::read(&text, "sheet").unwrap_err().to_string();
    assert!(why.contains("the file has too many elements"), "{why}");
}

/// In the worksheet parentheses stand only where Mathcad shows them: not in a fraction or an
/// exponent, but round what a transpose or a subscript stands behind.
#[test]
fn parentheses_are_written_as_mathcad_shows_them() {
    for (text, parentheses) in [
        ("(¬a) / 2", 0),
        ("(a < b) / 2", 0),
        ("(a + b) / (a·b)", 0),
        ("(−a) / (−b)", 2),
        ("a^(−b)", 1),
        ("a^(−b^2)", 0),
        ("a^(b^2)", 0),
        ("a^(b[1])", 1),
        ("a^(bᵀ)", 1),
        ("a[1]ᵀ", 1),
        ("aᵀ", 0),
        ("aᵀ[1,2]", 1),
        ("a⟨1⟩[2]", 1),
        ("a[1][2]", 1),
        ("a[1]⟨2⟩", 1),
        ("(a)[1]", 1),
        ("(1 2)ᵀ", 0),
    ] {
        let listing = Listing::parse("f", &format!("_() :=\n  {text}\n")).unwrap();
        let written = write::expression(&listing).document();
        assert_eq!(written.matches("<ml:parens>").count(), parentheses, "{text}: {written}");
    }
}

/// A random expression of numbers without parentheses, and what it comes to, if anything.
fn tree(rng: &mut Rng, depth: usize) -> (String, Option<f64>) {
    let Some(depth) = depth.checked_sub(1) else {
        let x = [-2.0, -1.0, 0.0, 0.5, 1.0, 2.0, 3.0][rng.usize(..7)];
        return (real(x), Some(x));
    };
    let below = rng.usize(..=depth);
    let [(a, x), (b, y)] = [tree(rng, depth), tree(rng, below)];
    let finite = |x: f64| Some(x).filter(|x| x.is_finite());
    let truth = |truth: bool| if truth { 1.0 } else { 0.0 };
    let both = |f: fn(f64, f64) -> f64| x.zip(y).and_then(|(x, y)| finite(f(x, y)));
    let [any, all] = [[x, y].map(|x| x.is_some_and(|x| x != 0.0)), [x, y].map(|x| x == Some(0.0))];
    let (operator, value) = match rng.u8(..12) {
        0 => ("plus", both(|x, y| x + y)),
        1 => ("minus", both(|x, y| x - y)),
        2 => ("mult", both(|x, y| x * y)),
        3 => ("div", both(|x, y| x / y)),
        4 => ("pow", both(f64::powf)),
        // One operand may decide though the other fails.
        5 if any.contains(&true) => ("or", Some(1.0)),
        5 => ("or", both(|_, _| 0.0)),
        6 if all.contains(&true) => ("and", Some(0.0)),
        6 => ("and", both(|_, _| 1.0)),
        7 => ("lessThan", both(|x, y| if x < y { 1.0 } else { 0.0 })),
        8 => ("equal", both(|x, y| if x == y { 1.0 } else { 0.0 })),
        9 => return (apply("not", &[&a]), x.map(|x| truth(x == 0.0))),
        10 => return (apply("absval", &[&a]), x.map(f64::abs)),
        _ => return (apply("neg", &[&a]), x.map(|x| -x)),
    };
    // A comparison on the left of another would be a chain.
    let is_chain = ["lessThan", "equal"].contains(&operator)
        && ["<apply><lessThan/>", "<apply><equal/>"].iter().any(|head| a.starts_with(head));
    let a = if is_chain { format!("<parens>{a}</parens>") } else { a };
    (apply(operator, &[&a, &b]), value)
}

/// The elements say what is an operand of what; the text gets the parentheses that it needs.
#[test]
fn operators_within_operators_need_no_parentheses() {
    let mut rng = Rng::with_seed(7);
    let (trees, values): (Vec<_>, Vec<_>) = (0..600).map(|k| tree(&mut rng, 1 + k % 5)).unzip();
    let checked = evaluated(&trees);
    assert!(values.iter().filter(|value| value.is_some()).count() > 300);
    for ((checked, value), tree) in checked.iter().zip(values).zip(trees) {
        let found = checked.value.as_ref().and_then(Value::number);
        assert_eq!(found, value, "{} {tree}: {:?}", checked.text, checked.agreement);
    }
}
