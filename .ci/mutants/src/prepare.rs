//! A copy of the tree in which every mutant is, and the compiler's word on which of them compile.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::mutant::{Mutant, State};
use crate::render::{Owner, Page, owner};
use crate::sites::{self, Site};
use crate::{Failure, Work};

/// The compiler's rounds after which it does not come to an end.
const ROUNDS: usize = 30;

/// A file of the tree, whose mutants are found.
struct Source {
    text: String,
    sites: Vec<Site>,
}

/// Rewrites the copy of the tree for the mutants of `list`, and leaves out those that do not
/// compile.
pub fn prepare(work: &Work, list: &Path) -> Result<(), Failure> {
    let mut mutants: Vec<Mutant> = serde_json::from_str(&fs::read_to_string(list)?)?;
    let sources = read(work, &mut mutants)?;
    add_runtime(work)?;
    let mut dead: BTreeSet<usize> =
        mutants.iter().filter(|m| m.state != State::Built).map(|m| m.id).collect();
    for round in 1..=ROUNDS {
        for (file, source) in &sources {
            let page =
                Page { text: &source.text, sites: &source.sites, mutants: &mutants, dead: &dead };
            fs::write(work.tree().join(file), page.render())?;
        }
        let errors = errors(work)?;
        if errors.is_empty() {
            fs::write(work.mutants(), serde_json::to_string_pretty(&mutants)?)?;
            return Ok(());
        }
        let before = dead.len();
        for error in &errors {
            bury(work, error, &sources, &mut mutants, &mut dead)?;
        }
        eprintln!(
            "round {round}: {} errors, {} mutants left out",
            errors.len(),
            dead.len() - before
        );
        if dead.len() == before {
            return Err(format!("no mutant is to blame for: {}", errors[0]["rendered"]).into());
        }
    }
    Err("the compiler finds ever new errors".into())
}

/// Finds the mutants in the files; those that have no place there are marked.
fn read(work: &Work, mutants: &mut [Mutant]) -> Result<BTreeMap<String, Source>, Failure> {
    for (id, mutant) in mutants.iter_mut().enumerate() {
        mutant.id = id;
        mutant.first = id;
        mutant.state = State::Inexpressible("its place is not found".to_owned());
    }
    let files: BTreeSet<String> = mutants.iter().map(|m| m.file.clone()).collect();
    let mut sources = BTreeMap::new();
    for file in files {
        let text = fs::read_to_string(work.tree().join(&file))?;
        let wanted: Vec<&Mutant> = mutants.iter().filter(|m| m.file == file).collect();
        let found = sites::find(&text, &wanted)?;
        let lines: Vec<&str> = text.lines().collect();
        for mutant in mutants.iter_mut().filter(|m| m.file == file) {
            mutant.text = lines[mutant.span.start.line - 1].trim().to_owned();
        }
        for site in &found.sites {
            for mutant in &mut mutants[site.first..site.first + site.count] {
                mutant.first = site.first;
                mutant.state = State::Built;
            }
        }
        found.constant.iter().for_each(|id| mutants[*id].state = State::Constant);
        found.unviable.iter().for_each(|id| mutants[*id].state = State::Unviable);
        sources.insert(file, Source { text, sites: found.sites });
    }
    Ok(sources)
}

/// The parts of the workspace that are mutated: all of them use `base`, which has the runtime.
const PARTS: [&str; 5] = ["numbers", "mathcad", "problem", "paper", "engine"];

fn add_runtime(work: &Work) -> Result<(), Failure> {
    let src = work.tree().join("src");
    fs::write(src.join("base/mutants.rs"), include_str!("runtime.rs"))?;
    add(&src.join("base/lib.rs"), "pub mod mutants;")?;
    for part in PARTS {
        add(&src.join(part).join("lib.rs"), "mod mutants {\n    pub use ::base::mutants::*;\n}")?;
    }
    Ok(())
}

/// Adds items to a library, whose code may then be what no one writes.
fn add(library: &Path, items: &str) -> Result<(), Failure> {
    let text = fs::read_to_string(library)?;
    let allowed = "#![allow(warnings, arithmetic_overflow, unconditional_panic)]\n";
    let at = text.find("#![forbid").ok_or("lib.rs forbids nothing")?;
    fs::write(library, format!("{}{allowed}{}\n{items}\n", &text[..at], &text[at..]))?;
    Ok(())
}

/// Returns the errors of the compiler.
fn errors(work: &Work) -> Result<Vec<Value>, Failure> {
    let output = Command::new("cargo")
        .args(["check", "--workspace", "--lib", "--locked", "--message-format=json"])
        .current_dir(work.tree())
        .env("CARGO_TARGET_DIR", work.target())
        .output()?;
    let text = String::from_utf8(output.stdout)?;
    let messages = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let errors: Vec<Value> = messages
        .filter(|value| value["reason"] == "compiler-message")
        .map(|mut value| value["message"].take())
        .filter(|message| message["level"] == "error" && has_place(message))
        .collect();
    if errors.is_empty() && !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
    }
    Ok(errors)
}

fn spans(message: &Value) -> &[Value] {
    message["spans"].as_array().map_or(&[], Vec::as_slice)
}

fn name(span: &Value) -> &str {
    span["file_name"].as_str().unwrap_or_default()
}

fn has_place(message: &Value) -> bool {
    !spans(message).is_empty()
}

/// Leaves out what an error is about: a mutant, or all mutants of the place whose rewriting fails.
fn bury(
    work: &Work,
    error: &Value,
    sources: &BTreeMap<String, Source>,
    mutants: &mut [Mutant],
    dead: &mut BTreeSet<usize>,
) -> Result<(), Failure> {
    let of = |primary: bool| spans(error).iter().filter(move |s| s["is_primary"] == primary);
    for mut span in of(true).chain(of(false)) {
        // What a macro wrote is where the macro is called.
        while span["expansion"].is_object() && !sources.contains_key(name(span)) {
            span = &span["expansion"]["span"];
        }
        let file = name(span);
        let Some(source) = sources.get(file) else { continue };
        let text = fs::read_to_string(work.tree().join(file))?;
        let offset = span["byte_start"].as_u64().unwrap_or_default() as usize;
        match owner(&text, offset) {
            None => continue,
            Some(Owner::Mutant(id)) => {
                dead.insert(id);
                mutants[id].state = State::Unviable;
            }
            Some(Owner::Site(first)) => {
                let site = source.sites.iter().find(|site| site.first == first);
                let count = site.map_or(1, |site| site.count);
                let code = error["code"]["code"].as_str().unwrap_or_default();
                let why = format!("{code} {}", error["message"].as_str().unwrap_or_default());
                for mutant in &mut mutants[first..first + count] {
                    if dead.insert(mutant.id) {
                        mutant.state = State::Inexpressible(why.clone());
                    }
                }
            }
        }
        return Ok(());
    }
    Ok(())
}
