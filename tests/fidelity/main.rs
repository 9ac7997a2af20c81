//! What holds the listings, the mirror and the golden files together.

#[path = "../common"]
mod common {
    pub use testing::{
        draws, embedded, golden_file, json, page, random, rows, same_text, tolerances,
    };

    pub mod outcome;
    pub mod program;
    pub mod tools;
}

mod citations;
mod exported;
mod findings;
mod golden;
mod octave;
mod page_interpreter;
mod reading_page;
mod variants;
mod worksheets;
