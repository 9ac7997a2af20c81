//! Contact by elimination: u = T q + s, and Tᵀ K T on the free equations q.
//!
//! ```text
//!   eq. (1): u_c = k1·u_a + k2·u_b         a row of T has
//!                                            one 1        a free equation
//!     a *-----o-----* b                      weights      an equation of a contact node in contact
//!             c                              nothing      a restrained equation
//! ```
//!
//! A constraint that closes a gap g along a normal n, n·(u_c − Σ w u_t) = −g, leaves the contact node one free motion, along the
//! tangent, and moves it by s = −g·n.

use nalgebra::{DMatrix, DVector};

use crate::mathcad::array::Table;
use crate::mirror::{Pairs, Worksheet};

/// What a contact node in contact is bound to.
#[derive(Clone, Debug, PartialEq)]
pub struct Tie {
    /// The contact node.
    pub node: usize,
    /// Target nodes and their weights.
    pub weights: Vec<(usize, f64)>,
    /// Which of its motions are bound, and where to.
    pub motion: Motion,
}

/// The motions of a contact node that a tie binds. Lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Both components: u_c = Σ w u_t + shift. Eq. (1) where the shift is 0.
    Both([f64; 2]),
    /// Along a unit normal only: n·u_c = Σ w n·u_t + shift.
    Along([f64; 2], f64),
}

impl Tie {
    /// Eq. (1): u_c = Σ w u_t.
    pub fn equal(node: usize, weights: Vec<(usize, f64)>) -> Self {
        Tie { node, weights, motion: Motion::Both([0.0, 0.0]) }
    }
}

/// The matrix T, for each of the 2R equations its weights on the equations that remain, and the shift s, length.
pub struct Elimination {
    rows: Vec<Vec<(usize, f64)>>,
    shift: DVector<f64>,
    /// For each equation that remains the equation, from 0, that it was.
    free: Vec<usize>,
}

/// A contact node that its restraints keep from following its tie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HeldAlongNormal {
    /// The contact node.
    pub node: usize,
}

/// A component of a normal below which a motion across it cannot follow the normal.
const ACROSS: f64 = 1e-6;

impl Elimination {
    /// T under eq. (1) for `ties`. A component that S restrains stays restrained: it is not tied.
    pub fn new(sheet: &Worksheet<f64>, ties: &[Tie]) -> Self {
        Elimination::with_normals(sheet, ties).expect("ties of both components have no normal")
    }

    /// T and s for ties of either motion.
    ///
    /// # Errors
    /// A contact node that is to follow a normal along which S holds it.
    pub fn with_normals(sheet: &Worksheet<f64>, ties: &[Tie]) -> Result<Self, HeldAlongNormal> {
        let equations = sheet.S.rows();
        let mut tied = vec![false; equations / 2 + 1];
        ties.iter().for_each(|tie| tied[tie.node] = true);
        let mut t = Elimination {
            rows: vec![Vec::new(); equations],
            shift: DVector::zeros(equations),
            free: Vec::new(),
        };
        let held = |e: usize| sheet.S[e + 1] == 1;
        for e in (0..equations).filter(|&e| !held(e) && !tied[e / 2 + 1]) {
            t.rows[e] = vec![(t.add(e), 1.0)];
        }
        for tie in ties {
            let held = [0, 1].map(|d| held(2 * tie.node - 2 + d));
            match tie.motion {
                Motion::Both(shift) => t.tie_both(tie, held, shift),
                Motion::Along(normal, shift) => t.tie_along(tie, held, normal, shift)?,
            }
        }
        Ok(t)
    }

    /// A new equation that remains.
    fn add(&mut self, equation: usize) -> usize {
        self.free.push(equation);
        self.free.len() - 1
    }

    fn tie_both(&mut self, tie: &Tie, held: [bool; 2], shift: [f64; 2]) {
        for direction in [0, 1].into_iter().filter(|&d| !held[d]) {
            let mut normal = [0.0, 0.0];
            normal[direction] = 1.0;
            let e = 2 * tie.node - 2 + direction;
            self.rows[e] = self.target_motion(tie, normal, 1.0);
            self.shift[e] = shift[direction];
        }
    }

