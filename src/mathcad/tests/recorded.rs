//! Random programs: what they come to, recorded, and that they come back from a worksheet.

use std::fmt::Write;

use fastrand::Rng;
use mathcad::failure::Fallible;
use mathcad::xmcd::document;
use mathcad::xmcd::document::{Content, Region};
use mathcad::{Array, Ended, Limits, Listing, Settings, Sheet, Value, json};

use super::{one_of, worksheet};

/// The number of programs that are recorded.
const PROGRAMS: u64 = 50;

const FUNCTIONS: [&str; 21] = [
    "sin", "cos", "tan", "cot", "sec", "csc", "asin", "acos", "atan", "sinh", "cosh", "tanh",
    "asinh", "acosh", "atanh", "exp", "ln", "floor", "ceil", "trunc", "√",
];

const SETTINGS: [&str; 8] = [
    "",
    "",
    "",
    "origin=0",
    "zero-over-zero=0,exact-boolean=false",
    "conjunction=eager,tiny=0",
    "conjunction=left-to-right,last-if=0",
    "descending=empty,origin=0",
];

/// An expression of a kind, but seldom of another.
fn any(rng: &mut Rng, depth: usize, usual: fn(&mut Rng, usize) -> String) -> String {
    let kinds = [number, column, matrix];
    let kind = if rng.u8(..30) == 0 { one_of(rng, &kinds) } else { usual };
    kind(rng, depth)
}

fn number(rng: &mut Rng, depth: usize) -> String {
    let Some(depth) = depth.checked_sub(1) else {
        let atoms = "0~1~2~3~0.5~1.75~10~1E-3~x~n~a~(−2)~v[2]~v[n − 1]~m[1,2]~m[n − 2,1]~s";
        let atoms: Vec<&str> = atoms.split('~').collect();
        return one_of(rng, &atoms).into();
    };
    let mut of = |kind: fn(&mut Rng, usize) -> String| any(rng, depth, kind);
    let (p, q, r, v, m) = (of(number), of(number), of(number), of(column), of(matrix));
    match rng.u8(..34) {
        0..4 => format!("{p} + {q}"),
        4..8 => format!("({p} − {q})·{r}"),
        8..11 => format!("{p}·({q})"),
        11..14 => format!("({p}) / ({q})"),
        14 => format!("−({p})"),
        15 => format!("|{p}| + |{v}|"),
        16 => format!("|{m}|"),
        17 => format!("({p})^{}", one_of(rng, &["2", "3", "(−1)", "0.5", "n"])),
        18 => format!("√({},{p})", one_of(rng, &["2", "3", "n"])),
        19 => {
            format!("({} {p} ∧ {q} {} {r})", p.clone() + " <", one_of(rng, &["=", "≤", "≠", ">"]))
        }
        20 => format!("({p} ≥ {q} ∨ ¬({r} = 0))"),
        21 => format!("({v})[{}]", one_of(rng, &["1", "2", "n", "0"])),
        22 => format!("({m})[{},1]", one_of(rng, &["1", "2", "x"])),
        23 => format!("{}({p}, {q})", one_of(rng, &["min", "max", "mod", "log"])),
        24 => format!("{}({v}, {m})", one_of(rng, &["min", "max"])),
        25 => format!("{}({m})", one_of(rng, &["rows", "cols", "length", "determinant"])),
        26 => format!("{}({v})", one_of(rng, &["rows", "cols", "length", "∑"])),
        27 => format!("∑(i ∈ {} .. 3, {p}·i)", one_of(rng, &["1", "2", "n", "4"])),
        28 => format!("∏(i ∈ 1 .. {}, i + {p})", one_of(rng, &["1", "2", "n"])),
        29 => format!("({v})·({})", v.clone()),
        30 => format!("factorial({})", one_of(rng, &["0", "n", "5", "x"])),
        _ => format!("{}({p})", one_of(rng, &FUNCTIONS)),
    }
}

fn column(rng: &mut Rng, depth: usize) -> String {
    let Some(depth) = depth.checked_sub(1) else {
        return one_of(rng, &["v", "w", "(1 2 3)ᵀ", "(4; x; n)", "g(x)"]).into();
    };
    let mut of = |kind: fn(&mut Rng, usize) -> String| any(rng, depth, kind);
    let (p, q, v, m) = (of(number), of(number), of(column), of(matrix));
    match rng.u8(..12) {
        0 | 1 => format!("({v} + {})", one_of(rng, &["v", "w", "1"])),
        2 => format!("({v})·({p})"),
        3 => format!("(({p})   ({q})   x)ᵀ"),
        4 => format!("({p}; {q}; n)"),
        5 => format!("(({v})ᵀ)ᵀ"),
        6 => format!("({m})⟨{}⟩", one_of(rng, &["1", "2", "3"])),
        7 => format!("stack({}, {v})", one_of(rng, &["v", "m", "w"])),
        8 => format!("submatrix({v}, {}, 2, 1, 1)", one_of(rng, &["1", "2"])),
        9 => format!("{}({v})", one_of(rng, &FUNCTIONS)),
        10 => format!("lsolve({m}, (1; {p}))"),
        _ => format!("({m})·(1; {p})"),
    }
}

