//! The worksheet around the two listings.

use nalgebra::SMatrix;

use mathcad::array::{Column, Table};
use numbers::scalar::Scalar;
use problem::element::Plane;

/// The arrays and variables that the listings use without receiving them as arguments
/// (`listings/READING.md`, section 1).
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, reason = "the paper's own names")]
pub struct Worksheet<T> {
    /// The initial node table: number, x, y, z. R x 4, length.
    pub node: Table<T>,
    /// The element table: number, type, number of tags, physical tag, geometric tag, node, node[,
    /// node]; 0 after the end of a row. By element number x 8.
    pub elem: Table<usize>,
    /// The rows of `elem` whose type is 2. M x 8.
    pub EL: Table<usize>,
    /// The `elem` numbers of the target edges.
    pub trg: Column<usize>,
    /// The node numbers of the contact surface, in order along it.
    pub cnt: Column<usize>,
    /// The tolerance, c_tol in the text, length.
    pub c_tll: T,
    /// The column of `EL` where its nodes start: 6.
    pub ind_1: usize,
    /// The restraints: entry 2n−1 for x and 2n for y of node n, 1 = fixed. 2R.
    pub S: Column<usize>,
    /// The element areas (the paper's) times the scene's thickness, length³. M.
    pub Ae: Column<T>,
    /// The strain matrices. M of 3 x 6, 1/length.
    pub B: Column<SMatrix<T, 3, 6>>,
    /// The elastic moduli. M, stress.
    pub E: Column<T>,
    /// The Poisson's ratios of the triangles. M.
    pub nu: Column<T>,
    /// The plane problem behind `D` (R6).
    pub plane: Plane,
}

impl<T: Scalar> Worksheet<T> {
    /// Returns the number of nodes, `R`.
    #[allow(non_snake_case, reason = "the paper's own name")]
    pub fn R(&self) -> usize {
        self.node.rows()
    }

    /// Returns the number of triangles, `M`.
    #[allow(non_snake_case, reason = "the paper's own name")]
    pub fn M(&self) -> usize {
        self.EL.rows()
    }
}
