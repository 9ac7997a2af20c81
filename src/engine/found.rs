//! What `c_cnt` found in an iteration, kept for each of a run.

use mathcad::array::{Column, Table, rows};
use numbers::scalar::Scalar;
use paper::mirror::Pairs;
use serde::Serialize;

/// The pairs of an iteration in the arrays of `c_cnt`, but of `k_cnt`, which has a row for each node of
/// the mesh, only the rows in which something is written.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FoundPairs {
    /// The `elem` number of each contact node's target edge; 0 for none.
    pub ct: Column<usize>,
    /// The vertical distance from contact node to target line, > 0 with the line above, length.
    pub yt: Column<f64>,
    /// The status of each contact node: 1 in contact, 0 not.
    pub dy: Column<usize>,
    /// The number of each node with a mate, ascending, with its row: mate, weight, mate, weight.
    pub mates: Vec<(usize, [f64; 4])>,
    nodes: usize,
}

impl FoundPairs {
    /// Keeps what was found.
    pub fn new<T: Scalar>(pairs: &Pairs<T>) -> Self {
        let row = |node: usize| (node, [1, 2, 3, 4].map(|j| pairs.k_cnt[(node, j)].to_f64()));
        let is_written = |(_, row): &(usize, [f64; 4])| row.iter().any(|x| *x != 0.0);
        let nodes = pairs.k_cnt.rows();
        FoundPairs {
            ct: pairs.ct.clone(),
            yt: pairs.yt.map(T::to_f64),
            dy: pairs.dy.clone(),
            mates: (1..=nodes).map(row).filter(is_written).collect(),
            nodes,
        }
    }

    /// Returns the place, from 0, of the first contact node whose edge or status is another one.
    pub fn first_difference(&self, other: &FoundPairs) -> Option<usize> {
        let found = |pairs: &FoundPairs, i1: usize| (pairs.ct[i1], pairs.dy[i1]);
        (1..=rows(&self.dy)).find(|i1| found(self, *i1) != found(other, *i1)).map(|i1| i1 - 1)
    }

    /// Returns `k_cnt`, R x 4.
    pub fn k_cnt(&self) -> Table<f64> {
        let mut table = Table::filled(self.nodes, 4, 0.0);
        for (node, row) in &self.mates {
            (1..).zip(row).for_each(|(j, x)| table[(*node, j)] = *x);
        }
        table
    }

    /// Returns all arrays of `c_cnt`.
    pub fn whole(&self) -> Pairs<f64> {
        Pairs { ct: self.ct.clone(), yt: self.yt.clone(), dy: self.dy.clone(), k_cnt: self.k_cnt() }
    }
}
