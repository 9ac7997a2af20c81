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

mod error;
mod kinds;
mod msh2;
mod msh4;
mod reader;
mod tokens;
mod write;

pub use error::{Fault, GmshError, Place};
pub use reader::read;
pub use write::write;
