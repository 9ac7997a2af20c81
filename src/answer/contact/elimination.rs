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

use crate::numbers::scalar::Scalar;
use crate::paper::mathcad::array::Table;
use crate::paper::mirror::{Pairs, Worksheet};

/// What a contact node in contact is bound to.
#[derive(Clone, Debug, PartialEq)]
pub struct Tie<T = f64> {
    /// The contact node.
    pub node: usize,
    /// Target nodes and their weights.
    pub weights: Vec<(usize, T)>,
    /// Which of its motions are bound, and where to.
    pub motion: Motion<T>,
}

impl<T: Scalar> Tie<T> {
    /// The same tie in other numbers.
    pub fn map<U: Scalar>(&self, to: impl Fn(T) -> U) -> Tie<U> {
        Tie {
            node: self.node,
            weights: self.weights.iter().map(|&(mate, w)| (mate, to(w))).collect(),
            motion: match self.motion {
                Motion::Both(shift) => Motion::Both(shift.map(&to)),
                Motion::Along(normal, shift) => Motion::Along(normal.map(&to), to(shift)),
            },
        }
    }
}

/// The motions of a contact node that a tie binds. Lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion<T = f64> {
    /// Both components: u_c = Σ w u_t + shift. Eq. (1) where the shift is 0.
    Both([T; 2]),
    /// Along a unit normal only: n·u_c = Σ w n·u_t + shift.
    Along([T; 2], T),
}

impl<T: Scalar> Tie<T> {
    /// Eq. (1): u_c = Σ w u_t.
    pub fn equal(node: usize, weights: Vec<(usize, T)>) -> Self {
        Tie { node, weights, motion: Motion::Both([T::zero(), T::zero()]) }
    }
}

/// The matrix T, for each of the 2R equations its weights on the equations that remain, and the shift s, length.
pub struct Elimination<T = f64> {
    rows: Vec<Vec<(usize, T)>>,
    shift: DVector<T>,
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

impl<T: Scalar> Elimination<T> {
    /// T under eq. (1) for `ties`. A component that S restrains stays restrained: it is not tied.
    pub fn new(sheet: &Worksheet<T>, ties: &[Tie<T>]) -> Self {
        Elimination::with_normals(sheet, ties).expect("ties of both components have no normal")
    }

