//! What a user sees: commands, scene files, mesh files, the plan of a run, speed against accuracy.

#[path = "../common"]
mod common {
    pub mod annulus;
    pub mod conforming;
    pub mod embedded;
    pub mod golden;
    pub mod golden_file;
    pub mod json;
    pub mod program;
    pub mod random;
    pub mod tolerances;
    pub mod tools;
}

mod cases;
mod claims;
mod cli;
mod conclusion;
mod document;
mod drawing;
mod edited;
mod examples;
mod faults;
mod first_difference;
mod fuzz;
mod gmsh;
mod hostile;
mod limits;
mod mathcad;
mod messages;
mod mistakes;
mod models;
#[path = "../../fuzz/oracles/mod.rs"]
mod oracles;
mod pages;
mod pictures;
mod plan;
mod printed;
mod printed_numbers;
mod prose;
mod quantities;
mod result_file;
mod scene_builder;
mod scenes;
mod schema;
mod snapshots;
mod statuses;
mod sweeps;
mod tables;
mod texts;
mod trade;
mod undefined;
mod xml;
