//! What a user sees: commands, scene files, mesh files, the plan of a run, speed against accuracy.

#[path = "../common"]
mod common {
    pub mod embedded;
    pub mod golden;
    pub mod json;
    pub mod program;
    pub mod random;
    pub mod tolerances;
}

mod cli;
mod drawing;
mod examples;
mod factors;
mod gmsh;
mod pictures;
mod plan;
mod printed_numbers;
mod readme;
mod result_file;
mod scene_builder;
mod scenes;
mod texts;
mod trade;
mod undefined;
mod xml;