fn matrix(rng: &mut Rng, depth: usize) -> String {
    let Some(depth) = depth.checked_sub(1) else {
        return one_of(rng, &["m", "(1 2; 3 5)", "(x   0; n   1)", "identity(2)", "b"]).into();
    };
    let mut of = |kind: fn(&mut Rng, usize) -> String| any(rng, depth, kind);
    let (p, q, v, m) = (of(number), of(number), of(column), of(matrix));
    match rng.u8(..11) {
        0 | 1 => format!("({m} − {})", one_of(rng, &["m", "identity(2)", "b"])),
        2 => format!("({m})·({})", one_of(rng, &["m", "b", "2"])),
        3 => format!("({m})ᵀ"),
        4 => format!("({m})^(−1)"),
        5 => format!("(({p})   ({q}); 1   n)"),
        6 => format!("augment({v}, {})", one_of(rng, &["v", "w", "m"])),
        7 => format!("submatrix({m}, 1, {}, 1, 2)", one_of(rng, &["1", "2", "3"])),
        8 => format!("identity({})·({p})", one_of(rng, &["1", "2", "3"])),
        9 => format!("stack({m}, {})", one_of(rng, &["m", "b"])),
        _ => format!("({v})·({v})ᵀ"),
    }
}

/// Writes statements at a level of blocks.
fn statements(rng: &mut Rng, level: usize, text: &mut String) {
    let indent = "  ".repeat(level + 1);
    for _ in 0..rng.usize(1..4) {
        let (p, q) = (any(rng, 2, number), any(rng, 1, number));
        let guard = if rng.u8(..3) == 0 { format!(" if {q} > 1") } else { String::new() };
        let k = one_of(rng, &["1", "2", "n", "4"]);
        let (head, has_block) = match rng.u8(..if level < 2 { 19 } else { 13 }) {
            0 | 1 => (format!("a ← {p}{guard}"), false),
            2 => (format!("s ← s + {p}{guard}"), false),
            3 => (format!("w ← {}", any(rng, 2, column)), false),
            4 => (format!("b ← {}", any(rng, 2, matrix)), false),
            5 => (format!("w[{k}] ← {p}{guard}"), false),
            6 => (format!("b[{k},2] ← {p}"), false),
            7 => (format!("c[{k}] ← {}", one_of(rng, &["v", "m", "\"text\"", "s", "w"])), false),
            8 => (p, false),
            9 => (format!("trace({p}, \"and\", {})", any(rng, 1, column)), false),
            10 => (format!("return {p} if {q} > 2"), false),
            11 => {
                (one_of(rng, &["break if a > 3", "continue if s > 5", "c[1]", "c"]).into(), false)
            }
            12 => (format!("v[{k}] ← {p}{guard}"), false),
            13 => {
                (format!("for i ∈ {} .. {k}{guard}", one_of(rng, &["1", "2", "3", "1, 3"])), true)
            }
            14 => (format!("for e ∈ {}", any(rng, 1, column)), true),
            15 => (format!("while a < {}", one_of(rng, &["3", "5"])), true),
            16 | 17 => (format!("if {p} > {q}"), true),
            _ => ("try".into(), true),
        };
        writeln!(text, "{indent}{head}").expect("a text has room");
        if has_block {
            statements(rng, level + 1, text);
        }
        let other = match &head {
            head if head.starts_with("if") && rng.bool() => "otherwise",
            head if head == "try" => "on error",
            _ => continue,
        };
        writeln!(text, "{indent}{other}").expect("a text has room");
        statements(rng, level + 1, text);
    }
}

