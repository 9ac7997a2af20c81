//! What README.md, the guide and CONTRIBUTING.md say.
//!
//! - A number stands in a table that a test made and that the page names, or in a phrase of `GIVEN`.
//! - A command in a block of shell or in `code` is one that the program has, with options that its
//!   help has.
//!
//! That the files exist which a page names is checked by `tests/fidelity/citations.rs`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use plane_contact::exit::ExitStatus;

use crate::common::program::run;

/// Phrases with numbers that no table has, each with the reason.
const GIVEN: &[(&str, &str)] = &[
    ("eq. (1)", "an equation of the paper"),
    ("The listing of fig. 3", "a figure of the paper"),
    ("The listing of fig. 2", "a figure of the paper"),
    ("the paper makes 20", "the paper's number of iterations"),
    ("iterations of the paper's variants | 20", "a default of `iterations`"),
    ("| thickness | 1 |", "as above"),
    ("under friction | 16 |", "as above"),
    ("sections 4 and 5", "sections of the page on how the listings are read"),
    ("section 8", "as above"),
    ("below 0 it has penetrated", "a definition"),
    ("which exits with 1 where", "the exit status of another program"),
    ("SHA-256 of each array", "the name of a hash"),
    ("between 0 and 1", "a definition"),
    ("at most 1,000 free equations", "the limit of exact runs, in `src/engine/linear/cost.rs`"),
    ("most of them 0", "a definition"),
    ("all are 0", "as above"),
    (
        "by more than 30 degrees",
        "that of a circle of twelve edges, in `src/problem/scene/support.rs`",
    ),
    ("lines 7 and 8", "lines of a listing"),
    ("1 or 0 for x", "the paper's table S"),
    ("number, type, 2, physical tag", "a number of tags, in the paper's tables"),
    ("numbered 1 to R", "the paper counts from 1"),
    ("sqrt(2/3 e:e)", "a formula"),
    ("MSH 2.0 to 2.2 or 4.1", "versions of a file format"),
    ("IEEE 754", "a standard"),
    ("fewer than 300 nodes", "a limit, tested by tests/program/mathcad.rs"),
    ("Mathcad 14 or 15", "versions"),
    ("Apache-2.0", "the name of a licence"),
    ("20 lines at most", "a rule of style"),
    ("lines 22 and 23", "lines of a listing"),
    ("section 4", "a section of that page"),
    ("section 5", "as above"),
];

/// The pages and their text.
fn pages() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let guide = fs::read_dir(root.join("src/guide")).expect("the guide");
    let mut names: Vec<String> = guide
        .map(|page| page.expect("a page").file_name().into_string().expect("UTF-8"))
        .map(|page| format!("src/guide/{page}"))
        .chain(["README.md".into(), "CONTRIBUTING.md".into()])
        .collect();
    names.sort();
    let text = |name: &String| fs::read_to_string(root.join(name)).expect("a page");
    names.iter().map(|name| (name.clone(), text(name))).collect()
}

/// A page as one line, without its blocks of code, the marks of quotations and the numbers of lists.
fn in_one_line(page: &str) -> String {
    let lines = page.split("```").step_by(2).flat_map(str::lines);
    let text = lines.map(|line| {
        let is_item = |(mark, _): &(&str, &str)| mark.bytes().all(|c| c.is_ascii_digit());
        line.split_once(". ").filter(is_item).map_or(line, |(_, text)| text)
    });
    let words = text.flat_map(str::split_whitespace).filter(|word| *word != ">");
    words.collect::<Vec<_>>().join(" ")
}

/// The numbers of a text in one line, and where they start. No number: a digit of a name (C4, f64),
/// what stands in `code`, the target of a link.
fn numbers(text: &str) -> Vec<(usize, String)> {
    let (mut numbers, mut skipped_to, mut before) = (Vec::new(), 0, ' ');
    for (at, c) in text.char_indices() {
        if at >= skipped_to {
            let rest = &text[at + c.len_utf8()..];
            let closing = |mark: char| rest.find(mark).map_or(text.len(), |n| at + n + 2);
            match c {
                '`' => skipped_to = closing('`'),
                '(' if before == ']' => skipped_to = closing(')'),
                _ if c.is_ascii_digit() => {
                    let number = number(&text[at..]);
                    skipped_to = at + number.len();
                    if !(before.is_alphanumeric() || before == '_') {
                        numbers.push((at, number.replace(',', "")));
                    }
                }
                _ => (),
            }
        }
        before = c;
    }
    numbers
}

