//! Hostile listings end in errors: no hang, no overflowing stack, no exhausted memory.

use super::{failure, one_of, program};
use fastrand::Rng;
use mathcad::{Array, Cause, Limits, Listing, Settings, Sheet, Value};

fn refusal(body: &str) -> String {
    Listing::parse("f", &format!("f(x) :=\n{body}"))
        .err()
        .map_or_else(|| panic!("was read"), |error| error.message)
}

#[test]
fn deep_brackets() {
    for (open, close) in
        [("(", ")"), ("|", "|"), ("v[", "]"), ("max(", ")"), ("1 + (", ")"), ("−(", ")")]
    {
        let deep = |n: usize| format!("  {}1{}", open.repeat(n), close.repeat(n));
        let limits = Limits { characters: usize::MAX, ..Limits::default() };
        let text = format!("f(x) :=\n{}", deep(100_000));
        assert!(Listing::parse_within("f", &text, &limits).is_err(), "{open}");
        assert!(Listing::parse("f", &text).is_err(), "{open}");
        assert!(Listing::parse("f", &format!("f(x) :=\n{}", deep(31))).is_ok(), "{open}");
    }
}

#[test]
fn long_chains() {
    for link in ["1 + ", "−", "1·", "1 < ", "1 ∧ ", "x[1] ", "(", "|"] {
        let text = format!("f(x) :=\n  {}1", link.repeat(100_000));
        assert!(Listing::parse("f", &text).is_err(), "{link}");
    }
    assert_eq!(
        refusal(&format!("  {}1", "1 + ".repeat(400))),
        "found operators and brackets more than 64 deep"
    );
    assert_eq!(
        refusal(&format!("  1{}", "ᵀ".repeat(1_000))),
        "found operators and brackets more than 64 deep"
    );
    assert_eq!(
        refusal(&format!("  {}", "1".repeat(9_999))),
        "found 9999 characters, expected at most 2000"
    );
}

#[test]
fn deep_blocks() {
    let lines: String = (1..1_000).map(|level| format!("{:1$}if 1\n", "", 2 * level)).collect();
    assert_eq!(refusal(&lines), "found blocks more than 64 deep");
    assert_eq!(refusal(&"  x\n".repeat(5_000)), "found 5001 lines, expected at most 1000");
}

fn limited(body: &str) -> &'static str {
    match failure(body) {
        Cause::Limit { of, .. } => of,
        other => panic!("{other}"),
    }
}

#[test]
fn huge_arrays() {
    let index = "1".to_string() + &"0".repeat(18);
    let held = "numbers held at once";
    assert_eq!(limited(&format!("a[{index}] ← 1")), held);
    assert_eq!(limited(&format!("a[{index},{index}] ← 1")), held);
    assert_eq!(limited(&format!("a[1{}] ← 1", "0".repeat(300))), held);
    assert_eq!(limited("identity(1000000)"), held);
    assert_eq!(limited("a ← identity(8000)\nb ← identity(8000)"), held);
    assert!(matches!(failure(&format!("v[{index}]")), Cause::IndexOutside { .. }));
}

/// Returns why the program fails under the given limits.
fn under(limits: &Limits, body: &str) -> Cause {
    let listing = program(body);
    listing.runner(&Settings::default(), limits).call(&[Value::Number(5.0)]).unwrap_err().cause
}

#[test]
fn endless_loops() {
    let limits = Limits { steps: 100_000, ..Limits::default() };
    let steps = Cause::Limit { limit: 100_000, of: "steps" };
    assert_eq!(under(&limits, &format!("for i ∈ 1 .. 1{}\n  x", "0".repeat(300))), steps);
    assert_eq!(under(&limits, "for i ∈ 1 .. 9999\n  for j ∈ 1 .. 9999\n    a[j] ← i"), steps);
    assert_eq!(
        under(&limits, "for i ∈ 1 .. 9999\n  a[1,i] ← 1"),
        steps,
        "growth that moves the array each time"
    );
    assert_eq!(
        under(&limits, "a ← identity(100)\nfor i ∈ 1 .. 9999\n  b ← a\n  a[1,1] ← i"),
        steps,
        "copies"
    );
    assert_eq!(under(&limits, "a ← identity(50)\nfor i ∈ 1 .. 9999\n  a·a"), steps, "products");
    for elimination in ["lsolve(a,a⟨1⟩)", "a^−1", "|a|"] {
        let program = format!("a ← identity(50)\nfor i ∈ 1 .. 9999\n  {elimination}");
        assert_eq!(under(&limits, &program), steps, "{elimination}");
    }
    assert_eq!(
        under(&limits, "for i ∈ 1 .. 99999999\n  1 = 0 ∧ rows(identity(8000)) = 1"),
        steps,
        "behind a false operand"
    );
}

