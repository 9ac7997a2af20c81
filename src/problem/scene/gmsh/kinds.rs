//! The names of Gmsh's elements and geometric entities.

use super::error::{Fault, Result};
use super::tokens::Tokens;
use crate::scene::mesh::{KINDS, Kind};

pub const ENTITIES: [&str; 4] = ["point", "curve", "surface", "volume"];

/// The names of the kinds of element that are not read, by Gmsh's element type; empty where there
/// is none or the kind is read.
#[rustfmt::skip]
const OTHER_KINDS: [&str; 32] = [
    "", "", "", "a four-node quadrangle", "a four-node tetrahedron", "an eight-node hexahedron",
    "a six-node prism", "a five-node pyramid", "a three-node edge", "a six-node triangle",
    "a nine-node quadrangle", "a ten-node tetrahedron", "a 27-node hexahedron",
    "an 18-node prism", "a 14-node pyramid", "", "an eight-node quadrangle",
    "a 20-node hexahedron", "a 15-node prism", "a 13-node pyramid", "a nine-node triangle",
    "a ten-node triangle", "a twelve-node triangle", "a 15-node triangle of fourth order",
    "a 15-node triangle of fifth order", "a 21-node triangle", "a four-node edge",
    "a five-node edge", "a six-node edge", "a 20-node tetrahedron", "a 35-node tetrahedron",
    "a 56-node tetrahedron",
];

/// Returns the kind of `element`, whose type has the number `number` in Gmsh.
///
/// # Errors
/// The kind is not among those that are read.
pub fn kind(tokens: &Tokens, element: usize, number: i32) -> Result<&'static Kind> {
    KINDS.iter().find(|kind| i32::try_from(kind.number) == Ok(number)).ok_or_else(|| {
        let other = usize::try_from(number).ok().and_then(|n| OTHER_KINDS.get(n).copied());
        let kind = match other {
            None | Some("") => format!("of Gmsh's type {number}"),
            Some(name) => name.to_owned(),
        };
        tokens.error(Fault::Kind { element, kind })
    })
}

/// Returns a tag without its sign, which is an orientation in Gmsh.
pub fn magnitude(tag: i32) -> usize {
    tag.unsigned_abs() as usize
}
