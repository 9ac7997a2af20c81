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

/// A text of the repository: its path from the root, with `/`, and its content.
struct Text {
    path: String,
    content: String,
}

impl Text {
    fn is_page(&self) -> bool {
        self.path.ends_with(".md")
    }

    /// `path:line`, for the words of a failure.
    fn place(&self, line: usize) -> String {
        format!("{}:{}", self.path, line + 1)
    }
}

/// Every `.rs` and `.md` file but this one, whose examples name what is not there.
fn texts() -> Vec<Text> {
    let mut found = Vec::new();
    walk(Path::new(ROOT), &mut found);
    let this = Path::new(file!()).file_name().expect("a source file has a name");
    let mut texts: Vec<Text> = found
        .into_iter()
        .filter(|path| path.file_name() != Some(this))
        .map(|path| {
            let content = fs::read_to_string(&path).expect("a source is text");
            let path = path.strip_prefix(ROOT).expect("within the repository");
            Text { path: path.to_string_lossy().replace('\\', "/"), content }
        })
        .collect();
    texts.sort_by(|a, b| a.path.cmp(&b.path));
    texts
}

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of the repository") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // What a package links to stands elsewhere too.
        if path.is_symlink() || SKIPPED.contains(&name.as_str()) {
            continue;
        } else if path.is_dir() {
            walk(&path, found);
        } else if name.ends_with(".rs") || name.ends_with(".md") {
            found.push(path);
        }
    }
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
fn exists(text: &Text, path: &str) -> bool {
    let from = Path::new(ROOT).join(&text.path);
    from.ancestors().skip(1).any(|folder| folder.starts_with(ROOT) && folder.join(path).exists())
}

/// What is wrong with the citations of `text`.
fn faults(text: &Text) -> Vec<String> {
    let mut faults = Vec::new();
    for (at, line) in text.content.lines().enumerate() {
        let mut fault = |what: String| faults.push(format!("{}: {what}", text.place(at)));
        for path in paths(line) {
            let named = path.ends_with(".md") && path != ".md"
                || FOLDERS.iter().any(|folder| path.starts_with(folder));
            if named && !exists(text, path) {
                fault(format!("names {path}, which is not there"));
            }
        }
        if text.is_page() {
            for target in links(line) {
                let from = Path::new(ROOT).join(&text.path);
                if !from.parent().unwrap().join(target).exists() {
                    fault(format!("links to {target}, which is not there"));
                }
            }
        }
    }
    faults
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
    let texts = texts();
    assert!(texts.iter().any(|text| text.path == READING), "the walk reaches {READING}");
    let faults: Vec<String> = texts.iter().flat_map(faults).collect();
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
