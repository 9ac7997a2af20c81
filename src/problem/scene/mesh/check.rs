//! The conditions on a mesh that every computation assumes.

use std::collections::HashMap;

use super::{Element, Mesh, Node, PhysicalName};
use crate::element::{self, Corners};
use crate::model::NodeId;
use base::error::{InputError, Result};
use base::plain::six_digits;

/// The largest difference of z that is rounding, over the size of the mesh: a drawing that was rotated
/// to the plane has some.
const PLANE: f64 = 1e-12;

/// The largest tag that a Gmsh file can hold.
const LARGEST_TAG: usize = i32::MAX as usize;

impl Mesh {
    /// Returns the node with number `n`.
    ///
    /// # Errors
    /// The mesh has no such node.
    pub fn node(&self, n: usize, place: &str) -> Result<NodeId> {
        let r = self.nodes.len();
        if (1..=r).contains(&n) {
            return Ok(NodeId::from_number(n));
        }
        let what = match n {
            0 => "there is no node number 0".into(),
            _ => format!("node number {n} is beyond R = {r}"),
        };
        let fix = "the paper's tables are indexed by node number: nodes are numbered 1 to R \
                   (in Gmsh: Mesh.Renumber = 1)";
        Err(InputError::new(place, what, fix))
    }

    /// Checks the conditions that the listings assume: nodes are numbered 1 to R and lie in one
    /// plane, elements name existing nodes, triangles have a positive area, and no triangle occurs
    /// twice.
    ///
    /// # Errors
    /// The first condition that is violated, by node or element number.
    pub fn check(&self) -> Result<()> {
        let mut tags = HashMap::new();
        for PhysicalName { dim, tag, name } in &self.names {
            let first = *tags.entry((dim, name)).or_insert(tag);
            if first != tag {
                let what = format!("the physical groups {first} and {tag} are both named {name:?}");
                let fix = "give each a name of its own";
                return Err(InputError::new("the mesh's physical groups", what, fix));
            }
        }
        let place = "the mesh's nodes";
        for (k, node) in self.nodes.iter().enumerate() {
            if k > 0 && self.nodes[k - 1].number == node.number {
                let what = format!("node {} is given twice", node.number);
                return Err(InputError::new(place, what, "give each node once"));
            }
            self.node(node.number, place)?;
            if node.xyz.iter().any(|x| !x.is_finite()) {
                let what = format!("node {} has a coordinate that is not finite", node.number);
                return Err(InputError::new(place, what, "give finite coordinates"));
            }
        }
        self.check_plane()?;
        let place = "the mesh's elements";
        for (k, element) in self.elements.iter().enumerate() {
            let number = element.number;
            if k > 0 && self.elements[k - 1].number == number {
                let what = format!("element {number} is given twice");
                return Err(InputError::new(place, what, "give each element once"));
            }
            self.check_element(element)?;
        }
        self.check_triangles()
    }

    /// Checks that all nodes have the same z, apart from rounding.
    fn check_plane(&self) -> Result<()> {
        let along = |k: usize| {
            let by_k = |a: &&Node, b: &&Node| a.xyz[k].total_cmp(&b.xyz[k]);
            let [least, most] =
                [self.nodes.iter().min_by(by_k), self.nodes.iter().rev().max_by(by_k)];
            least.zip(most)
        };
        let range = |k| along(k).map_or(0.0, |(least, most)| most.xyz[k] - least.xyz[k]);
        let (extent, difference) = (range(0).max(range(1)), range(2));
        let Some((low, high)) = along(2).filter(|_| difference > PLANE * extent) else {
            return Ok(());
        };
        let [z, lower] = [high, low].map(|node| six_digits(node.xyz[2]));
        let what = format!(
            "the mesh is not plane: node {} has z = {z}, node {} z = {lower}, a difference of {} in \
             a mesh of the size {}",
            high.number,
            low.number,
            six_digits(difference),
            six_digits(extent)
        );
        let fix =
            "give all nodes the same z: draw in the plane of x and y, or rotate the mesh to it";
        Err(InputError::new("the mesh's nodes", what, fix))
    }