/// With n = 96, n² = 9,216 steps go into the matrix and n² + n³ / 48 = 27,648 into the elimination
/// of its determinant. An inverse asks for as much, and for more than that by its unit columns.
#[test]
fn an_inverse_counts_its_unit_columns() {
    let limits = Limits { steps: 70_000, ..Limits::default() };
    let listing = program("a ← identity(96)\n|a|");
    let determinant = listing.runner(&Settings::default(), &limits).call(&[Value::Number(5.0)]);
    assert_eq!(determinant.expect("one elimination is within the limit").value, Value::Number(1.0));
    let steps = Cause::Limit { limit: 70_000, of: "steps" };
    assert_eq!(under(&limits, "a ← identity(96)\na^−1"), steps);
}

/// Eigenvalues count as ten eliminations with what they read and write, vectors as so much for each; both
/// hold two matrices.
#[test]
fn eigenvalues_count_their_eliminations() {
    for (function, steps) in [("eigenvals", 10 * (64 + 128)), ("eigenvecs", 8 * 10 * (64 + 128))] {
        let listing = program(&format!("{function}(identity(8))"));
        let run = |entries| {
            let limits = Limits { entries, ..Limits::default() };
            let mut worksheet = listing.runner(&Settings::default(), &limits);
            worksheet.call(&[5.0.into()]).map(|_| worksheet.steps()).map_err(|why| why.cause)
        };
        // Beside them a statement, three expressions, two functions, and the entries of the matrix.
        assert_eq!(run(1 + 128), Ok(steps + 1 + 3 + 16 + 64), "{function}");
        assert!(matches!(run(128), Err(Cause::Limit { limit: 128, .. })), "{function}");
    }
}

/// A listing that needs exactly what a limit allows runs; with one less it does not.
#[test]
fn limits_are_reached_exactly() {
    let steps = |steps| Limits { steps, ..Limits::default() };
    let entries = |entries| Limits { entries, ..Limits::default() };
    // Beside the turns, a statement each, an array that grows at its end takes a step an entry; 402
    // names and numbers are read.
    let growing = "for i ∈ 1 .. 200\n  a[i] ← i";
    // Two statements, 96² numbers and an elimination, a call and four expressions.
    let elimination = "a ← identity(96)\n|a|";
    // x, i and ten copies of v; the worksheet's own v.
    let nested = "for i ∈ 1 .. 10\n  a[i] ← v";
    // x and the two arguments.
    let arguments = "max(identity(20), identity(20))";
    // x, i and the name that is written over each time.
    let over = "for i ∈ 1 .. 50\n  y ← i";
    let over_array = "for i ∈ 1 .. 50\n  y ← 7\n  y[1] ← 1";
    // A text of 800 characters, written in as many and kept twice.
    let traced = format!("trace(\"{}\")", "a".repeat(800));
    // The product of a column and a row has 30² entries; x and the column are held.
    let product = "a[30] ← 1\na·aᵀ";
    for (lines, enough, one_less) in [
        (growing, steps(1_003), steps(1_002)),
        (elimination, steps(2 + 9_216 + 27_648 + 12), steps(2 + 9_216 + 27_648 + 11)),
        (nested, entries(1 + 3 + 1 + 30), entries(1 + 3 + 1 + 29)),
        (arguments, entries(1 + 400 + 400), entries(1 + 400 + 399)),
        (over, entries(3), entries(2)),
        (over_array, entries(3), entries(2)),
        (&traced, entries(1 + 202), entries(1 + 201)),
        (product, entries(1 + 30 + 900), entries(1 + 30 + 899)),
    ] {
        let run = |limits: &Limits| {
            let listing = program(lines);
            let mut worksheet = listing.runner(&Settings::default(), limits);
            if lines == nested {
                worksheet.define("v", Array::column(vec![1.0, 2.0, 3.0]));
            }
            worksheet.call(&[5.0.into()]).map(drop).map_err(|failure| failure.cause)
        };
        assert_eq!(run(&enough), Ok(()), "{lines}");
        assert!(matches!(run(&one_less), Err(Cause::Limit { .. })), "{lines}");
    }
}

/// Calls count the blocks and expressions that lead to them: here `g(x)` within a statement of f,
/// and a statement, a block and a name in g.
#[test]
fn calls_within_calls_count_their_levels() {
    let f = Listing::parse("f", "f(x) :=\n  g(x)").unwrap();
    let mut sheet = Sheet::default();
    sheet.define_program(Listing::parse("g", "g(x) :=\n  if x\n    x").unwrap().into());
    let run = |calls| {
        let limits = Limits { calls, ..Limits::default() };
        let outcome = f.runner_in(&sheet, &Settings::default(), &limits).call(&[5.0.into()]);
        outcome.map(|outcome| outcome.value).map_err(|failure| failure.cause)
    };
    assert_eq!(run(6), Ok(5.0.into()));
    assert_eq!(run(5), Err(Cause::Limit { limit: 5, of: "levels of calls" }));
    assert_eq!(run(4), Err(Cause::Limit { limit: 4, of: "levels of calls" }));
}