/// The number that a text starts with: `1e-3`, `3,806` and `0.75` are one each.
fn number(text: &str) -> &str {
    let mut end = 0;
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    while digit(end)
        || bytes.get(end).is_some_and(|c| b".,".contains(c)) && digit(end + 1)
        || bytes.get(end) == Some(&b'e') && (digit(end + 1) || bytes.get(end + 1) == Some(&b'-'))
        || end > 0 && bytes[end - 1] == b'e' && bytes.get(end) == Some(&b'-')
        || bytes.get(end).is_some_and(u8::is_ascii_alphanumeric)
    {
        end += 1;
    }
    &text[..end]
}

/// The numbers of the generated files that a page names.
fn generated(page: &str) -> BTreeSet<String> {
    let names = page.split(|c: char| c.is_whitespace() || "`()".contains(c));
    let files = names.filter(|name| name.contains("golden/") && name.ends_with(".md"));
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let texts = files.map(|file| fs::read_to_string(root.join(file)).expect(file));
    texts.flat_map(|text| numbers(&in_one_line(&text))).map(|(_, number)| number).collect()
}

/// The numbers of a page that stand neither in `known` nor in a phrase of `GIVEN`, with the words around
/// them.
fn unheld(page: &str, known: &BTreeSet<String>) -> Vec<String> {
    let text = in_one_line(page);
    let given = GIVEN.iter().map(|(phrase, _)| (*phrase).into());
    let statuses =
        ExitStatus::ALL.iter().map(|status| format!("exit status is {}", status.number()));
    let phrases = given.chain(statuses);
    let ranges = |phrase: String| {
        let places = text.match_indices(&phrase).map(|(at, _)| at..at + phrase.len());
        places.collect::<Vec<_>>()
    };
    let phrases: Vec<_> = phrases.flat_map(ranges).collect();
    let is_held = |(at, number): &(usize, String)| {
        known.contains(number) || phrases.iter().any(|phrase| phrase.contains(at))
    };
    let around = |(at, number): (usize, String)| {
        let from = text.floor_char_boundary(at.saturating_sub(50));
        let to = text.ceil_char_boundary((at + 50).min(text.len()));
        format!("{number} in: {}", &text[from..to])
    };
    numbers(&text).into_iter().filter(|number| !is_held(number)).map(around).collect()
}

#[test]
fn every_number_of_a_page_stands_in_a_table_that_it_names() {
    let mut wrong = Vec::new();
    for (name, page) in pages() {
        let unheld = unheld(&page, &generated(&page));
        wrong.extend(unheld.into_iter().map(|number| format!("{name}: {number}")));
    }
    assert!(wrong.is_empty(), "no table has\n{}", wrong.join("\n"));
}

/// The commands of a page, in blocks of shell and in `code`, as words.
fn commands(page: &str) -> Vec<Vec<String>> {
    let blocks = page.split("```").skip(1).step_by(2).filter(|block| block.starts_with("sh\n"));
    let lines = blocks.flat_map(str::lines).map(|line| line.split(" #").next().unwrap_or(line));
    let inline = page.split("```").step_by(2).flat_map(|prose| prose.split('`').skip(1).step_by(2));
    let words = lines.chain(inline).filter_map(|command| {
        let rest = command
            .trim()
            .strip_prefix("plane-contact ")
            .or_else(|| command.trim().strip_prefix("cargo run --release -- "))?;
        Some(rest.split_whitespace().take_while(|word| *word != ">").map(String::from).collect())
    });
    words.collect()
}

#[test]
fn every_command_of_a_page_has_its_options() {
    let (all, mut count) = (crate::texts::commands(), 0);
    for (name, page) in pages() {
        for words in commands(&page) {
            let lengths = (0..=words.len()).rev();
            let verbs = lengths.map(|length| words[..length].join(" "));
            let verbs = verbs.into_iter().find(|verbs| verbs.is_empty() || all.contains(verbs));
            let verbs = verbs.expect("no words are a command");
            let args: Vec<&str> = verbs.split_whitespace().chain(["--help"]).collect();
            let help = String::from_utf8(run(Path::new("."), &args).stdout).expect("UTF-8");
            assert!(!verbs.is_empty() || words[0].starts_with('-'), "{name}: {words:?}");
            for option in words.iter().filter(|word| word.starts_with("--") && word.len() > 2) {
                let option = option.split(['=', '|']).next().expect("a part");
                assert!(names(&help).contains(option), "{name}: {words:?} has no {option}");
            }
            count += 1;
        }
    }
    assert!(count > 30, "{count} commands are found");
}

/// The words of a page of help, options among them.
fn names(help: &str) -> BTreeSet<&str> {
    help.split(|c: char| !c.is_ascii_alphanumeric() && c != '-').collect()
}
