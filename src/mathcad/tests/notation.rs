//! From text to syntax tree and back.

use mathcad::edit::EditError;
use mathcad::{Edit, Listing};
use testing::golden_file::assert_rows;

/// The rows of `notation.txt`: the lines of a program of x, or behind `raw: ` a file; ⏎ is a line end, ⇥ a tabulator.
#[test]
fn listings_are_read_or_refused() {
    let answer = |row: &str| {
        let row = row.replace('⇥', "\t");
        let text = match row.strip_prefix("raw:") {
            Some(text) => text.trim_start_matches(' ').replace('⏎', "\n"),
            None => format!("f(x) :=\n  {}", row.replace('⏎', "\n  ")),
        };
        match Listing::parse("f", &text) {
            Ok(listing) => format!("takes {}", listing.free_names().join(", ")),
            Err(why) => {
                let (line, in_file, column) = (why.line, why.file_line, why.column);
                format!("line {line}, {in_file} of the file, column {column}: {}", why.message)
            }
        }
    };
    assert_rows("tests/notation.txt", answer);
}

/// An error is shown with its line, and a mark at its column.
#[test]
fn an_error_shows_its_line() {
    let text = "# header\nf(x) :=\n  y ← 1\n  z ← y[1\n  z";
    let shown = Listing::parse("f", text).expect_err("no second bracket").to_string();
    assert!(shown.starts_with("f, line 3 (line 4 of the file), column 10: found"), "{shown}");
    assert!(shown.ends_with("      z ← y[1\n             ^"), "{shown}");
}

#[test]
fn lines_count_without_headers() {
    let listing = Listing::parse("f", "# one\n# two\nf(x) :=\n\n  x\n").unwrap();
    let numbers: Vec<_> = listing.lines().iter().map(|line| (line.printed, line.in_file)).collect();
    assert_eq!(numbers, [(1, 3), (2, 5)]);
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
