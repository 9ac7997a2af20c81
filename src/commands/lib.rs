//! The frame of the command line: the arguments that several commands have, how a command prints, and the
//! process in which it runs.
#![forbid(unsafe_code)]

mod arguments;
mod group;
mod offered;
mod printing;
pub mod process;
pub mod shells;
mod usage;

pub use arguments::*;
pub use offered::*;
pub use printing::*;
pub use usage::report_usage;
