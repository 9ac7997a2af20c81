//! What README.md and the guide say: a command has the options that it is shown with, and a measured number stands in a
//! table of `golden`. That what a page links to is there is checked by `tests/fidelity/citations.rs`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::common::program::run;

/// The pages and their text.
fn pages() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let guide = fs::read_dir(root.join("src/guide")).expect("the guide");
    let guide = guide.map(|page| page.expect("a page").path());
    let pages = guide.chain(["README.md", "CONTRIBUTING.md"].map(|name| root.join(name)));
    pages
        .map(|path| {
            let text = fs::read_to_string(&path).expect("a page");
            (path.display().to_string(), text)
        })
        .collect()
}

/// The shares of a text: numbers before a per cent sign.
fn shares(text: &str) -> BTreeSet<&str> {
    let words: Vec<&str> = text.split(|c: char| c.is_whitespace() || "(|*,".contains(c)).collect();
    words.windows(2).filter(|pair| pair[1].starts_with('%')).map(|pair| pair[0]).collect()
}

#[test]
fn every_share_of_a_page_stands_in_a_table() {
    let tables = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/golden/tables"));
    let tables = tables.expect("tables").map(|table| table.expect("a table").path());
    let tables: String = tables.map(|path| fs::read_to_string(path).expect("a table")).collect();
    let mut known = shares(&tables);
    // A threshold of the audit.
    known.insert("1");
    for (name, page) in pages() {
        let unknown: Vec<_> = shares(&page).difference(&known).copied().collect();
        assert!(unknown.is_empty(), "{name}: no table has {unknown:?} %");
    }
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
