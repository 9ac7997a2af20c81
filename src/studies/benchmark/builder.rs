//! Meshes row by row: two rows of nodes are joined by triangles, whatever their numbers of segments.
//!
//! ```text
//!   outer   b0----b1----b2            b0----------b1
//!           |   / |   / |             | \       / |
//!           | /   | /   |             |   \   /   |
//!   inner   a0----a1----a2            a0----a1----a2
//! ```

use crate::problem::element;
use crate::problem::scene::{Element, Mesh, Node, PhysicalName};

/// A mesh as it grows. Physical groups are numbered as they are first named, edges before bodies.
#[derive(Default)]
pub struct Builder {
    nodes: Vec<[f64; 2]>,
    edges: Vec<(String, Vec<[usize; 2]>)>,
    bodies: Vec<(&'static str, Vec<[usize; 3]>)>,
}

impl Builder {
    /// Adds a node; returns its number, from 1.
    pub fn node(&mut self, xy: [f64; 2]) -> usize {
        self.nodes.push(xy);
        self.nodes.len()
    }

    /// Adds a row of nodes.
    pub fn row(&mut self, points: impl IntoIterator<Item = [f64; 2]>) -> Vec<usize> {
        points.into_iter().map(|xy| self.node(xy)).collect()
    }

    /// Coordinates of node `n`.
    pub fn xy(&self, n: usize) -> [f64; 2] {
        self.nodes[n - 1]
    }

    /// Makes the edges between successive `nodes` a group.
    pub fn edges(&mut self, group: impl Into<String>, nodes: &[usize]) {
        self.edges.push((group.into(), nodes.windows(2).map(|w| [w[0], w[1]]).collect()));
    }

    /// Fills the strip between two rows with triangles of `body`. Equal rows are cut along inner k - outer k + 1; a row of one
    /// node is the tip of a fan.
    pub fn join(&mut self, body: &'static str, inner: &[usize], outer: &[usize]) {
        let (n, m) = (inner.len() - 1, outer.len() - 1);
        let (mut i, mut j) = (0, 0);
        while i < n || j < m {
            // The segment whose middle comes first along its row.
            let inner_first = j == m || (i < n && (2 * i + 1) * m < (2 * j + 1) * n);
            let third = if inner_first { inner[i + (i < n) as usize] } else { outer[j + 1] };
            self.triangle(body, [inner[i], third, outer[j]]);
            if inner_first { i += 1 } else { j += 1 }
        }
    }

    /// Joins successive rows.
    pub fn join_all(&mut self, body: &'static str, rows: &[Vec<usize>]) {
        rows.windows(2).for_each(|pair| self.join(body, &pair[0], &pair[1]));
    }

    /// Adds a triangle, its nodes turned counter-clockwise.
    fn triangle(&mut self, body: &'static str, [a, b, c]: [usize; 3]) {
        let positive = element::area(&[a, b, c].map(|n| self.xy(n))) > 0.0;
        let at = self.bodies.iter().position(|(name, _)| *name == body).unwrap_or_else(|| {
            self.bodies.push((body, Vec::new()));
            self.bodies.len() - 1
        });
        self.bodies[at].1.push(if positive { [a, b, c] } else { [a, c, b] });
    }

    /// The mesh: edges, then triangles, numbered from 1.
    pub fn finish(self) -> Mesh {
        let numbered = self.nodes.iter().enumerate();
        let nodes = numbered.map(|(k, &[x, y])| Node { number: k + 1, xyz: [x, y, 0.0] });
        let mut mesh = Mesh { nodes: nodes.collect(), ..Mesh::default() };
        for (name, edges) in self.edges {
            add_group(&mut mesh, 1, name, edges.into_iter().map(Vec::from));
        }
        for (name, triangles) in self.bodies {
            add_group(&mut mesh, 2, name.into(), triangles.into_iter().map(Vec::from));
        }
        mesh
    }
}

/// Adds a physical group of edges (`dim` 1) or triangles (2); Gmsh's element types have the same numbers.
fn add_group(
    mesh: &mut Mesh,
    dim: usize,
    name: String,
    elements: impl Iterator<Item = Vec<usize>>,
) {
    let tag = mesh.names.len() + 1;
    mesh.names.push(PhysicalName { dim, tag, name });
    for nodes in elements {
        let number = mesh.elements.len() + 1;
        let physical = vec![tag];
        mesh.elements.push(Element { number, kind: dim, physical, geometric: tag, nodes });
    }
}

/// A mapped grid: rows of equal length.
pub struct Grid(pub Vec<Vec<usize>>);

impl Grid {
    /// Adds the grid of `body` with `columns` x `rows` cells; `at(i, j)` places node i of row j.
    pub fn add(
        builder: &mut Builder,
        body: &'static str,
        [columns, rows]: [usize; 2],
        at: impl Fn(usize, usize) -> [f64; 2],
    ) -> Self {
        let row = |j: usize| (0..=columns).map(|i| at(i, j)).collect::<Vec<_>>();
        let rows: Vec<Vec<usize>> = (0..=rows).map(|j| builder.row(row(j))).collect();
        builder.join_all(body, &rows);
        Grid(rows)
    }

    /// The first row.
    pub fn first(&self) -> &[usize] {
        &self.0[0]
    }

    /// The last row.
    pub fn last(&self) -> &[usize] {
        &self.0[self.0.len() - 1]
    }

    /// The first node of each row.
    pub fn starts(&self) -> Vec<usize> {
        starts(&self.0)
    }

    /// The last node of each row.
    pub fn ends(&self) -> Vec<usize> {
        ends(&self.0)
    }
}

/// The first node of each row.
pub fn starts(rows: &[Vec<usize>]) -> Vec<usize> {
    rows.iter().map(|row| row[0]).collect()
}

/// The last node of each row.
pub fn ends(rows: &[Vec<usize>]) -> Vec<usize> {
    rows.iter().map(|row| row[row.len() - 1]).collect()
}

#[cfg(test)]
mod tests {
    use super::Builder;

    fn triangles(inner: usize, outer: usize) -> Vec<Vec<usize>> {
        let mut builder = Builder::default();
        let place = |k: usize, n: usize| if n == 0 { 0.5 } else { k as f64 / n as f64 };
        let a = builder.row((0..=inner).map(|k| [place(k, inner), 0.0]));
        let b = builder.row((0..=outer).map(|k| [place(k, outer), 1.0]));
        builder.join("body", &a, &b);
        builder.finish().elements.into_iter().map(|e| e.nodes).collect()
    }

    #[test]
    fn equal_rows_are_cut_along_one_diagonal() {
        assert_eq!(triangles(1, 1), [[1, 4, 3], [1, 2, 4]]);
    }

    #[test]
    fn a_row_of_half_the_segments_takes_three_triangles_a_segment() {
        assert_eq!(triangles(2, 1), [[1, 2, 4], [2, 5, 4], [2, 3, 5]]);
    }

    #[test]
    fn a_row_of_one_node_is_the_tip_of_a_fan() {
        assert_eq!(triangles(2, 0), [[1, 2, 4], [2, 3, 4]]);
    }
}
