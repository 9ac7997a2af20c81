//! What became of mutants in earlier runs, function by function: as long as its text is the same, a
//! mutant that was noticed is not graded again, so that a run of hours can be made in parts, on several
//! machines.
//!
//! A file of JSON: file, function and the hash of its text, and a letter for each of its mutants in the
//! build, in order. It does not see that a test was weakened since: delete it to begin anew.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::path::{Path, PathBuf};

use crate::grade::{self, Graded, Outcome};
use crate::mutant::{Mutant, State};
use crate::tests::append;
use crate::{Failure, Work};

/// The letter of each outcome, and of a mutant that has none.
const LETTERS: [(char, Outcome); 5] = [
    ('c', Outcome::Caught),
    ('t', Outcome::Timeout),
    ('m', Outcome::Missed),
    ('u', Outcome::Unreached),
    ('o', Outcome::Open),
];
const UNGRADED: char = '-';

/// Letters by file, and by function and hash.
type Kept = BTreeMap<String, BTreeMap<String, String>>;

/// Takes the mutants that a test noticed for results; a test may have been added for every other one.
pub fn take(work: &Work, kept: &Path) -> Result<(), Failure> {
    let kept = read(kept)?;
    let known = by_name(work)?;
    let mut results = OpenOptions::new().create(true).append(true).open(work.results())?;
    for ((file, function), mutants) in by_function(work)? {
        let letters = kept.get(&file).and_then(|functions| functions.get(&function));
        let letters = letters.filter(|letters| letters.len() == mutants.len());
        for (letter, mutant) in letters.into_iter().flat_map(|l| l.chars()).zip(&mutants) {
            let is_noticed = |o: &Outcome| matches!(o, Outcome::Caught | Outcome::Timeout);
            let outcome = LETTERS.iter().find(|(other, o)| *other == letter && is_noticed(o));
            if let (Some((_, outcome)), false) = (outcome, known.contains_key(&mutant.name)) {
                append(&mut results, &Graded::earlier(&mutant.name, *outcome))?;
            }
        }
    }
    Ok(())
}

/// Keeps the results: those of the functions of today, in place of what was kept before.
pub fn keep(work: &Work, path: &Path) -> Result<(), Failure> {
    let known = by_name(work)?;
    let mut kept = Kept::new();
    for ((file, function), mutants) in by_function(work)? {
        let letter = |mutant: &Mutant| {
            let outcome = known.get(&mutant.name);
            let named = LETTERS.iter().find(|(_, other)| Some(other) == outcome);
            named.map_or(UNGRADED, |(letter, _)| *letter)
        };
        let letters: String = mutants.iter().map(letter).collect();
        if letters.chars().any(|letter| letter != UNGRADED) {
            kept.entry(file).or_default().insert(function, letters);
        }
    }
    fs::write(path, serde_json::to_string_pretty(&kept)? + "\n")?;
    Ok(())
}

fn read(path: &Path) -> Result<Kept, Failure> {
    match path.exists() {
        true => Ok(serde_json::from_str(&fs::read_to_string(path)?)?),
        false => Ok(Kept::new()),
    }
}

fn by_name(work: &Work) -> Result<BTreeMap<String, Outcome>, Failure> {
    Ok(grade::read(work)?.into_iter().map(|graded| (graded.name, graded.outcome)).collect())
}

/// Returns the mutants of the build by file and function; those outside every function by their line.
fn by_function(work: &Work) -> Result<BTreeMap<(String, String), Vec<Mutant>>, Failure> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mutants: Vec<Mutant> = serde_json::from_str(&fs::read_to_string(work.mutants())?)?;
    let mut texts: BTreeMap<String, String> = BTreeMap::new();
    let mut found: BTreeMap<_, Vec<Mutant>> = BTreeMap::new();
    for mutant in mutants.into_iter().filter(|mutant| mutant.state == State::Built) {
        if !texts.contains_key(&mutant.file) {
            texts.insert(mutant.file.clone(), fs::read_to_string(root.join(&mutant.file))?);
        }
        let lines: Vec<&str> = texts[&mutant.file].lines().collect();
        let (name, span) = match &mutant.function {
            Some(function) => (function.function_name.as_str(), function.span),
            None => ("", mutant.span),
        };
        let text = lines[span.start.line - 1..span.end.line].join("\n");
        let key = format!("{name} {:016x}", hash(text.as_bytes()));
        found.entry((mutant.file.clone(), key)).or_default().push(mutant);
    }
    Ok(found)
}

/// Returns the hash of Fowler, Noll and Vo, 1a, 64 bits.
fn hash(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}
