//! The inputs that are kept for each fuzz target, seeds and what once broke an oracle, replayed.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::oracles::TARGETS;

fn in_folder(name: &str) -> BTreeSet<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz").join(name);
    let entries = std::fs::read_dir(folder).expect("a folder of fuzz");
    entries.map(|entry| entry.expect("an entry").path()).collect()
}

fn replay(target: &str) {
    let (_, hold) = TARGETS.iter().find(|(name, _)| *name == target).expect("a target");
    let inputs = in_folder(&format!("corpus/{target}"));
    assert!(!inputs.is_empty(), "{target} has no corpus");
    for input in inputs {
        println!("{}", input.display());
        hold(&std::fs::read(&input).expect("an input"));
    }
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
                in_folder(folder).into_iter().filter_map(stem).collect::<Vec<_>>()
            };
            assert_eq!(names("fuzz_targets"), targets);
            assert_eq!(names("corpus"), targets);
        }
    };
}

replayed! { documents gmsh listing options results scene solve worksheets }
