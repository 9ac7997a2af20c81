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

#[derive(Clone, Debug, PartialEq, Error)]
#[expect(missing_docs, reason = "the message of each says what its values are")]
pub enum Fault {
    #[error("found {found}, expected {expected}")]
    Unexpected { found: String, expected: String },
    #[error(
        "the file has MSH version {found}; versions 2.2 and 4.1 can be read: in Gmsh set \
         Mesh.MshFileVersion = 4.1 and save the mesh again"
    )]
    Version { found: String },
    #[error("the file has numbers of {found} bytes, expected 8: save the mesh with a 64-bit Gmsh")]
    DataSize { found: i32 },
    #[error(
        "the numbers of this binary file have their most significant byte first: save the mesh \
         again on this machine, or as text (in Gmsh set Mesh.Binary = 0)"
    )]
    BigEndian,
    #[error("the file has no section ${section}")]
    MissingSection { section: &'static str },
    #[error("a second section ${section}, expected one")]
    RepeatedSection { section: String },
    #[error("{what} comes a second time")]
    Repeated { what: String },
    #[error("{declared} {what} are declared but {found} are given")]
    Count { what: &'static str, declared: usize, found: usize },
    #[error("node {node} has the coordinate {value}, expected a finite number")]
    Coordinate { node: usize, value: f64 },
    #[error(
        "element {element} is {kind} ({entity}); only points, two-node edges and three-node triangles \
         can be read: in Gmsh take out Recombine Surface, set Mesh.RecombineAll = 0, \
         Mesh.SubdivisionAlgorithm = 0 and Mesh.ElementOrder = 1, and mesh again in two dimensions (-2)"
    )]
    Kind { element: usize, kind: String, entity: String },
    #[error(
        "element {element} has dimension {found}, but it is listed in an entity of dimension \
         {expected}"
    )]
    Dimension { element: usize, found: usize, expected: usize },
    #[error("element {element} has the node {node}, which is not in $Nodes")]
    NoNode { element: usize, node: usize },
    #[error(
        "the elements are part of the {kind} {tag}, which is not in $Entities; if the mesh is \
         partitioned, save it unpartitioned"
    )]
    NoEntity { kind: &'static str, tag: i32 },
}

/// The result of reading: a value, or the first fault.
pub(super) type Result<T, E = GmshError> = std::result::Result<T, E>;