    fn tie_along(
        &mut self,
        tie: &Tie,
        held: [bool; 2],
        [nx, ny]: [f64; 2],
        shift: f64,
    ) -> Result<(), HeldAlongNormal> {
        let first = 2 * tie.node - 2;
        let mut follow = |direction: usize, factor: f64| {
            self.rows[first + direction] = self.target_motion(tie, [nx, ny], factor);
            self.shift[first + direction] = shift * factor;
        };
        match held {
            [false, false] => {
                follow(0, nx);
                follow(1, ny);
                let slide = self.add(first + usize::from(nx.abs() > ny.abs()));
                self.rows[first].push((slide, -ny));
                self.rows[first + 1].push((slide, nx));
            }
            [true, false] if ny.abs() > ACROSS => follow(1, 1.0 / ny),
            [false, true] if nx.abs() > ACROSS => follow(0, 1.0 / nx),
            _ => return Err(HeldAlongNormal { node: tie.node }),
        }
        Ok(())
    }

    /// `factor` · Σ w n·u_t on the equations that remain.
    fn target_motion(&self, tie: &Tie, normal: [f64; 2], factor: f64) -> Vec<(usize, f64)> {
        let mut row = Vec::new();
        for &(mate, weight) in &tie.weights {
            for direction in [0, 1].into_iter().filter(|&d| normal[d] != 0.0) {
                let motion = &self.rows[2 * mate - 2 + direction];
                row.extend(
                    motion.iter().map(|&(p, w)| (p, factor * normal[direction] * weight * w)),
                );
            }
        }
        row
    }

    /// Number of equations that remain.
    pub fn size(&self) -> usize {
        self.free.len()
    }

    /// The row of T of equation `equation`, from 0.
    pub fn row(&self, equation: usize) -> &[(usize, f64)] {
        &self.rows[equation]
    }

    /// Tᵀ K T of a dense K.
    pub fn matrix(&self, k: &DMatrix<f64>) -> DMatrix<f64> {
        let mut reduced = DMatrix::zeros(self.size(), self.size());
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
        let mut reduced = DVector::zeros(self.size());
        for (row, value) in self.rows.iter().zip(f.iter()) {
            for &(p, w) in row {
                reduced[p] += w * value;
            }
        }
        reduced
    }

    /// T q + s: the displacements of all 2R equations.
    pub fn expand(&self, q: &DVector<f64>) -> DVector<f64> {
        let of_row = |row: &Vec<(usize, f64)>| row.iter().map(|&(p, w)| w * q[p]).sum::<f64>();
        DVector::from_fn(self.rows.len(), |e, _| of_row(&self.rows[e]) + self.shift[e])
    }

    /// s: the displacements of all 2R equations where those that remain are 0, length.
    pub fn shift(&self) -> &DVector<f64> {
        &self.shift
    }

    /// The equation, from 0, that became column `column` of the reduced matrix.
    pub fn equation(&self, column: usize) -> usize {
        self.free[column]
    }
}

/// Eq. (1) for the contact nodes with dy = 1, each once: target nodes and weights are columns 1 to 4 of its row of k_cnt.
pub fn ties(sheet: &Worksheet<f64>, pairs: &Pairs<f64>) -> Vec<Tie> {
    let mut ties: Vec<Tie> = Vec::new();
    for i1 in (1..=sheet.cnt.rows()).filter(|&i1| pairs.dy[i1] == 1) {
        let node = sheet.cnt[i1];
        if ties.iter().all(|tie| tie.node != node) {
            let mate = |column: usize| {
                (pairs.k_cnt[(node, column)] as usize, pairs.k_cnt[(node, column + 1)])
            };
            ties.push(Tie::equal(node, vec![mate(1), mate(3)]));
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
            Tie::equal(c, vec![(a, k1), (b, k2)])
        })
        .collect()
}