    /// T and s for ties of either motion.
    ///
    /// # Errors
    /// A contact node that is to follow a normal along which S holds it.
    pub fn with_normals(sheet: &Worksheet<T>, ties: &[Tie<T>]) -> Result<Self, HeldAlongNormal> {
        let equations = sheet.S.rows();
        let mut tied = vec![false; equations / 2 + 1];
        ties.iter().for_each(|tie| tied[tie.node] = true);
        let mut t = Elimination {
            rows: vec![Vec::new(); equations],
            shift: DVector::from_element(equations, T::zero()),
            free: Vec::new(),
        };
        let held = |e: usize| sheet.S[e + 1] == 1;
        for e in (0..equations).filter(|&e| !held(e) && !tied[e / 2 + 1]) {
            t.rows[e] = vec![(t.add(e), T::one())];
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

    fn tie_both(&mut self, tie: &Tie<T>, held: [bool; 2], shift: [T; 2]) {
        for direction in [0, 1].into_iter().filter(|&d| !held[d]) {
            let mut normal = [T::zero(), T::zero()];
            normal[direction] = T::one();
            let e = 2 * tie.node - 2 + direction;
            self.rows[e] = self.target_motion(tie, normal, T::one());
            self.shift[e] = shift[direction];
        }
    }

    fn tie_along(
        &mut self,
        tie: &Tie<T>,
        held: [bool; 2],
        [nx, ny]: [T; 2],
        shift: T,
    ) -> Result<(), HeldAlongNormal> {
        let (first, across) = (2 * tie.node - 2, T::from_f64(ACROSS));
        let mut follow = |direction: usize, factor: T| {
            self.rows[first + direction] = self.target_motion(tie, [nx, ny], factor);
            self.shift[first + direction] = shift * factor;
        };
        match held {
            [false, false] => {
                follow(0, nx);
                follow(1, ny);
                let slide = self.add(first + usize::from(Scalar::abs(nx) > Scalar::abs(ny)));
                self.rows[first].push((slide, -ny));
                self.rows[first + 1].push((slide, nx));
            }
            [true, false] if Scalar::abs(ny) > across => follow(1, T::one() / ny),
            [false, true] if Scalar::abs(nx) > across => follow(0, T::one() / nx),
            _ => return Err(HeldAlongNormal { node: tie.node }),
        }
        Ok(())
    }

    /// `factor` · Σ w n·u_t on the equations that remain.
    fn target_motion(&self, tie: &Tie<T>, normal: [T; 2], factor: T) -> Vec<(usize, T)> {
        let mut row = Vec::new();
        for &(mate, weight) in &tie.weights {
            for direction in [0, 1].into_iter().filter(|&d| !normal[d].is_zero()) {
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
    pub fn row(&self, equation: usize) -> &[(usize, T)] {
        &self.rows[equation]
    }

    /// Tᵀ K T of a dense K.
    pub fn matrix(&self, k: &DMatrix<T>) -> DMatrix<T> {
        let mut reduced = DMatrix::from_element(self.size(), self.size(), T::zero());
        for (j, column) in self.rows.iter().enumerate().filter(|(_, row)| !row.is_empty()) {
            for (i, row) in self.rows.iter().enumerate() {
                let value = k[(i, j)];
                if value.is_zero() {
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
    pub fn load(&self, f: &DVector<T>) -> DVector<T> {
        let mut reduced = DVector::from_element(self.size(), T::zero());
        for (row, value) in self.rows.iter().zip(f.iter()) {
            for &(p, w) in row {
                reduced[p] += w * *value;
            }
        }
        reduced
    }

    /// T q + s: the displacements of all 2R equations.
    pub fn expand(&self, q: &DVector<T>) -> DVector<T> {
        let of_row = |row: &Vec<(usize, T)>| sum(row.iter().map(|&(p, w)| w * q[p]));
        DVector::from_fn(self.rows.len(), |e, _| of_row(&self.rows[e]) + self.shift[e])
    }

    /// s: the displacements of all 2R equations where those that remain are 0, length.
    pub fn shift(&self) -> &DVector<T> {
        &self.shift
    }

    /// The equation, from 0, that became column `column` of the reduced matrix.
    pub fn equation(&self, column: usize) -> usize {
        self.free[column]
    }
}

/// Eq. (1) for the contact nodes with dy = 1, each once: target nodes and weights are columns 1 to 4 of its row of k_cnt.
pub fn ties<T: Scalar>(sheet: &Worksheet<T>, pairs: &Pairs<T>) -> Vec<Tie<T>> {
    let mut ties: Vec<Tie<T>> = Vec::new();
    for i1 in (1..=sheet.cnt.rows()).filter(|&i1| pairs.dy[i1] == 1) {
        let node = sheet.cnt[i1];
        if ties.iter().all(|tie| tie.node != node) {
            let mate =
                |column: usize| (pairs.k_cnt[(node, column)].at(), pairs.k_cnt[(node, column + 1)]);
            ties.push(Tie::equal(node, vec![mate(1), mate(3)]));
        }
    }
    ties
}

/// The contact nodes with dy = 1 and the weights of their place on the target edge, as lines 22 and 23 of `c_cnt` have them before
/// they are added up in k_cnt: they sum to 1 whatever the reading does to k_cnt. `node` is the shape that weights come from (R5).
pub fn interpolations<T: Scalar>(
    sheet: &Worksheet<T>,
    pairs: &Pairs<T>,
    node: &Table<T>,
) -> Vec<Tie<T>> {
    let in_contact = (1..=sheet.cnt.rows()).filter(|&i1| pairs.dy[i1] == 1);
    in_contact
        .map(|i1| {
            let node_of = |column: usize| sheet.elem[(pairs.ct[i1], column)];
            let x = |n: usize| node[(n, 2)];
            let (c, a, b) = (sheet.cnt[i1], node_of(6), node_of(7));
            let k1 = T::one() - (x(c) - x(a)) / (x(b) - x(a));
            let k2 = T::one() - (x(b) - x(c)) / (x(b) - x(a));
            Tie::equal(c, vec![(a, k1), (b, k2)])
        })
        .collect()
}

/// The sum of `terms`, 0 of none; begun with the first, as a sum of floats is.
pub(super) fn sum<T: Scalar>(terms: impl Iterator<Item = T>) -> T {
    terms.reduce(|sum, term| sum + term).unwrap_or(T::zero())
}
