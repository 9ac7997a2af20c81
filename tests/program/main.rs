//! What a user sees: commands, scene files, mesh files, the plan of a run, speed against accuracy.

#[path = "../common"]
mod common {
    pub mod embedded;
    pub mod json;
    pub mod tolerances;
}

mod cli;
mod factors;
mod gmsh;
mod plan;
mod scenes;
mod trade;
