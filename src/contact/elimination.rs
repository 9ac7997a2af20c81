//! Eq. (1) by elimination: Tᵀ K T on the free equations.
//!
//! ```text
//!   u_c = k1·u_a + k2·u_b                 a row of T has
//!                                           one 1        a free equation
//!     a *-----o-----* b                     k1 and k2    an equation of a contact node in contact
//!             c                             nothing      a restrained equation
//! ```

use nalgebra::{DMatrix, DVector};

use crate::mathcad::array::Table;
use crate::mirror::{Pairs, Worksheet};

/// The matrix T: for each of the 2R equations its weights on the equations that remain.
pub struct Elimination {
    rows: Vec<Vec<(usize, f64)>>,
    size: usize,
}

impl Elimination {
    /// T for the contact nodes with dy = 1. A component that S restrains stays restrained: it is not tied.
    pub fn new(sheet: &Worksheet<f64>, pairs: &Pairs<f64>) -> Self {
        let equations = sheet.S.rows();
        let ties: Vec<Tie> = ties(sheet, pairs);
        let mut tied = vec![None; sheet.R() + 1];
        for tie in &ties {
            tied[tie.node] = Some(tie);
        }
        let mut rows = vec![Vec::new(); equations];
        let mut size = 0;
        for e in 0..equations {
            if sheet.S[e + 1] == 0 && tied[e / 2 + 1].is_none() {
                rows[e] = vec![(size, 1.0)];
                size += 1;
            }
        }
        for tie in ties {
            for direction in [0, 1] {
                if sheet.S[2 * tie.node - 1 + direction] == 0 {
                    rows[2 * tie.node - 2 + direction] = tie
                        .weights
                        .iter()
                        .flat_map(|&(mate, k)| {
                            rows[2 * mate - 2 + direction].iter().map(move |&(p, w)| (p, k * w))
                        })
                        .collect();
                }
            }
        }
        Elimination { rows, size }
    }

    /// Tᵀ K T.
    pub fn matrix(&self, k: &DMatrix<f64>) -> DMatrix<f64> {
        let mut reduced = DMatrix::zeros(self.size, self.size);
        for (j, column) in self.rows.iter().enumerate().filter(|(_, row)| !row.is_empty()) {
            for (i, row) in self.rows.iter().enumerate() {
                let value = k[(i, j)];
                if value == 0.0 {
                    continue;
                }
                for &(p, wp) in row {
                    for &(q, wq) in column {
                        reduced[(p, q)] += wp * value * wq;
                    }
                }
            }
        }
        reduced
    }

    /// Tᵀ f.
    pub fn load(&self, f: &DVector<f64>) -> DVector<f64> {
        let mut reduced = DVector::zeros(self.size);
        for (row, value) in self.rows.iter().zip(f.iter()) {
            for &(p, w) in row {
                reduced[p] += w * value;
            }
        }
        reduced
    }

    /// T u: the displacements of all 2R equations.
    pub fn expand(&self, u: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(
            self.rows.len(),
            self.rows.iter().map(|row| row.iter().map(|&(p, w)| w * u[p]).sum()),
        )
    }

    /// The equation, from 0, that became column `column` of the reduced matrix.
    pub fn equation(&self, column: usize) -> usize {
        let is_it = |row: &Vec<(usize, f64)>| matches!(row[..], [(p, _)] if p == column);
        self.rows.iter().position(is_it).expect("each column comes from one free equation")
    }
}

/// A contact node in contact and what eq. (1) makes of it.
pub struct Tie {
    /// The contact node.
    pub node: usize,
    /// Target nodes and their weights: columns 1 to 4 of its row of k_cnt.
    pub weights: [(usize, f64); 2],
}

/// The contact nodes with dy = 1, each once.
pub fn ties(sheet: &Worksheet<f64>, pairs: &Pairs<f64>) -> Vec<Tie> {
    let mut ties: Vec<Tie> = Vec::new();
    for i1 in (1..=sheet.cnt.rows()).filter(|&i1| pairs.dy[i1] == 1) {
        let node = sheet.cnt[i1];
        if ties.iter().all(|tie| tie.node != node) {
            let mate = |column: usize| {
                (pairs.k_cnt[(node, column)] as usize, pairs.k_cnt[(node, column + 1)])
            };
            ties.push(Tie { node, weights: [mate(1), mate(3)] });
        }
    }
    ties
}

/// The contact nodes with dy = 1 and the weights of their place on the target edge, as lines 22 and 23 of `c_cnt` have them before
/// they are added up in k_cnt: they sum to 1 whatever the reading does to k_cnt. `node` is the shape that weights come from (R5).
pub fn interpolations(sheet: &Worksheet<f64>, pairs: &Pairs<f64>, node: &Table<f64>) -> Vec<Tie> {
    let in_contact = (1..=sheet.cnt.rows()).filter(|&i1| pairs.dy[i1] == 1);
    in_contact
        .map(|i1| {
            let node_of = |column: usize| sheet.elem[(pairs.ct[i1], column)];
            let x = |n: usize| node[(n, 2)];
            let (c, a, b) = (sheet.cnt[i1], node_of(6), node_of(7));
            let k1 = 1.0 - (x(c) - x(a)) / (x(b) - x(a));
            let k2 = 1.0 - (x(b) - x(c)) / (x(b) - x(a));
            Tie { node: c, weights: [(a, k1), (b, k2)] }
        })
        .collect()
}
