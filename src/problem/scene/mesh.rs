//! The mesh: the paper's `node` and `elem` tables before they become arrays.

use crate::error::InputError;
use crate::problem::element::{self, Corners};

/// Nodes and elements in ascending order of number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Nodes.
    pub nodes: Vec<Node>,
    /// Points, edges and triangles. An element of two physical groups stands twice in a Gmsh file of version 2.2, under two
    /// numbers, and once, with two tags, in one of version 4.1.
    pub elements: Vec<Element>,
    /// Names of physical groups.
    pub names: Vec<PhysicalName>,
}

/// A node.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its number.
    pub number: usize,
    /// Coordinates, length.
    pub xyz: [f64; 3],
}

/// A point, an edge or a triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Its number: the row of `elem`.
    pub number: usize,
    /// Gmsh's element type: 15 point, 1 edge, 2 triangle.
    pub kind: usize,
    /// Tags of the physical groups that it belongs to, ascending.
    pub physical: Vec<usize>,
    /// Tag of its geometric entity.
    pub geometric: usize,
    /// Its nodes.
    pub nodes: Vec<usize>,
}

/// The name of a physical group.
#[derive(Clone, Debug, PartialEq)]
pub struct PhysicalName {
    /// Dimension of the group's elements: 0 points, 1 edges, 2 triangles. Tags of different dimensions are independent.
    pub dim: usize,
    /// The group's tag.
    pub tag: usize,
    /// Its name.
    pub name: String,
}

/// Gmsh's element types of dimension 0, 1 and 2.
const KINDS: [usize; 3] = [15, 1, 2];

impl Mesh {
    /// From the paper's own tables: rows of `node` are number, x, y, z; rows of `elem` are number, type, 2, physical tag,
    /// geometric tag, nodes.
    ///
    /// # Errors
    /// A row of another form.
    pub fn from_tables(node: &[[f64; 4]], elem: &[Vec<usize>]) -> Result<Self, InputError> {
        let mut mesh = Mesh::default();
        for (k, &[number, x, y, z]) in node.iter().enumerate() {
            if number.fract() != 0.0 || !(1.0..9e15).contains(&number) {
                let what = format!("{number} is no node number");
                return Err(InputError::new(
                    format!("node[{k}]"),
                    what,
                    "number the nodes 1, 2, 3, ...",
                ));
            }
            mesh.nodes.push(Node { number: number as usize, xyz: [x, y, z] });
        }
        for (k, row) in elem.iter().enumerate() {
            mesh.elements.push(element_row(row).map_err(|e| e.within(&format!("elem[{k}]")))?);
        }
        mesh.nodes.sort_by_key(|n| n.number);
        mesh.elements.sort_by_key(|e| e.number);
        Ok(mesh)
    }

    /// The elements of a dimension: 0 points, 1 edges, 2 triangles.
    pub fn of_dimension(&self, dim: usize) -> impl Iterator<Item = &Element> {
        self.elements.iter().filter(move |e| e.kind == KINDS[dim])
    }

    /// Coordinates of node `n` in the plane.
    pub fn xy(&self, n: usize) -> [f64; 2] {
        let [x, y, _] = self.nodes[n - 1].xyz;
        [x, y]
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: &Element) -> Corners<f64> {
        [0, 1, 2].map(|k| self.xy(triangle.nodes[k]))
    }

    /// That `n` is a node of the mesh.
    ///
    /// # Errors
    /// It is not.
    pub fn check_node(&self, n: usize, place: &str) -> Result<(), InputError> {
        let r = self.nodes.len();
        if (1..=r).contains(&n) {
            return Ok(());
        }
        Err(InputError::new(
            place,
            format!("node number {n} is beyond R = {r}"),
            "the paper's tables are indexed by node number: nodes are numbered 1 to R (in Gmsh: Mesh.Renumber = 1)",
        ))
    }

    /// What the listings take for granted: nodes numbered 1 to R in one plane, elements that name them, triangles of positive
    /// area, none twice.
    ///
    /// # Errors
    /// The first condition that is broken, by node or element number.
    pub fn check(&self) -> Result<(), InputError> {
        self.check_names()?;
        self.check_nodes()?;
        self.check_elements()?;
        self.of_dimension(2).try_for_each(|triangle| self.check_area(triangle))
    }

    fn check_names(&self) -> Result<(), InputError> {
        for (k, a) in self.names.iter().enumerate() {
            let same = |b: &&PhysicalName| a.dim == b.dim && a.name == b.name && a.tag != b.tag;
            if let Some(b) = self.names[..k].iter().find(same) {
                let what = format!(
                    "the physical groups {} and {} are both named {:?}",
                    b.tag, a.tag, a.name
                );
                return Err(InputError::new(
                    "the mesh's physical groups",
                    what,
                    "give each a name of its own",
                ));
            }
        }
        Ok(())
    }

