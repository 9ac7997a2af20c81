//! The kinds of element: those that a mesh may have, and those that Gmsh writes too.

pub struct Kind {
    pub number: usize,
    pub dim: usize,
    pub nodes: usize,
}

/// The kinds of element that a mesh may have, by dimension: points, edges, triangles.
pub const KINDS: [Kind; 3] = [
    Kind { number: 15, dim: 0, nodes: 1 },
    Kind { number: 1, dim: 1, nodes: 2 },
    Kind { number: 2, dim: 2, nodes: 3 },
];

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

/// A kind of element that is not read.
pub struct OtherKind {
    /// Its name, or its number in Gmsh.
    pub name: String,
    /// The dimension of its entity.
    pub dim: usize,
}

impl OtherKind {
    /// Returns the kind with Gmsh's number `number`, which is not among [`KINDS`].
    pub fn new(number: i32) -> Self {
        let known = usize::try_from(number).ok().and_then(|n| OTHER_KINDS.get(n).copied());
        let name = match known {
            None | Some("") => format!("of Gmsh's type {number}"),
            Some(name) => name.to_owned(),
        };
        let dim = ["point", "edge", "angle"].iter().position(|word| name.contains(word));
        OtherKind { name, dim: dim.unwrap_or(3) }
    }

    /// Says what to change in Gmsh for elements that are read; `surface` is the tag of the entity.
    pub fn remedy(&self, surface: usize) -> String {
        let straight = "set Mesh.ElementOrder = 1";
        let triangles = format!(
            "take out Recombine Surface {{{surface}}}, set Mesh.RecombineAll = 0 and Mesh.SubdivisionAlgorithm = 0"
        );
        let is = |word| self.name.contains(word);
        match self.dim {
            1 => straight.into(),
            2 if is(" triangle") => straight.into(),
            2 if is("four-node") => triangles,
            2 => format!("{triangles}, {straight}"),
            _ if is("of Gmsh's type") => format!("{triangles}, {straight}"),
            _ => "mesh surfaces, not volumes".into(),
        }
    }
}
