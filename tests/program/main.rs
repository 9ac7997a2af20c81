//! What a user sees: commands, scene files, mesh files, the plan of a run, speed against accuracy.

#[path = "../common"]
mod common {
    pub use testing::{
        annulus, embedded, golden_file, json, page, random, rows, same_text, tolerances,
    };

    pub mod conforming;
    pub mod program;
    pub mod tools;
}

mod accuracy;
mod claims;
mod document;
mod drawing;
mod examples;
mod extremes;
mod faults;
mod first_difference;
mod fuzz;
mod gmsh;
mod mathcad;
mod messages;
#[path = "../../fuzz/oracles/mod.rs"]
mod oracles;
mod pages;
mod pictures;
mod plan;
mod printed;
mod printed_numbers;
mod prose;
mod result_file;
mod scenes;
mod snapshots;
mod statuses;
mod sweeps;
mod tables;
mod texts;
mod trade;
mod undefined;
mod xml;
