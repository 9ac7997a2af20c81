//! Structured meshes: rows of nodes, joined two by two by triangles.

use problem::scene::MeshBuilder;

pub struct Rows(pub Vec<Vec<usize>>);

impl Rows {
    /// Adds a mapped grid of `columns` x `rows` cells to a mesh, its triangles to the group `body`;
    /// `at(i, j)` places node i of row j, length.
    pub fn grid(
        mesh: &mut MeshBuilder,
        body: &str,
        [columns, rows]: [usize; 2],
        at: impl Fn(usize, usize) -> [f64; 2],
    ) -> Self {
        let row = |j: usize| (0..=columns).map(|i| at(i, j)).collect::<Vec<_>>();
        let rows: Vec<Vec<usize>> = (0..=rows).map(|j| mesh.row(row(j))).collect();
        mesh.join_all(body, &rows);
        Rows(rows)
    }

    pub fn first(&self) -> &[usize] {
        &self.0[0]
    }

    pub fn last(&self) -> &[usize] {
        &self.0[self.0.len() - 1]
    }

    pub fn starts(&self) -> Vec<usize> {
        self.0.iter().map(|row| row[0]).collect()
    }

    pub fn ends(&self) -> Vec<usize> {
        self.0.iter().map(|row| row[row.len() - 1]).collect()
    }
}
