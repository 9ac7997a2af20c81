//! Meshes in code. Triangles join rows of nodes of any numbers of segments.
//!
//! ```text
//!   outer   b0----b1----b2            b0----------b1
//!           |   / |   / |             | \       / |
//!           | /   | /   |             |   \   /   |
//!   inner   a0----a1----a2            a0----a1----a2
//! ```

use super::{Element, KINDS, Mesh, Node, PhysicalName};
use crate::element;
use crate::scene::groups::GroupRef;

/// A mesh under construction. Nodes are numbered from 1 in the order in which they are added.
/// Physical groups are sorted by their first mention, edges before triangles, and their elements
/// are numbered in that order. A group that is named by a tag has that tag; a group with a name
/// gets the next free tag.
#[derive(Clone, Debug, Default)]
pub struct MeshBuilder {
    nodes: Vec<[f64; 2]>,
    edges: Vec<Group<2>>,
    triangles: Vec<Group<3>>,
}

/// A physical group and its elements of `N` nodes.
#[derive(Clone, Debug)]
struct Group<const N: usize> {
    name: GroupRef,
    elements: Vec<[usize; N]>,
}

impl MeshBuilder {
    /// Adds a node at `xy`, length, and returns its number.
    pub fn node(&mut self, xy: [f64; 2]) -> usize {
        self.nodes.push(xy);
        self.nodes.len()
    }

    /// Adds a node at each of `points`, length, and returns their numbers.
    pub fn row(&mut self, points: impl IntoIterator<Item = [f64; 2]>) -> Vec<usize> {
        points.into_iter().map(|xy| self.node(xy)).collect()
    }

    /// Returns the coordinates of node `n`, length.
    pub fn xy(&self, n: usize) -> [f64; 2] {
        self.nodes[n - 1]
    }

    /// Adds the edges between successive `nodes` to a group.
    pub fn edges(&mut self, group: impl Into<GroupRef>, nodes: &[usize]) {
        let edges = nodes.windows(2).map(|w| [w[0], w[1]]);
        elements_of(&mut self.edges, group.into()).extend(edges);
    }

    /// Adds triangles, their nodes counter-clockwise, to a group.
    pub fn triangles(
        &mut self,
        group: impl Into<GroupRef>,
        triangles: impl IntoIterator<Item = [usize; 3]>,
    ) {
        elements_of(&mut self.triangles, group.into()).extend(triangles);
    }

    /// Fills the strip between two rows with triangles of a group. Equal rows are cut along the
    /// diagonals from inner node k to outer node k + 1. A row of one node is the tip of a fan.
    pub fn join(&mut self, group: impl Into<GroupRef>, inner: &[usize], outer: &[usize]) {
        let (n, m) = (inner.len() - 1, outer.len() - 1);
        let (mut i, mut j) = (0, 0);
        let mut triangles = Vec::with_capacity(n + m);
        while i < n || j < m {
            // The next segment is the one whose middle comes first along its row.
            let inner_first = j == m || (i < n && (2 * i + 1) * m < (2 * j + 1) * n);
            let third = if inner_first { inner[i + 1] } else { outer[j + 1] };
            triangles.push(self.counter_clockwise([inner[i], third, outer[j]]));
            if inner_first { i += 1 } else { j += 1 }
        }
        self.triangles(group, triangles);
    }

    /// Adds the edges along each of `rows`, lists of node numbers, to a physical group.
    pub fn join_all(&mut self, group: &str, rows: &[Vec<usize>]) {
        rows.windows(2).for_each(|pair| self.join(group, &pair[0], &pair[1]));
    }

    /// Returns the nodes of a triangle, with the last two exchanged where they run clockwise.
    fn counter_clockwise(&self, [a, b, c]: [usize; 3]) -> [usize; 3] {
        let area = element::area(&[a, b, c].map(|n| self.xy(n)));
        if area > 0.0 { [a, b, c] } else { [a, c, b] }
    }

    /// Returns the mesh with its elements numbered from 1.
    pub fn finish(self) -> Mesh {
        let numbered = self.nodes.iter().enumerate();
        let nodes = numbered.map(|(k, &[x, y])| Node { number: k + 1, xyz: [x, y, 0.0] });
        let mut mesh = Mesh { nodes: nodes.collect(), ..Mesh::default() };
        let names =
            self.edges.iter().map(|g| &g.name).chain(self.triangles.iter().map(|g| &g.name));
        let mut tags = tags(names.cloned().collect()).into_iter();
        add_groups(&mut mesh, 1, &mut tags, self.edges);
        add_groups(&mut mesh, 2, &mut tags, self.triangles);
        mesh
    }
}

/// Returns the elements of the group `name`, which is added where it is new.
fn elements_of<const N: usize>(groups: &mut Vec<Group<N>>, name: GroupRef) -> &mut Vec<[usize; N]> {
    let at = groups.iter().position(|group| group.name == name).unwrap_or_else(|| {
        groups.push(Group { name, elements: Vec::new() });
        groups.len() - 1
    });
    &mut groups[at].elements
}

/// Returns the tag of each group: its own, or the next that no group has.
fn tags(names: Vec<GroupRef>) -> Vec<usize> {
    let mut free = (1..).filter(|tag| !names.contains(&GroupRef::Tag(*tag)));
    let tag = |name: &GroupRef| match name {
        GroupRef::Tag(tag) => *tag,
        GroupRef::Name(_) => free.next().expect("there is always another number"),
    };
    names.iter().map(tag).collect()
}

fn add_groups<const N: usize>(
    mesh: &mut Mesh,
    dim: usize,
    tags: &mut impl Iterator<Item = usize>,
    groups: Vec<Group<N>>,
) {
    for (group, tag) in groups.into_iter().zip(tags) {
        if let GroupRef::Name(name) = group.name {
            mesh.names.push(PhysicalName { dim, tag, name });
        }
        for nodes in group.elements {
            mesh.elements.push(Element {
                number: mesh.elements.len() + 1,
                kind: KINDS[dim].number,
                physical: [tag].into(),
                geometric: tag,
                nodes: nodes[..].into(),
            });
        }
    }
}
