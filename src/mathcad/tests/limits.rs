//! Hostile listings end in errors: no hang, no overflowing stack, no exhausted memory.

use super::{one_of, program};
use fastrand::Rng;
use mathcad::{Array, Cause, Limits, Listing, Settings, Sheet, Value};
use testing::golden_file::assert_rows;

/// The rows of `limits.txt`: limits, `: `, and the lines of a program of x = 5, and of v and m where `v` is named.
#[test]
fn limits_hold() {
    let answer = |row: &str| {
        let (under, body) = row.split_once(": ").expect("limits");
        let mut limits = Limits::default();
        for (name, number) in under.split(' ').filter_map(|limit| limit.split_once('=')) {
            let number = number.parse().expect("a number");
            match name {
                "steps" => limits.steps = number as u64,
                "entries" => limits.entries = number,
                "depth" => limits.depth = number,
                "lines" => limits.lines = number,
                "characters" => limits.characters = number,
                other => panic!("{other}"),
            }
        }
        let text = format!("f(x) :=\n  {}", body.replace('⏎', "\n  "));
        let listing = match Listing::parse_within("f", &text, &limits) {
            Ok(listing) => listing,
            Err(why) => return format!("is not read: {}", why.message),
        };
        let mut worksheet = Sheet::empty();
        if under.starts_with('v') {
            worksheet.define("v", Array::column(vec![1.0, 2.0, 3.0]));
        }
        match listing.runner(&worksheet, &Settings::default(), &limits).call(&[Value::Number(5.0)])
        {
            Ok(ended) => match ended.value.number() {
                Some(x) => format!("ends with {x}"),
                None => "ends".into(),
            },
            Err(failure) => failure.cause.to_string(),
        }
    };
    assert_rows("tests/limits.txt", answer);
}

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

/// Eigenvalues count as ten eliminations with what they read and write, vectors as so much for each; both
/// hold two matrices.
#[test]
fn eigenvalues_count_their_eliminations() {
    for (function, steps) in [("eigenvals", 10 * (64 + 128)), ("eigenvecs", 8 * 10 * (64 + 128))] {
        let listing = program(&format!("{function}(identity(8))"));
        let run = |entries| {
            let limits = Limits { entries, ..Limits::default() };
            let worksheet = Sheet::empty();
            let mut runner = listing.runner(&worksheet, &Settings::default(), &limits);
            runner.call(&[5.0.into()]).map(|_| runner.steps()).map_err(|why| why.cause)
        };
        // Beside them a statement, three expressions, two functions, and the entries of the matrix.
        assert_eq!(run(1 + 128), Ok(steps + 1 + 3 + 16 + 64), "{function}");
        assert!(matches!(run(128), Err(Cause::Limit { limit: 128, .. })), "{function}");
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
        let outcome = f.runner(&sheet, &Settings::default(), &limits).call(&[5.0.into()]);
        outcome.map(|outcome| outcome.value).map_err(|failure| failure.cause)
    };
    assert_eq!(run(6), Ok(5.0.into()));
    assert_eq!(run(5), Err(Cause::Limit { limit: 5, of: "levels of calls" }));
    assert_eq!(run(4), Err(Cause::Limit { limit: 4, of: "levels of calls" }));
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
            let mut worksheet = Sheet::empty();
            worksheet.define("v", Array::column(vec![1.0, 2.0, 3.0]));
            let _ = listing
                .runner(&worksheet, &Settings::default(), &limits)
                .call(&[Value::Number(5.0)]);
        }
    }
}
