//! Scalars, solvers, the triangle, and the error estimates of what they compute.

#[path = "../common"]
mod common {
    pub use testing::{embedded, json, random, tolerances};

    pub mod golden;
    pub mod outcome;
    pub mod shipped;
}

mod accuracy;
mod decisions;
mod discretisation;
mod error_estimates;
mod extremes;
mod perturbed;
mod precisions;
mod solvers;
mod stiffness;
mod systems;
