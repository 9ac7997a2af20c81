//! What stands on the worksheet around the two listings.

use nalgebra::SMatrix;

use crate::numbers::scalar::Scalar;
use crate::paper::mathcad::array::{Column, Table};
use crate::problem::element::Plane;

/// The arrays and variables that the listings use without receiving them as arguments
/// (`listings/READING.md`, section 1).
#[derive(Clone, Debug, PartialEq)]
#[allow(non_snake_case, reason = "the paper's own names")]
pub struct Worksheet<T> {
    /// Initial node table: number, x, y, z. R x 4, length.
    pub node: Table<T>,
    /// Element table: number, type, number of tags, physical tag, geometric tag, node, node[,
    /// node]; 0 past a row's end.
    pub elem: Table<usize>,
    /// The rows of `elem` whose type is 2. M x 8.
    pub EL: Table<usize>,
    /// `elem` numbers of the target edges.
    pub trg: Column<usize>,
    /// Node numbers of the contact surface, in order along it.
    pub cnt: Column<usize>,
    /// The text's c_tol, length.
    pub c_tll: T,
    /// Column of `EL` where its nodes start: 6.
    pub ind_1: usize,
    /// Restraints: entry 2n−1 for x and 2n for y of node n, 1 = fixed. 2R.
    pub S: Column<usize>,
    /// Element areas times the scene's thickness, length³: the paper's areas where that is 1. M.
    pub Ae: Column<T>,
    /// Strain matrices. M of 3 x 6, 1/length.
    pub B: Column<SMatrix<T, 3, 6>>,
    /// Elastic moduli. M, stress.
    pub E: Column<T>,
    /// Poisson's ratios. M.
    pub nu: Column<T>,
    /// The plane problem behind `D` (R6).
    pub plane: Plane,
}

impl<T: Scalar> Worksheet<T> {
    /// Number of nodes, `R`.
    #[allow(non_snake_case, reason = "the paper's own name")]
    pub fn R(&self) -> usize {
        self.node.rows()
    }

    /// Number of triangles, `M`.
    #[allow(non_snake_case, reason = "the paper's own name")]
    pub fn M(&self) -> usize {
        self.EL.rows()
    }
}