    fn check_nodes(&self) -> Result<(), InputError> {
        let place = "the mesh's nodes";
        for (k, node) in self.nodes.iter().enumerate() {
            if k > 0 && self.nodes[k - 1].number == node.number {
                let what = format!("node {} is given twice", node.number);
                return Err(InputError::new(place, what, "give each node once"));
            }
            self.check_node(node.number, place)?;
            if node.xyz.iter().any(|x| !x.is_finite()) {
                let what = format!("node {} has a coordinate that is not finite", node.number);
                return Err(InputError::new(place, what, "give finite coordinates"));
            }
            if node.xyz[2] != self.nodes[0].xyz[2] {
                let what = format!(
                    "node {} has z = {}, node {} z = {}: the mesh is not plane",
                    node.number, node.xyz[2], self.nodes[0].number, self.nodes[0].xyz[2]
                );
                return Err(InputError::new(place, what, "give all nodes the same z"));
            }
        }
        Ok(())
    }

    fn check_elements(&self) -> Result<(), InputError> {
        let place = "the mesh's elements";
        let most = 16 * self.elements.len() + 1024;
        let mut corners = std::collections::HashMap::new();
        for (k, element) in self.elements.iter().enumerate() {
            let number = element.number;
            if k > 0 && self.elements[k - 1].number == number {
                let what = format!("element {number} is given twice");
                return Err(InputError::new(place, what, "give each element once"));
            }
            if number == 0 || number > most {
                let what = format!("element number {number} for {} elements", self.elements.len());
                let mend = "elem is indexed by element number: number the elements 1, 2, 3, ...";
                return Err(InputError::new(place, what, mend));
            }
            for (k, &n) in element.nodes.iter().enumerate() {
                self.check_node(n, &format!("element {number}"))?;
                if element.nodes[..k].contains(&n) {
                    let what =
                        format!("element {number} names node {n} twice: {:?}", element.nodes);
                    return Err(InputError::new(place, what, "give it different nodes"));
                }
            }
            if element.kind == KINDS[2] {
                let mut key = element.nodes.clone();
                key.sort_unstable();
                if let Some(first) = corners.insert(key, number) {
                    let what = format!(
                        "triangles {first} and {number} have the same nodes {:?}",
                        element.nodes
                    );
                    let mend =
                        "keep one: a triangle in two physical groups of Gmsh is written twice";
                    return Err(InputError::new(place, what, mend));
                }
            }
        }
        if corners.is_empty() {
            return Err(InputError::new(
                place,
                "the mesh has no triangle",
                "in Gmsh, mesh the surfaces (-2) and save their physical groups",
            ));
        }
        Ok(())
    }

    fn check_area(&self, triangle: &Element) -> Result<(), InputError> {
        let area = element::area(&self.corners(triangle));
        if area > 0.0 && area.is_finite() {
            return Ok(());
        }
        let (number, nodes) = (triangle.number, &triangle.nodes);
        let (what, mend) = if area < 0.0 {
            (
                format!("triangle {number} (nodes {nodes:?}) runs clockwise: its area is {area}"),
                "list its nodes counter-clockwise (in Gmsh: ReverseMesh Surface)",
            )
        } else {
            (
                format!("triangle {number} (nodes {nodes:?}) has the area {area}"),
                "move or merge its nodes",
            )
        };
        Err(InputError::new("the mesh's triangles", what, mend))
    }

    /// The nodes that belong to no triangle, ascending.
    pub fn orphans(&self) -> Vec<usize> {
        let mut used = vec![false; self.nodes.len()];
        for n in self.of_dimension(2).flat_map(|t| &t.nodes) {
            used[n - 1] = true;
        }
        (1..=used.len()).filter(|n| !used[n - 1]).collect()
    }

    /// The mesh without the nodes `dropped` and the points and edges on them; the rest numbered 1 to R again.
    pub fn without(&self, dropped: &[usize]) -> Mesh {
        let kept = |n: &usize| dropped.binary_search(n).is_err();
        let mut mesh = self.clone();
        mesh.elements.retain(|e| e.nodes.iter().all(kept));
        mesh.nodes.retain(|node| kept(&node.number));
        for element in &mut mesh.elements {
            for n in &mut element.nodes {
                *n = new_number(*n, dropped);
            }
        }
        for (k, node) in mesh.nodes.iter_mut().enumerate() {
            node.number = k + 1;
        }
        mesh
    }
}

/// The number of node `n` once the nodes `dropped` are gone.
pub fn new_number(n: usize, dropped: &[usize]) -> usize {
    n - dropped.partition_point(|d| *d < n)
}

/// A row of `elem`: number, type, 2, physical tag, geometric tag, nodes.
fn element_row(row: &[usize]) -> Result<Element, InputError> {
    let mend = "a row is number, type, 2, physical tag, geometric tag, nodes: [7, 1, 2, 10, 1, 3, 4] for an edge";
    let bad = |what: String| InputError::new("", what, mend);
    let [number, kind, tags, physical, geometric, ref nodes @ ..] = *row else {
        return Err(bad(format!("{} entries are too few", row.len())));
    };
    let expected = match kind {
        15 => 1,
        1 => 2,
        2 => 3,
        _ => return Err(bad(format!("type {kind} is none of 15 (point), 1 (edge), 2 (triangle)"))),
    };
    if tags != 2 {
        return Err(bad(format!(
            "{tags} tags: the listings read nodes from column 6 on, so there must be 2"
        )));
    }
    if nodes.len() != expected {
        return Err(bad(format!("type {kind} has {expected} nodes, not {}", nodes.len())));
    }
    let physical = if physical == 0 { vec![] } else { vec![physical] };
    Ok(Element { number, kind, physical, geometric, nodes: nodes.to_vec() })
}
