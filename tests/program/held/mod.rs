//! Every number of README.md and of the texts of help, held to what the program computes.
//!
//! A page is held passage by passage. A passage is a piece of the page as the program writes it: its
//! numbers are computed, its words are those of the page. It must stand on the page to the letter,
//! and every number of the page must stand in a passage. To add a number to a page, add a passage to
//! `readme.rs` or `help.rs`.

mod help;
mod measured;
mod readme;

/// The passages of a page.
struct Passages {
    /// Those whose numbers are computed, by section of the page.
    computed: &'static [fn() -> Vec<String>],
    /// Those whose numbers nothing computes, each with the reason.
    given: &'static [(&'static str, &'static str)],
}

/// A page as one line, without its blocks of code.
fn in_one_line(page: &str) -> String {
    let mut in_code = false;
    // A quotation's lines start with its mark.
    let unquoted = |line| str::trim_start_matches(line, "> ");
    let text = |line: &&str| {
        let is_fence = line.trim_start().starts_with("```");
        in_code ^= is_fence;
        !in_code && !is_fence
    };
    page.lines()
        .filter(text)
        .map(unquoted)
        .flat_map(str::split_whitespace)
        .collect::<Vec<_>>()
        .join(" ")
}

/// The numbers of a page in one line, and where they start. No number: a digit of a name (C4, f64),
/// what stands in `code`, the target of a link.
fn numbers(page: &str) -> Vec<(usize, &str)> {
    let (mut numbers, mut skipped_to, mut before) = (Vec::new(), 0, ' ');
    let byte = |at: usize| page.as_bytes().get(at).copied().unwrap_or(b' ');
    // 1e-3 is one number, and so is 3,806.
    let is_part = |at: usize| match byte(at) {
        b'-' => byte(at - 1) == b'e',
        b',' => byte(at + 1).is_ascii_digit(),
        byte => byte.is_ascii_alphanumeric() || byte == b'.',
    };
    for (at, c) in page.char_indices() {
        let end = |closing: &str| page[at + 1..].find(closing).map_or(page.len(), |n| at + n + 2);
        if at >= skipped_to {
            match c {
                '`' => skipped_to = end("`"),
                '(' if before == ']' => skipped_to = end(")"),
                _ if c.is_ascii_digit() => {
                    skipped_to = (at..page.len()).find(|k| !is_part(*k)).unwrap_or(page.len());
                    if !(before.is_alphanumeric() || before == '_') {
                        numbers.push((at, page[at..skipped_to].trim_end_matches('.')));
                    }
                }
                _ => (),
            }
        }
        before = c;
    }
    numbers
}

/// Prints how many numbers a page has and how many are held; all must be.
fn assert_held(name: &str, page: &str, passages: &Passages) {
    let page = in_one_line(page);
    let mut wrong = Vec::new();
    let mut mark = |text: &str, why: &str| {
        let text = in_one_line(text);
        if numbers(&text).is_empty() || !page.contains(&text) {
            wrong.push(format!("{name} does not say ({why}):\n  {text}"));
        }
        page.match_indices(&text).map(|(at, _)| at..at + text.len()).collect::<Vec<_>>()
    };
    // On threads of their own: one of rayon's that waits for what another test computes would keep that
    // from its end, where it has begun a part of it.
    let computed: Vec<Vec<String>> = std::thread::scope(|scope| {
        let begun: Vec<_> = passages.computed.iter().map(|rows| scope.spawn(rows)).collect();
        begun.into_iter().map(|rows| rows.join().expect("what it computes")).collect()
    });
    let computed: Vec<_> =
        computed.iter().flatten().flat_map(|text| mark(text, "the program computes it")).collect();
    let given: Vec<_> = passages.given.iter().flat_map(|(text, why)| mark(text, why)).collect();
    let numbers = numbers(&page);
    let stands_in = |passages: &[std::ops::Range<usize>], at: usize| {
        passages.iter().any(|passage| passage.contains(&at))
    };
    let by_program = numbers.iter().filter(|(at, _)| stands_in(&computed, *at)).count();
    let unheld =
        numbers.iter().filter(|(at, _)| !stands_in(&computed, *at) && !stands_in(&given, *at));
    for (at, number) in unheld.clone() {
        let around = |bytes: usize| page.ceil_char_boundary(bytes);
        let place = &page[around(at.saturating_sub(60))..around((at + 60).min(page.len()))];
        wrong.push(format!("{name}: nothing holds {number} in:\n  {place}"));
    }
    let (count, held) = (numbers.len(), numbers.len() - unheld.count());
    eprintln!("{name}: {count} numbers, {held} held, {by_program} of them computed");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn numbers_are_found() {
    let found = |page: &str| {
        let page = in_one_line(page);
        numbers(&page).into_iter().map(|(_, number)| number.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(
        found("from 1e-3 to 2.5 (see C4, `f64` and [7](a/8)).\n```\n9\n```\nAnd 10."),
        ["1e-3", "2.5", "7", "10"]
    );
    assert!(found("no number: R10, f64x2, LE1").is_empty());
}

#[test]
fn every_number_of_readme() {
    assert_held("README.md", include_str!("../../../README.md"), &readme::PASSAGES);
}

#[test]
fn every_number_of_the_texts_of_help() {
    assert_held("help", &help::pages(), &help::PASSAGES);
}
