//! What must hold of any input, door by door: a function of bytes for each fuzz target, which panics
//! where it does not hold. `fuzz_targets/` gives it what libFuzzer makes up, and
//! `tests/program/fuzz.rs` the inputs that are kept in `corpus/`.
#![forbid(unsafe_code)]

mod drawn;
pub mod gmsh;
pub mod listing;
pub mod scene;
pub mod solve;
pub mod sound;
pub mod worksheets;

/// What a target does with an input.
pub type Hold = fn(&[u8]);

/// The targets by name.
pub const TARGETS: [(&str, Hold); 5] = [
    ("gmsh", gmsh::hold),
    ("listing", listing::hold),
    ("scene", scene::hold),
    ("solve", solve::hold),
    ("worksheets", worksheets::hold),
];
