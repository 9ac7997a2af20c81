//! From text to syntax tree and back.

use mathcad::edit::EditError;
use mathcad::{Edit, Listing, ParseError};

#[test]
fn lines_count_without_headers() {
    let listing = Listing::parse("f", "# one\n# two\nf(x) :=\n\n  x\n").unwrap();
    let numbers: Vec<_> = listing.lines().iter().map(|line| (line.printed, line.in_file)).collect();
    assert_eq!(numbers, [(1, 3), (2, 5)]);
}

#[test]
fn an_arrow_is_no_comparison() {
    let message = |line: &str| refused(&format!("f(x) :=\n  {line}\n  x")).message;
    for line in ["1 if x <-1", "1 if x < -1", "y <- x < - 1", "if x + 1 <- 1\n    x", "(x <-1)"] {
        let message = message(line);
        assert!(
            message.contains("write `x <- 1` to assign 1, or `x < (-1)` to compare"),
            "{line}: {message}"
        );
    }
}

fn refused(text: &str) -> ParseError {
    Listing::parse("f", text).err().unwrap_or_else(|| panic!("{text:?} was read"))
}

#[test]
fn errors_point_at_line_and_column() {
    let error = refused("# header\nf(x) :=\n  y ← 1\n  z ← y[1\n  z");
    assert_eq!((error.line, error.file_line, error.column), (3, 4, 10));
    assert_eq!(
        error.message,
        "found the end of the line, expected `,` or `[` or `]` or `^` or `ᵀ` or `∧` or `∨` or `⟨` \
         or a comparison or an operator"
    );
    let shown = error.to_string();
    assert!(shown.starts_with("f, line 3 (line 4 of the file), column 10: found"), "{shown}");
    assert!(shown.ends_with("      z ← y[1\n             ^"), "{shown}");
}

/// What is missing below a `try` is missed behind the last line of its block.
#[test]
fn a_try_without_its_other_block_is_refused() {
    for below in ["", "\n  z ← 2", "\n  z ← 2\n  z"] {
        let error = refused(&format!("f(x) :=\n  try\n    y ← 1{below}"));
        assert_eq!((error.line, error.column), (3, 10), "{below:?}");
        assert_eq!(error.message, "expected a line `on error` below, beside its `try`");
    }
}

/// Those that it reads or calls, in either block of a `try` too, and neither receives nor writes
/// to.
#[test]
fn a_program_takes_names_from_its_worksheet() {
    let text = "f(x) :=\n  try\n    y ← a + x\n  on error\n    y ← g(b)\n  y";
    assert_eq!(Listing::parse("f", text).unwrap().free_names(), ["a", "g", "b"]);
    let free = |body: &str| {
        let listing = Listing::parse("f", &format!("f(x) :=\n{body}")).unwrap();
        listing.free_names().into_iter().map(String::from).collect::<Vec<_>>()
    };
    assert_eq!(free("  ∑(i ∈ a .. b, i·c)"), ["∑", "a", "b", "c"], "not the variable of a sum");
    assert_eq!(free("  i + ∑(i ∈ 1 .. 2, x)"), ["i", "∑"], "but a name outside the sum");
    let spans = "  for i ∈ a, b .. c\n    for j ∈ v\n      x\n  i + j";
    assert_eq!(free(spans), ["a", "b", "c", "v"], "the ranges of loops, not their variables");
    let guards = "  y[a] ← 1 if b\n  while c\n    break if d\n  return e if g";
    assert_eq!(free(guards), ["a", "b", "c", "d", "e", "g"]);
}

