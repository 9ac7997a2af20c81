//! The names of Gmsh's elements.

use super::error::Result;
use super::reader::Reader;
use crate::scene::mesh::{ENTITIES, KINDS, Kind};

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

impl Reader<'_> {
    /// Returns the kind of an element, whose type has the number `number` in Gmsh; `physical` and
    /// `geometric` are its tags.
    ///
    /// # Errors
    /// The kind is not among those that are read.
    pub fn kind(
        &self,
        element: usize,
        number: i32,
        (physical, geometric): (&[usize], usize),
    ) -> Result<&'static Kind> {
        KINDS.iter().find(|kind| i32::try_from(kind.number) == Ok(number)).ok_or_else(|| {
            let other = usize::try_from(number).ok().and_then(|n| OTHER_KINDS.get(n).copied());
            let kind = match other {
                None | Some("") => format!("of Gmsh's type {number}"),
                Some(name) => name.to_owned(),
            };
            let dim = ["point", "edge", "angle"].iter().position(|word| kind.contains(word));
            let dim = dim.unwrap_or(3);
            let names = physical.iter().filter_map(|tag| self.names.get(&(dim, *tag)));
            let names: String = names.map(|name| format!(", {name:?}")).collect();
            let recombined = if dim == 2 { format!(" {{{geometric}}}") } else { String::new() };
            let entity = format!("{} {geometric}{names}", ENTITIES[dim]);
            self.tokens.refused(format!(
                "element {element} is {kind} ({entity}); only points, two-node edges and three-node \
                 triangles can be read: in Gmsh take out Recombine Surface{recombined}, set Mesh.RecombineAll = 0, \
                 Mesh.SubdivisionAlgorithm = 0 and Mesh.ElementOrder = 1, and mesh again in two \
                 dimensions (-2)"
            ))
        })
    }
}
