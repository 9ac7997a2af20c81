//! Citations: what the repository's sources and pages name is there.
//!
//! - Every page (`*.md`) and every file of the repository that is named is there, and every link of
//!   a page leads to a file.
//! - What a step of a recipe in CONTRIBUTING.md names behind a file of Rust is in that file; beside it, as in
//!   "`src/engine/solve.rs`, `check`", it is defined there.

use std::fs;
use std::path::{Path, PathBuf};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
pub const READING: &str = "listings/READING.md";

/// Folders that are no part of the repository: built files and outputs.
const SKIPPED: [&str; 3] = ["target", "out", ".git"];

/// Folders at the repository's root in which a named path must exist.
const FOLDERS: [&str; 5] = ["src/", "tests/", "golden/", "listings/", "benches/"];

/// The paths from the root of every `.rs` and `.md` file below a folder but this one, whose examples name what is not
/// there.
fn texts(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder of the repository");
    let mut found = Vec::new();
    for path in entries.map(|entry| entry.expect("an entry").path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // What a package links to stands elsewhere too.
        if path.is_symlink() || SKIPPED.contains(&name.as_str()) {
            continue;
        } else if path.is_dir() {
            found.extend(texts(&path));
        } else if (name.ends_with(".rs") || name.ends_with(".md")) && !file!().ends_with(&name) {
            found.push(path.strip_prefix(ROOT).expect("within the repository").to_path_buf());
        }
    }
    found
}

/// The words of a line, in order.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// The paths that a line names: runs of what paths are made of, without the full stop of a
/// sentence.
fn paths(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_ascii_alphanumeric() && !"/._-<>*".contains(c))
        .map(|path| path.trim_end_matches(['.', '-']))
        // A pattern, such as golden/findings/<id>/, names no single file; an address, none of ours.
        .filter(|path| !path.contains(['<', '*']) && !path.starts_with("//"))
}

/// Whether `path` is there, seen from the root or from a folder above `text`.
fn exists(text: &Path, path: &str) -> bool {
    text.ancestors().skip(1).any(|folder| Path::new(ROOT).join(folder).join(path).exists())
}

/// What is wrong with the citations of a text.
fn faults(text: &Path) -> Vec<String> {
    let content = fs::read_to_string(Path::new(ROOT).join(text)).expect("a source is text");
    let is_page = text.extension().is_some_and(|ending| ending == "md");
    let beside = Path::new(ROOT).join(text.parent().expect("a folder"));
    let of_line = |(at, line): (usize, &str)| {
        let is_named = |path: &&str| {
            let is_page = path.ends_with(".md") && *path != ".md";
            is_page || FOLDERS.iter().any(|folder| path.starts_with(folder))
        };
        let named = paths(line).filter(is_named).filter(|path| !exists(text, path));
        let links = links(line).filter(|target| is_page && !beside.join(target).exists());
        let place = format!("{}:{}", text.display(), at + 1);
        let lost = named.chain(links).map(|path| format!("{place}: {path} is not there"));
        lost.collect::<Vec<_>>()
    };
    content.lines().enumerate().flat_map(of_line).collect()
}

/// The targets of a page's links that are files: `[words](target)`.
fn links(line: &str) -> impl Iterator<Item = &str> {
    let targets = line.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets
        .filter(|target| !target.contains("://"))
        .map(|target| target.split('#').next().unwrap())
        .filter(|target| !target.is_empty())
}

#[test]
fn every_citation_leads_somewhere() {
    let texts = texts(Path::new(ROOT));
    assert!(texts.contains(&READING.into()), "the walk reaches {READING}");
    let faults: Vec<String> = texts.iter().flat_map(|text| faults(text)).collect();
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// The steps of the recipes in CONTRIBUTING.md, each in one line.
fn steps() -> Vec<String> {
    let page = fs::read_to_string(Path::new(ROOT).join("CONTRIBUTING.md")).expect("the page");
    let recipes = page.split("\n## ").filter(|section| section.starts_with("Add "));
    let is_first = |line: &str| line.starts_with(|c: char| c.is_ascii_digit());
    let mut steps: Vec<String> = Vec::new();
    for line in recipes.flat_map(str::lines) {
        match steps.last_mut() {
            _ if is_first(line) => steps.push(line.into()),
            Some(step) if line.starts_with("   ") => *step += &format!(" {}", line.trim()),
            _ => steps.push(String::new()),
        }
    }
    steps
}

/// Whether a word is a name of Rust: `check`, `Restraint::Fixed`, `in_scalar!`.
fn is_name(word: &str) -> bool {
    let word = word.strip_suffix('!').unwrap_or(word);
    !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || "_:".contains(c))
}

/// What is wrong with the names of a step: each stands behind the file that has it.
fn faults_of_names(step: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let mut file: Option<(&str, String)> = None;
    let mut is_beside = false;
    // Between the marks stand in turn words and what they quote.
    for (k, part) in step.split('`').enumerate() {
        if k % 2 == 0 {
            is_beside &= [", ", ": ", " ("].contains(&part);
        } else if part.contains('/') && part.ends_with(".rs") {
            file = Some((part, fs::read_to_string(Path::new(ROOT).join(part)).expect(part)));
            is_beside = true;
        } else if let (Some((path, text)), true) = (&file, is_name(part)) {
            let name = part.trim_end_matches('!').rsplit("::").next().expect("a part");
            let is_there = words(text).any(|word| word == name);
            if !is_there || is_beside && !defines(text, name) {
                faults.push(format!("{path} has no {part}"));
            }
            is_beside = false;
        } else {
            is_beside = false;
        }
    }
    faults
}

/// Whether a file defines a function, a type, a constant or a macro.
fn defines(text: &str, name: &str) -> bool {
    let kinds = ["fn", "struct", "enum", "trait", "type", "const", "static", "macro_rules"];
    let words: Vec<&str> = words(text).collect();
    words.windows(2).any(|pair| kinds.contains(&pair[0]) && pair[1] == name)
}

#[test]
fn what_a_recipe_names_is_where_it_says() {
    let faults: Vec<String> = steps().iter().flat_map(|step| faults_of_names(step)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_name_that_is_not_in_its_file_is_a_fault() {
    let of = |step: &str| faults_of_names(step).len();
    assert_eq!(of("1. `src/engine/solve.rs`, `check`: where it is refused."), 0);
    assert_eq!(of("1. `src/engine/solve.rs`, `Request`: it is used there, not defined."), 1);
    assert_eq!(of("1. `src/engine/solve.rs`: what a `Request` asks for."), 0);
    assert_eq!(of("1. `src/engine/solve.rs`: what `no_such_function` does."), 1);
}
