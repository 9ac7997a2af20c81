//! The mesh: nodes, elements and physical groups, from any source.
//!
//! ```text
//!  strand.msh ---gmsh::read---+
//!  node, elem ---from_tables--+--> Mesh --check--> what the scene is built on
//!  code -------MeshBuilder----+
//! ```

mod builder;
mod check;
mod gmsh;
mod kinds;
mod tables;

pub use builder::MeshBuilder;
pub use kinds::{KINDS, Kind, OtherKind};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

use crate::element::Corners;
use crate::model::NodeId;

/// Nodes and elements in ascending order of number. As a document, of which the SHA-256 is taken, it
/// is rows of numbers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// The named physical groups: dimension, tag, name.
    #[serde(rename = "groups")]
    #[schemars(with = "Vec<(usize, usize, String)>")]
    pub names: Vec<PhysicalName>,
    /// The nodes: number, x, y, z.
    #[schemars(with = "Vec<(usize, f64, f64, f64)>")]
    pub nodes: Vec<Node>,
    /// The points, edges and triangles: number, type, physical tags, geometric tag, nodes. A point or
    /// an edge of two physical groups occurs twice in a Gmsh file of version 2.2, under two numbers, and
    /// once, with two tags, in one of version 4.1.
    #[schemars(with = "Vec<(usize, usize, Vec<usize>, usize, Vec<usize>)>")]
    pub elements: Vec<Element>,
    /// What a Gmsh file has in another form, in sentences for people.
    #[serde(skip)]
    pub adapted: Vec<String>,
    /// The numbers of the nodes in a file that has gaps; else empty.
    #[serde(skip)]
    pub in_file: Vec<usize>,
}

/// A node of the mesh file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "(usize, f64, f64, f64)", into = "(usize, f64, f64, f64)")]
pub struct Node {
    /// Its number in the file.
    pub number: usize,
    /// The coordinates x, y, z, length.
    pub xyz: [f64; 3],
}

/// An element of the mesh: a point, an edge or a triangle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "ElementRow", into = "ElementRow")]
pub struct Element {
    /// The number of the element: its row in `elem`.
    pub number: usize,
    /// The element type of Gmsh: 15 point, 1 edge, 2 triangle.
    pub kind: usize,
    /// The tags of the physical groups to which it belongs, ascending.
    pub physical: Tags,
    /// The tag of the geometric entity to which it belongs.
    pub geometric: usize,
    /// The numbers of its nodes, in the file's order.
    pub nodes: NodeNumbers,
}

impl Element {
    /// Returns its dimension: 0 point, 1 edge, 2 triangle.
    pub fn dim(&self) -> usize {
        self.nodes.len() - 1
    }

    /// Returns its nodes, of which it has `N`.
    pub fn ids<const N: usize>(&self) -> [NodeId; N] {
        std::array::from_fn(|k| NodeId::from_number(self.nodes[k]))
    }
}

/// The tags of physical groups, of most elements one.
pub type Tags = SmallVec<[usize; 1]>;

/// The numbers of the nodes of an element.
pub type NodeNumbers = SmallVec<[usize; 3]>;

/// The name of a physical group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "(usize, usize, String)", into = "(usize, usize, String)")]
pub struct PhysicalName {
    /// The dimension of the group's elements: 0 points, 1 edges, 2 triangles. Tags of different
    /// dimensions are independent.
    pub dim: usize,
    /// The group's tag.
    pub tag: usize,
    /// The group's name.
    pub name: String,
}

/// A row of the element table.
type ElementRow = (usize, usize, Tags, usize, NodeNumbers);

/// Writes a record as a row of its fields, and reads it so.
macro_rules! row {
    ($record:ident $fields:tt = $row:tt: $types:ty) => {
        impl From<$types> for $record {
            fn from($row: $types) -> Self {
                $record $fields
            }
        }

        impl From<$record> for $types {
            fn from($record $fields: $record) -> Self {
                $row
            }
        }
    };
}

row!(Node { number, xyz: [x, y, z] } = (number, x, y, z): (usize, f64, f64, f64));
row!(Element { number, kind, physical, geometric, nodes } = (number, kind, physical, geometric, nodes): ElementRow);
row!(PhysicalName { dim, tag, name } = (dim, tag, name): (usize, usize, String));

/// The geometric entities of Gmsh, by dimension.
pub const ENTITIES: [&str; 4] = ["point", "curve", "surface", "volume"];

impl Mesh {
    /// Returns the elements of a dimension: 0 points, 1 edges, 2 triangles.
    pub fn of_dimension(&self, dim: usize) -> impl Iterator<Item = &Element> {
        self.elements.iter().filter(move |e| e.kind == KINDS[dim].number)
    }

    /// Returns the coordinates of node `n` in the plane, length.
    pub fn xy(&self, n: usize) -> [f64; 2] {
        let [x, y, _] = self.nodes[n - 1].xyz;
        [x, y]
    }

    /// Returns the coordinates of the corners of a triangle, length.
    pub fn corners(&self, triangle: &Element) -> Corners<f64> {
        [0, 1, 2].map(|k| self.xy(triangle.nodes[k]))
    }

    /// Returns the name of a physical group; None where it has none.
    pub(in crate::scene) fn name(&self, dim: usize, tag: usize) -> Option<&str> {
        let name = self.names.iter().find(|name| name.dim == dim && name.tag == tag);
        name.map(|name| &*name.name)
    }

    /// Names the geometric entity of an element and its physical groups, as in `surface 2, "punch"`.
    pub(in crate::scene) fn whereabouts(&self, element: &Element) -> String {
        let dim = element.dim();
        let group = |tag: &usize| match self.name(dim, *tag) {
            Some(name) => format!(", {name:?}"),
            None => format!(", group {tag}"),
        };
        let groups: String = element.physical.iter().map(group).collect();
        format!("{} {}{groups}", ENTITIES[dim], element.geometric)
    }

    /// Names nodes, at most ten: where the numbers of the mesh file have gaps, by the file's and in
    /// brackets by those here.
    pub(in crate::scene) fn named(&self, nodes: &[usize]) -> String {
        let name = |n: &usize| match self.in_file.get(n.wrapping_sub(1)) {
            Some(file) if file != n => format!("{file} ({n} here)"),
            _ => n.to_string(),
        };
        let shown: Vec<String> = nodes.iter().take(10).map(name).collect();
        let more = nodes.len().saturating_sub(10);
        let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
        shown.join(", ") + &rest
    }

    /// Returns the nodes that belong to no triangle, ascending.
    pub fn orphans(&self) -> Vec<usize> {
        let mut used = vec![false; self.nodes.len()];
        for n in self.of_dimension(2).flat_map(|t| &t.nodes) {
            used[n - 1] = true;
        }
        (1..=used.len()).filter(|n| !used[n - 1]).collect()
    }
}