#[test]
fn errors_say_what_was_expected() {
    let message = |text| refused(&format!("f(x) :=\n{text}")).message;
    assert_eq!(message("  x ← )"), "found `)`, expected `¬` or an operand");
    assert_eq!(message("  for 1 ∈ 1 .. 2\n    x"), "found `1`, expected a name");
    assert_eq!(message("  for i ∈ 1 .. 2"), "expected an indented line below");
    assert_eq!(message("  x ← 1\n      x"), "found 6 spaces of indentation, expected 2");
    let deeper = "  if x\n        x";
    assert_eq!(message(deeper), "found 8 spaces of indentation, expected 4");
    assert_eq!(message("   x"), "found an odd space, expected two for each level");
    assert_eq!(message("  x\nx"), "found a line beside the header, expected it indented");
    assert_eq!(message("  x ? 1"), "found \"?\", which is no part of the notation");
    let open = "found a string without its second quotation mark";
    assert_eq!(message("  x ← \"abc"), open);
    assert_eq!(message("  x ← \""), open);
    assert_eq!(message("  x § 1"), "found \"§\", which is no part of the notation");
    assert_eq!(message("  \tx"), "found \"\\t\", which is no part of the notation");
    assert_eq!(message(&format!("  {}", "9".repeat(400))), "found a number too large");
}

/// The space that separates elements of a row is none within the brackets of a call.
#[test]
fn errors_point_at_the_space_between_elements() {
    let error = refused("f(x) :=\n  max(1   2)");
    assert_eq!((error.line, error.column), (2, 8));
    assert!(error.message.starts_with("found the space between two elements"), "{error}");
}

/// A full stop or an `e` behind a number belongs to it only if digits follow.
#[test]
fn numbers_end_where_no_digit_follows() {
    for line in ["2e", "2E+", "2e−"] {
        let message = refused(&format!("f(x) :=\n  {line}")).message;
        assert!(message.starts_with("found a name, expected"), "{line}: {message}");
    }
}

#[test]
fn hostile_text_never_breaks_the_reader() {
    for text in [
        "",
        "#",
        "f(",
        "f(x) :=",
        "ᵀ",
        "f(x) :=\n  x[",
        "f(x) :=\n  (",
        "f(x) :=\n  |x",
        "f(x) :=\n  x]]",
        ":=",
    ] {
        refused(text);
    }
}

#[test]
fn an_edit_keeps_printed_numbers() {
    let listing = Listing::parse("f", "f(x) :=\n  y ← x\n  z ← y\n  z").unwrap();
    let edit = Edit::parse(
        "# Because.\nf lines 2-3:\n 2  \x20 y ← x\n 3    for i ∈ 1 .. 2\n 2      y ← y + 1\n",
    )
    .unwrap();
    let edited = edit.apply(&listing).unwrap();
    assert_eq!(edit.reason, "Because.\n");
    assert_eq!(edited.lines().iter().map(|line| line.printed).collect::<Vec<_>>(), [1, 2, 3, 2, 4]);
    let in_file: Vec<_> = edited.lines().iter().map(|line| line.in_file).collect();
    assert_eq!(in_file, [1, 3, 4, 5, 4], "those of the edit where it has the line");
    assert_eq!(edited.to_string(), "f(x) :=\n  y ← x\n  for i ∈ 1 .. 2\n    y ← y + 1\n  z\n");
}

#[test]
fn an_edit_must_fit_its_listing() {
    let listing = Listing::parse("f", "f(x) :=\n  x").unwrap();
    let error = |text| Edit::parse(text).and_then(|edit| edit.apply(&listing)).err();
    assert!(
        matches!(error("g line 2:\n 2    x"), Some(EditError::NoSuchLines { .. })),
        "another listing"
    );
    assert!(
        matches!(error("f lines 2-3:\n 2    x"), Some(EditError::NoSuchLines { .. })),
        "too few lines"
    );
    assert!(matches!(error("f lines 3-2:"), Some(EditError::NoSuchLines { .. })), "reversed");
    assert!(matches!(error("f line 2:\n 2    x ←"), Some(EditError::Parse(_))));
    assert!(matches!(error("f line x:"), Some(EditError::Format { line: 1, .. })));
    assert!(matches!(error(" 2    x"), Some(EditError::Format { line: 1, .. })));
    assert!(matches!(error("f line 2:\nx"), Some(EditError::Format { line: 2, .. })));
}
