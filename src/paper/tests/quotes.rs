//! The mirror quotes the listings: byte for byte, every line once, in the listing's order within a
//! function.

use std::collections::BTreeMap;

/// The printed lines of a listing, from 1, without the indentation that stands for Mathcad's bars.
fn printed(listing: &str) -> BTreeMap<usize, String> {
    let lines = listing.lines().filter(|line| !line.starts_with('#'));
    lines.enumerate().map(|(k, line)| (k + 1, line.trim_start().to_string())).collect()
}

/// The quotes of a mirror, `//# <line> <text>`, in the order of the source.
fn quotes(source: &str) -> Vec<(usize, String)> {
    let quoted = source.lines().filter_map(|line| line.trim_start().strip_prefix("//#"));
    quoted
        .map(|quote| {
            let quote = quote.trim_start_matches(' ');
            let (number, text) =
                quote.split_once(' ').expect("a quote is a line number and a text");
            (number.parse().expect("a line number"), text.to_string())
        })
        .collect()
}

fn check(listing: &str, source: &str, lines: usize) {
    let (printed, quotes) = (printed(listing), quotes(source));
    assert_eq!(printed.len(), lines, "lines of the listing");
    for (number, text) in &quotes {
        assert_eq!(Some(text), printed.get(number), "the quote of line {number}");
    }
    let mut once: Vec<usize> = quotes.iter().map(|(number, _)| *number).collect();
    once.sort_unstable();
    assert_eq!(once, (1..=lines).collect::<Vec<_>>(), "each line once");
    for function in source.split("\npub fn ") {
        assert!(self::quotes(function).is_sorted(), "in order: {function}");
    }
}

#[test]
fn c_cnt_is_mirrored_line_by_line() {
    check(include_str!("../../../listings/c_cnt.txt"), include_str!("../mirror/c_cnt.rs"), 31);
}

#[test]
fn km_is_mirrored_line_by_line() {
    check(include_str!("../../../listings/Km.txt"), include_str!("../mirror/km.rs"), 34);
}

#[test]
fn a_changed_quote_would_be_noticed() {
    let source = include_str!("../mirror/km.rs").replacen("fl ← 0", "fl ← 1", 1);
    let listing = include_str!("../../../listings/Km.txt");
    assert!(std::panic::catch_unwind(|| check(listing, &source, 34)).is_err());
}