/// What stands above a program: names and their values.
fn above() -> [(&'static str, Array); 4] {
    [
        ("v", Array::column(vec![1.0, 2.5, -3.0])),
        ("w", Array::column(vec![2.0, 0.25, 4.0])),
        ("m", Array::from_rows(2, vec![4.0, 1.0, 1.5, 3.0])),
        ("b", Array::from_rows(2, vec![0.0, -1.0, 2.0, 1.0])),
    ]
}

/// And a function.
const G: &str = "g(x) :=\n  trace(x)\n  (x   2   0)ᵀ\n";

fn limits() -> Limits {
    Limits { steps: 3_000, entries: 3_000, ..Limits::default() }
}

/// Executes a program.
fn executed(listing: &Listing, settings: &Settings) -> Fallible<Ended> {
    let mut sheet = Sheet::default();
    for (name, value) in above() {
        sheet.define(name, value);
    }
    sheet.define("a", Value::Number(1.0));
    sheet.define("s", Value::Number(0.0));
    sheet.define_program(Listing::parse("g", G).expect("a listing").into());
    listing.runner_in(&sheet, settings, &limits()).call(&[2.0.into(), 3.0.into()])
}

/// Returns the value of a program, its trace and last values, or its failure.
fn in_words(outcome: &Fallible<Ended>) -> String {
    match outcome {
        Ok(outcome) => {
            let written = |value| serde_json::to_string(&json::Written(value)).expect("JSON");
            let last = |(name, value)| format!(" {name} = {}", written(value));
            let locals: String = outcome.locals.iter().map(last).collect();
            let trace = outcome.trace_output.join(" | ");
            format!("= {}  [{trace}] {locals}", written(&outcome.value))
        }
        Err(failure) => format!("! {failure}"),
    }
}

/// Returns what a random program comes to.
fn program(rng: &mut Rng) -> String {
    let mut text = "f(x,n) :=\n".to_owned();
    statements(rng, 0, &mut text);
    let asked = one_of(rng, &SETTINGS);
    let settings: Settings = asked.parse().expect("settings");
    let result = match Listing::parse("f", &text) {
        Ok(listing) => in_words(&executed(&listing, &settings)),
        Err(error) => format!("no listing: {error}"),
    };
    format!("{asked} {text}{result}\n\n")
}

/// Writes listings into a worksheet and reads them back.
fn back(listings: &[Listing]) -> Vec<Listing> {
    let sheet = document::read(&worksheet(listings), "sheet").expect("a worksheet");
    let limits = Limits { characters: 1 << 20, ..Limits::default() };
    let read = |region: &Region| {
        let text = match &region.content {
            Content::Function { text, .. } => text.clone(),
            Content::Definition { name, lines, .. } => {
                format!("{name}() :=\n  {}\n", lines.join("\n  "))
            }
            other => panic!("{other:?}"),
        };
        Listing::parse_within("f", &text, &limits).expect("a listing")
    };
    sheet.regions.iter().map(read).collect()
}

/// Random functions, those of one line and those without parameters among them, come back from a
/// worksheet: none is lost, and the worksheet that they make is the same again.
#[test]
fn listings_come_back_from_worksheets() {
    let mut rng = Rng::with_seed(41);
    let lines = ["b <- \"x\"", "x if n > 1", "1 < x < n ≤ 3", "if(x < 1, v, (1 2; 3 4))", "g()"];
    let mut listings = Vec::new();
    for k in 0..600 {
        let name = format!("f{k}{}", one_of(&mut rng, &["()", "(x)", "(x, n)"]));
        let text = match rng.u8(..3) {
            0 => format!("{name} := {}", any(&mut rng, 2, number)),
            1 => format!("{name} :=\n  {}\n", one_of(&mut rng, &lines)),
            _ => {
                let mut text = format!("{name} :=\n");
                statements(&mut rng, 0, &mut text);
                text
            }
        };
        listings.extend(Listing::parse("f", &text));
    }
    assert!(listings.len() > 400);
    let again = back(&listings);
    let names = |all: &[Listing]| all.iter().map(|l| l.function().to_owned()).collect::<Vec<_>>();
    assert_eq!(names(&again), names(&listings));
    for (one, other) in listings.iter().zip(&again) {
        let written = [one, other].map(|listing| worksheet(std::slice::from_ref(listing)));
        let [one_math, other_math] = written.map(|text| math(&text));
        assert_eq!(one_math, other_math, "{one}{other}");
    }
}

/// The elements of a worksheet's regions, without where they stand on the page.
fn math(worksheet: &str) -> String {
    worksheet.split("<math ").skip(1).filter_map(|part| part.split("</math>").next()).collect()
}

/// Values, traces and failures, to the last bit.
#[test]
fn programs_come_to_what_is_recorded() {
    let programs: String = (0..PROGRAMS).map(|k| program(&mut Rng::with_seed(k))).collect();
    let mut settings = insta::Settings::new();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/tests"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("programs", programs));
}
