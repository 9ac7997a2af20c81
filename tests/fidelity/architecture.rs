//! The parts of the workspace: each uses those before it.

use std::path::Path;

/// The parts of the workspace, each of which uses those before it only.
const PARTS: [&str; 9] =
    ["base", "numbers", "mathcad", "problem", "paper", "engine", "output", "commands", "studies"];

fn manifest(part: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(part).join("Cargo.toml");
    std::fs::read_to_string(path).expect("a part has a manifest")
}

/// The reference and what it rests on build without the engine.
#[test]
fn each_part_uses_those_before_it() {
    let mut uses = 0;
    for (place, part) in PARTS.iter().enumerate() {
        let manifest = manifest(part);
        // What its tests use besides stands below.
        let of_library = manifest.split("[dev-dependencies]").next().expect("a first part");
        let names = of_library.lines().filter_map(|line| line.split(['.', ' ']).next());
        for used in names.filter(|name| PARTS.contains(name)) {
            uses += 1;
            assert!(PARTS[..place].contains(&used), "{part} uses {used}");
        }
    }
    assert!(uses > 30, "the manifests name {uses} parts");
}
