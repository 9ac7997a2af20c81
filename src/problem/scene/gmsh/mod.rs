//! Meshes as files of Gmsh: reads MSH 2.2 and 4.1, text or binary, and writes MSH 2.2 as text.
//!
//! ```text
//! $...               sections of other programs are skipped
//! $MeshFormat        version, text or binary, bytes of a number
//! $PhysicalNames     dimension, tag, "name"                          always text
//! $Entities          4.1: point, curve, ... with its physical tags
//! $Nodes             number, x, y, z
//! $Elements          number, kind, tags, node numbers
//! $...               any other section is skipped
//! ```
//!
//! A grammar is written once for text and binary: `Tokens` reads both as the same sequence of
//! numbers. No memory is asked for by a count that the file declares: a wrong one leads to the end of
//! the file.
//!
//! Reference: Gmsh's manual, "MSH file format" and "MSH file format version 2 (Legacy)".

mod reader;
mod tokens;
mod write;

pub use reader::read;
pub use write::write;

/// The reason why a file cannot be read, and its place.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{place}: {what}")]
pub struct GmshError {
    /// The line of a text file, from 1, or the byte of a binary one, from 0.
    pub place: String,
    /// What is wrong there.
    pub what: String,
    /// What should stand there, where another word or number does.
    pub expected: Option<String>,
}

/// The result of reading: a value, or the first fault.
type Result<T, E = GmshError> = std::result::Result<T, E>;
