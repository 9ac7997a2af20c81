//! What every part of the program uses: errors of the input, files, closed sets of choices, and words.
#![forbid(unsafe_code)]

#[cfg(feature = "files")]
pub mod child;
pub mod choices;
pub mod error;
pub mod exit;
#[cfg(feature = "files")]
pub mod files;
pub mod limits;
pub mod plain;
pub mod suggestion;
pub mod xml;
