//! The faults of a Gmsh file, and their places.

use std::fmt;

use thiserror::Error;

/// The reason why a file cannot be read, and its place.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{place}: {fault}")]
pub struct GmshError {
    /// The place where the fault was found.
    pub place: Place,
    /// What is wrong there.
    pub fault: Fault,
}

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The number of a line of a text file, from 1.
    Line(usize),
    /// The number of a byte of a binary file, from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line(line) => write!(f, "line {line}"),
            Place::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// What is wrong in a file.
#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the message of each says what its values are")]
pub enum Fault {
    #[error("found {found}, expected {expected}")]
    Unexpected { found: String, expected: String },
    #[error("{0}")]
    Other(String),
}

/// The result of reading: a value, or the first fault.
pub(super) type Result<T, E = GmshError> = std::result::Result<T, E>;
