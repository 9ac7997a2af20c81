//! Scalars, solvers, the triangle, and the error estimates of what they compute.

#[path = "../common"]
mod common {
    pub mod annulus;
    pub mod embedded;
    pub mod golden;
    pub mod json;
    pub mod outcome;
    pub mod random;
    pub mod shipped;
    pub mod tolerances;
}

mod accuracy;
mod arithmetic;
mod decisions;
mod discretisation;
mod element;
mod error_estimates;
mod extremes;
mod largest;
mod perturbed;
mod precisions;
mod scalars;
mod solvers;
mod systems;
