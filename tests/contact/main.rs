//! Contact: the reference solution, the status rules, and CalculiX beside them.

#[path = "../common"]
mod common {
    pub use testing::{annulus, golden_file, rows, same_text, tolerances};

    pub mod letter;
    pub mod outcome;
    pub mod program;
    pub mod tools;
}

mod calculix;
mod calculix_files;
mod corrected;
mod page_iterations;
mod scenes;
mod unilateral;