/// Arrays within arrays, one deeper each turn.
#[test]
fn arrays_nest_less_deep_than_the_limit() {
    let limits = Limits { depth: 8, ..Limits::default() };
    let nesting = |turns: u32| {
        let listing = program(&format!("a[1] ← v\nfor i ∈ 1 .. {turns}\n  a[1] ← a"));
        let mut worksheet = listing.runner(&Settings::default(), &limits);
        worksheet.define("v", Array::column(vec![1.0]));
        worksheet.call(&[5.0.into()]).map(drop).map_err(|failure| failure.cause)
    };
    assert_eq!(nesting(7), Ok(()));
    assert_eq!(nesting(8), Err(Cause::Limit { limit: 8, of: "arrays within arrays" }));
}

/// What reaches a limit is read, what goes beyond it is refused.
#[test]
fn listings_reach_their_limits_exactly() {
    let refused = |body: &str, limits: &Limits| {
        let listing = Listing::parse_within("f", &format!("f(x) :=\n{body}"), limits);
        listing.err().map(|error| error.message)
    };
    let characters = Limits { characters: 7, ..Limits::default() };
    assert_eq!(refused("  x + 123", &characters), None);
    let longer = "found 8 characters, expected at most 7";
    assert_eq!(refused("  x + 1234", &characters), Some(longer.into()));
    let lines = Limits { lines: 3, ..Limits::default() };
    assert_eq!(refused("  x\n  x", &lines), None);
    let more = "found 4 lines, expected at most 3";
    assert_eq!(refused("  x\n  x\n  x", &lines), Some(more.into()));
    let depth = |depth| Limits { depth, ..Limits::default() };
    assert_eq!(refused("  1 + (1)", &depth(3)), None);
    let deeper = "found operators and brackets more than 2 deep";
    assert_eq!(refused("  1 + (1)", &depth(2)), Some(deeper.into()));
    assert_eq!(refused("  g(g())", &depth(2)), None);
    let brackets = "found brackets more than 2 deep";
    assert_eq!(refused("  g(g(g()))", &depth(2)), Some(brackets.into()));
    let blocks = "  if 1\n    if 1\n      1";
    assert_eq!(refused(blocks, &depth(3)), None);
    assert_eq!(refused(blocks, &depth(2)), Some("found blocks more than 2 deep".into()));
}

#[test]
fn endless_output() {
    let limits = Limits { entries: 10_000, ..Limits::default() };
    let held = Cause::Limit { limit: 10_000, of: "numbers held at once" };
    assert_eq!(under(&limits, "for i ∈ 1 .. 99999999\n  trace(i)"), held);
    assert_eq!(under(&limits, "y ← trace(1)\nfor i ∈ 1 .. 99\n  y ← trace(y, y)"), held);
    assert_eq!(under(&limits, "for i ∈ 1 .. 99999999\n  a[i] ← i"), held);
}

/// Words of the notation with `~` between them, some of them in listings that make sense.
const WORDS: [&str; 4] = [
    "x~v~m~a~i~1~2~0~0.5~9999999~ ~ ~   ~(~)~[~]~,~|~ᵀ~ + ~ − ~−~·~ / ~ < ~ = ~ ∧ ~ ← ",
    " if ~for i ∈ ~if ~ .. ~\n~\n  ~\n    ~rows(~identity(~trace(~v[i]~w~;~^~⟨~⟩~ ∨ ~¬",
    "\"s\"~√(~∑(~∑(i ∈ 1 .. 3, ~while ~return ~break~continue~otherwise~try~on error",
    "lsolve(~stack(~submatrix(~|m|~v⟨1⟩~w[i] ← v~w[1] ← w~1e300",
];

/// Some words, as the body of a program.
pub fn words(rng: &mut Rng) -> String {
    let all: Vec<&str> = WORDS.iter().flat_map(|line| line.split('~')).collect();
    (0..rng.usize(..40)).map(|_| one_of(rng, &all)).collect()
}

#[test]
fn any_text_ends() {
    let mut rng = Rng::with_seed(2026);
    for _ in 0..2_000 {
        let limits = Limits { steps: 10_000, entries: 10_000, ..Limits::default() };
        if let Ok(listing) = Listing::parse("f", &format!("f(x) :=\n  {}", words(&mut rng))) {
            let mut worksheet = listing.runner(&Settings::default(), &limits);
            worksheet.define("v", Array::column(vec![1.0, 2.0, 3.0]));
            let _ = worksheet.call(&[Value::Number(5.0)]);
        }
    }
}
