//! Scalars, solvers, the triangle, and the error bars of what they compute.

#[path = "../common"]
mod common {
    pub mod embedded;
    pub mod golden;
    pub mod json;
    pub mod outcome;
    pub mod shipped;
    pub mod tolerances;
}

mod arithmetic;
mod discretisation;
mod element;
mod error_bars;
mod extremes;
mod ladder;
mod scalars;
mod tolerances;
