//! What holds the listings, the mirror and the golden files together.

#[path = "../common"]
mod common {
    pub mod draws;
    pub mod embedded;
    pub mod golden;
    pub mod golden_file;
    pub mod golden_floats;
    pub mod json;
    pub mod outcome;
    pub mod program;
    pub mod random;
    pub mod tolerances;
    pub mod tools;
}

mod architecture;
mod bitwise;
mod citations;
mod findings;
mod golden;
mod listing_quotes;
mod mathcad;
mod octave;
mod page_interpreter;
mod reading_page;
mod variants;