    /// Checks that an element's number is not far beyond the number of elements, that its tags are
    /// numbers of Gmsh, and that the element names different nodes of the mesh.
    fn check_element(&self, element: &Element) -> Result<()> {
        let place = "the mesh's elements";
        let (number, nodes, count) = (element.number, &element.nodes, self.elements.len());
        if number == 0 || number > Mesh::largest_number(count) {
            let what = format!("element number {number} for {count} elements");
            let fix = "elem is indexed by element number: number the elements 1, 2, 3, ...";
            return Err(InputError::new(place, what, fix));
        }
        let mut tags = element.physical.iter().chain([&element.geometric]);
        if let Some(tag) = tags.find(|tag| **tag > LARGEST_TAG) {
            let what = format!("element {number} has the tag {tag}");
            let fix = format!("give tags up to {LARGEST_TAG}, as Gmsh has them");
            return Err(InputError::new(place, what, fix));
        }
        for (k, n) in nodes.iter().enumerate() {
            if *n == 0 || *n > self.nodes.len() {
                self.node(*n, &format!("element {number}"))?;
            }
            if nodes[..k].contains(n) {
                let what = format!("element {number} names node {n} twice: {nodes:?}");
                return Err(InputError::new(place, what, "give it different nodes"));
            }
        }
        Ok(())
    }

    /// Checks that there are triangles, no two with the same nodes, each with a positive area.
    fn check_triangles(&self) -> Result<()> {
        let place = "the mesh's elements";
        let mut triangles: Vec<([usize; 3], usize)> = Vec::with_capacity(self.elements.len());
        triangles.extend(self.of_dimension(2).map(|triangle| {
            let mut corners = [0, 1, 2].map(|k| triangle.nodes[k]);
            corners.sort_unstable();
            (corners, triangle.number)
        }));
        if triangles.is_empty() {
            let fix = "in Gmsh, mesh the surfaces (-2); where there are physical groups, only theirs are \
                       saved: add groups as Physical Surface(\"body\") = {1};";
            return Err(InputError::new(place, "the mesh has no triangle", fix));
        }
        triangles.sort_unstable();
        let same = triangles.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        if let Some([(_, first), (nodes, second)]) = same.min_by_key(|pair| pair[1].1) {
            let what =
                format!("triangles {first} and {second} have the same nodes {}", self.named(nodes));
            let fix = "keep one, or give both the same geometric tag and different physical groups";
            return Err(InputError::new(place, what, fix));
        }
        self.of_dimension(2).try_for_each(|triangle| self.check_area(triangle))
    }

    fn check_area(&self, triangle: &Element) -> Result<()> {
        let area = element::area(&self.corners(triangle));
        if area > 0.0 && area.is_finite() {
            return Ok(());
        }
        let (what, fix) = if area < 0.0 {
            let surface = self.whereabouts(triangle);
            let what = format!("runs clockwise: its area is {} ({surface})", six_digits(area));
            (what, "list its nodes counter-clockwise")
        } else if area == 0.0 && is_flat(&self.corners(triangle)) {
            ("has the area 0".into(), "move or merge its nodes")
        } else {
            let size = if area == 0.0 { "small" } else { "large" };
            (format!("has an area too {size} to represent"), "choose other units")
        };
        let what =
            format!("triangle {} (nodes {}) {what}", triangle.number, self.named(&triangle.nodes));
        Err(InputError::new("the mesh's triangles", what, fix))
    }
}

/// Returns whether a triangle has no area in any units: once its longest side along x or y is 1.
fn is_flat(corners: &Corners<f64>) -> bool {
    let along = |k: usize| corners.map(|p| p[k] - corners[0][k]);
    let sides = [along(0), along(1)];
    let longest = sides.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
    longest == 0.0
        || element::area(&[0, 1, 2].map(|j| [0, 1].map(|k| sides[k][j] / longest))) == 0.0
}
