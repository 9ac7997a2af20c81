//! What README.md and the guide say: a command runs as it is shown, and a measured number stands in a
//! table of `golden`. That what a page links to is there is checked by `tests/fidelity/citations.rs`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

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

/// The commands of a page, in blocks of shell and in `code`, without those that name a command alone.
fn commands(page: &str) -> Vec<String> {
    let is_shell =
        |block: &&str| ["sh\n", "bash\n", "text\n"].iter().any(|kind| block.starts_with(kind));
    let blocks = page.split("```").skip(1).step_by(2).filter(is_shell);
    let lines = blocks.flat_map(str::lines).map(|line| line.split(" #").next().unwrap_or(line));
    let inline = page.split("```").step_by(2).flat_map(|prose| prose.split('`').skip(1).step_by(2));
    let commands = lines.chain(inline).filter_map(|command| {
        let line = command.split_whitespace().collect::<Vec<_>>().join(" ");
        let line =
            line.replace("mesh KIND --out DIR", "mesh punch --out my").replace(" V", " tied");
        let line = line.split(" && ").next().unwrap_or(&line);
        line.strip_prefix("plane-contact ")
            .or_else(|| line.strip_prefix("cargo run --release -- "))
            .map(String::from)
    });
    commands.collect()
}

/// Commands of pages that take more than ten seconds, whose texts, tables or pages have tests of their own; those
/// that stand there without the file that they take.
const ELSEWHERE: &[&str] = &[
    "audit",
    "audit --claim P12",
    "audit --full",
    "audit --prices",
    "audit --range",
    "audit fig1 --prices --repairs",
    "extremes",
    "report",
    "report --out audit.html",
    "trade",
    "trade strand",
    "trade strand --only c_tll,iterations,symmetry",
    "snapshot accept",
    "snapshot verify",
];

#[test]
fn every_command_of_a_page_runs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let cases = fs::read_to_string(root.join("tests/cases/guide.txt")).expect("the cases");
    let run: BTreeSet<&str> = cases
        .lines()
        .filter_map(|line| line.strip_prefix("$ plane-contact "))
        .map(|command| command.split(" && ").next().unwrap_or(command))
        .collect();
    let tables = fs::read_dir(root.join("golden/tables")).expect("tables");
    let tables =
        tables.map(|table| fs::read_to_string(table.expect("a table").path()).expect("text"));
    let pages: Vec<String> = pages().into_iter().map(|(_, page)| page).chain(tables).collect();
    let all: BTreeSet<String> = pages.iter().flat_map(|page| commands(page)).collect();
    let is_known =
        |command: &&String| run.contains(&***command) || ELSEWHERE.contains(&&***command);
    let unknown: Vec<&String> = all.iter().filter(|command| !is_known(command)).collect();
    assert!(unknown.is_empty(), "tests/cases/guide.txt runs none of {unknown:#?}");
    for command in ELSEWHERE {
        assert!(all.contains(*command), "no page has {command}");
    }
}
