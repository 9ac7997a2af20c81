//! What a user sees: commands, scene files, mesh files, the plan of a run, speed against accuracy.

#[path = "../common"]
mod common {
    pub mod embedded;
    pub mod golden;
    pub mod json;
    pub mod program;
    pub mod tolerances;
}

mod cli;
mod examples;
mod factors;
mod gmsh;
mod pictures;
mod plan;
mod readme;
mod scenes;
mod texts;
mod trade;
