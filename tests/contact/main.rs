//! Contact: the reference solution, the status rules, and CalculiX beside them.

#[path = "../common"]
mod common {
    pub use testing::{annulus, draws, embedded, json, tolerances};

    pub mod golden;
    pub mod golden_floats;
    pub mod outcome;
    pub mod program;
    pub mod recorded;
    pub mod tools;
}

mod calculix;
mod calculix_files;
mod corners;
mod corrected;
mod faced;
mod facing;
mod friction;
mod hard;
mod invariance;
mod limits;
mod orders;
mod page_iterations;
mod quadratic_programme;
mod reduced;
mod searched;
mod status;
mod unilateral;
