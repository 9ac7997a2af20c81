//! The frame of the command line: the arguments that several commands have, and how a command prints.
#![forbid(unsafe_code)]

mod arguments;
mod offered;
mod output;

pub use arguments::*;
pub use offered::*;
pub use output::*;
