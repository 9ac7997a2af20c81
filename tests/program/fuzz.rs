//! The inputs that are kept for each fuzz target, seeds and what once broke an oracle: each is replayed,
//! and so are some inputs that random edits make of them. `PLANE_CONTACT_FUZZ` asks for as many seconds
//! of such inputs a target, other ones each time.

use std::collections::BTreeSet;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use fastrand::Rng;

use crate::oracles::{Hold, TARGETS};

/// The edited inputs a target where no seconds are asked for.
const EDITED: usize = 24;

/// What an edit may put in the place of a number, or between others.
const TOKENS: [&str; 12] = [
    "0",
    "-1",
    "1e308",
    "-1e-308",
    "NaN",
    "1e999",
    "9223372036854775808",
    "{",
    "]",
    "null",
    "\"",
    ":=",
];

fn in_folder(name: &str) -> BTreeSet<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    let entries = std::fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("an entry").path()).collect()
}

/// Returns a target's inputs: its corpus and, where it reads scenes, those of the findings; `scene` begins
/// with those of `tests/cases/hostile.txt` too.
fn inputs(target: &str) -> BTreeSet<PathBuf> {
    let mut inputs = in_folder(&format!("fuzz/corpus/{target}"));
    if ["scene", "solve"].contains(&target) {
        let folders = in_folder("golden/findings").into_iter().filter(|path| path.is_dir());
        inputs.extend(folders.map(|folder| folder.join("scene.json")));
    }
    if target == "scene" {
        let hostile = in_folder("tests/cases/hostile/scenes").into_iter();
        inputs.extend(hostile.filter(|path| path.extension().is_some_and(|end| end == "json")));
    }
    inputs
}

fn replay(target: &str) {
    let (_, hold) = TARGETS.iter().find(|(name, _)| *name == target).expect("a target");
    let inputs = inputs(target);
    assert!(!inputs.is_empty(), "{target} has no corpus");
    let mut corpus = Vec::new();
    for input in inputs {
        println!("{}", input.display());
        corpus.push(std::fs::read(&input).expect("an input"));
        hold(&corpus[corpus.len() - 1]);
    }
    fuzz(target, *hold, &corpus);
}

/// Holds a target to inputs that random edits make of its corpus.
fn fuzz(target: &str, hold: Hold, corpus: &[Vec<u8>]) {
    let seconds = std::env::var("PLANE_CONTACT_FUZZ").ok();
    let seconds = seconds.map(|s| Duration::from_secs(s.parse().expect("a number of seconds")));
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).expect("a time").as_nanos();
    let mut random = Rng::with_seed(if seconds.is_some() { now() as u64 } else { 16 });
    let start = Instant::now();
    let mut count = 0;
    while seconds.map_or(count < EDITED, |seconds| start.elapsed() < seconds) {
        let input = edited(corpus, &mut random);
        count += 1;
        if catch_unwind(|| hold(&input)).is_err() {
            let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("find-{target}"));
            std::fs::write(&kept, input).expect("it is written");
            panic!("{target}: the input {} breaks its oracle", kept.display());
        }
    }
    println!("{target}: {count} edited inputs");
}

/// Returns an input of the corpus after some edits of bytes, pieces and tokens.
fn edited(corpus: &[Vec<u8>], random: &mut Rng) -> Vec<u8> {
    let mut input = random.choice(corpus).expect("an input").clone();
    for _ in 0..random.usize(1..=4) {
        let from = random.usize(..=input.len());
        let to = input.len().min(from + random.usize(..=8));
        let piece = match random.usize(..5) {
            0 => vec![],
            1 => vec![random.u8(..)],
            2 => TOKENS[random.usize(..TOKENS.len())].into(),
            3 => input[from..].iter().take(random.usize(..=64)).copied().collect(),
            _ => {
                let other = random.choice(corpus).expect("an input");
                let first = random.usize(..=other.len());
                other[first..].iter().take(random.usize(..=64)).copied().collect()
            }
        };
        input.splice(from..to, piece);
    }
    input
}

macro_rules! replayed {
    ($($target:ident)+) => {
        $(
            #[test]
            fn $target() {
                replay(stringify!($target));
            }
        )+

        #[test]
        fn every_target_is_replayed() {
            let targets = [$(stringify!($target)),+];
            assert_eq!(TARGETS.map(|(name, _)| name), targets);
            let names = |folder| {
                let stem = |path: PathBuf| path.file_stem().map(|stem| stem.to_owned());
                in_folder(&format!("fuzz/{folder}")).into_iter().filter_map(stem).collect::<Vec<_>>()
            };
            assert_eq!(names("fuzz_targets"), targets);
            assert_eq!(names("corpus"), targets);
        }
    };
}

replayed! { gmsh listing scene solve worksheets }
