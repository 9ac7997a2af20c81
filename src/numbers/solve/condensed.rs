//! Condensation: a symmetric matrix factored once, and what is left of it on the equations that
//! are kept (the Schur complement), on which everything else that changes is solved.
//!
//! ```text
//!   A = | A_ii  A_ik |  i inside     S = A_kk − A_ki A_ii⁻¹ A_ik     S x_k = b_k − A_ki A_ii⁻¹ b_i
//!       | A_ki  A_kk |  k kept       x_i = A_ii⁻¹ (b_i − A_ik x_k)
//! ```
//!
//! With the kept equations ordered last, the last block of the Cholesky factor of A is that of S. A
//! itself may be singular, as of a body that only contact holds: what is factored is A + R, where R
//! is the diagonal of A_kk, and R is taken off again. It does not touch the rest of the factor.
//!
//! Source: B. M. Irons, *Structural eigenvalue problems: elimination of unwanted variables*, AIAA J.
//! 3(5), 1965 (condensation); T. A. Davis, *Direct Methods for Sparse Linear Systems*, 2006, section
//! 4 (a partial factor holds the Schur complement).

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::{DMatrix, DVector};

use super::cholesky::{Cholesky, is_large};
use super::symmetric::SparseSymmetric;

/// A symmetric matrix condensed to the equations that are kept.
pub struct Condensed {
    factor: Cholesky<f64>,
    /// The equation at each place of the order: those inside, then those kept, as they were given.
    order: Vec<usize>,
    schur: DMatrix<f64>,
}

/// A right-hand side b on which the equations inside were eliminated.
pub struct Eliminated {
    /// In the order of the factor: L⁻¹ b.
    z: Vec<f64>,
    /// b_k − A_ki A_ii⁻¹ b_i.
    pub kept: DVector<f64>,
}

impl Condensed {
    /// Condenses `matrix` to the equations `kept`; None where A_ii is not far from a singular matrix,
    /// or S has lost its digits against A_kk, and without equations.
    pub fn new(matrix: &SparseSymmetric, kept: &[usize]) -> Option<Self> {
        if matrix.size() == 0 {
            return None;
        }
        let order = order(matrix, kept);
        let inside = order.len() - kept.len();
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(k, e)| place[*e] = k);
        let raised = matrix.map_diagonal(|e, a| if place[e] >= inside { a + a } else { a });
        let factor = Cholesky::ordered(&raised, &order, &place)?;
        let factor = Some(factor).filter(|factor| factor.has_large_pivots(&raised.diagonal()))?;
        let mut last = DMatrix::zeros(kept.len(), kept.len());
        factor.visit_last(inside, |i, j, l| last[(i, j)] = l);
        let mut schur = square(&last);
        let diagonal = matrix.diagonal();
        for (k, e) in kept.iter().enumerate() {
            schur[(k, k)] -= diagonal[*e];
            if !is_large(schur[(k, k)], diagonal[*e]) {
                return None;
            }
        }
        Some(Condensed { factor, order, schur })
    }

    /// Returns S, in the order in which the kept equations were given.
    pub fn schur(&self) -> &DMatrix<f64> {
        &self.schur
    }

    /// Eliminates the equations inside from a right-hand side.
    pub fn eliminate(&self, b: &DVector<f64>) -> Eliminated {
        let mut z: Vec<f64> = self.order.iter().map(|e| b[*e]).collect();
        self.factor.solve_lower(&mut z);
        let mut kept = DVector::zeros(z.len() - self.inside());
        let own = &z[self.inside()..];
        self.factor.visit_last(self.inside(), |i, j, l| kept[i] += l * own[j]);
        Eliminated { z, kept }
    }

    /// Returns the number of equations inside.
    fn inside(&self) -> usize {
        self.order.len() - self.schur.nrows()
    }

    /// Returns the solution on all equations from that on the kept ones.
    pub fn expand(&self, eliminated: &Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        let mut x = eliminated.z.clone();
        let own = &mut x[self.inside()..];
        own.fill(0.0);
        self.factor.visit_last(self.inside(), |i, j, l| own[j] += l * kept[i]);
        self.factor.solve_lower_transposed(&mut x);
        let mut solution = DVector::zeros(x.len());
        self.order.iter().zip(&x).for_each(|(e, x)| solution[*e] = *x);
        // What was given is returned to the bit.
        self.order[self.inside()..].iter().zip(kept).for_each(|(e, x)| solution[*e] = *x);
        solution
    }
}

/// Returns the equations inside in an order of small fill, then those that are kept.
fn order(matrix: &SparseSymmetric, kept: &[usize]) -> Vec<usize> {
    const KEPT: usize = usize::MAX;
    let mut number = vec![0; matrix.size()];
    kept.iter().for_each(|e| number[*e] = KEPT);
    let inside: Vec<usize> = (0..matrix.size()).filter(|e| number[*e] != KEPT).collect();
    inside.iter().enumerate().for_each(|(k, e)| number[*e] = k);
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for j in &inside {
        rows.extend(matrix.column(*j).map(|(i, _)| number[i]).filter(|i| *i != KEPT));
        starts.push(rows.len());
    }
    let n = inside.len();
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &rows);
    let (mut order, mut place) = (vec![0; n], vec![0; n]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, rows.len()));
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut place, pattern, amd::Control::default(), stack)
        .expect("the indices fit");
    order.iter().map(|k| inside[*k]).chain(kept.iter().copied()).collect()
}

/// Returns L Lᵀ of a lower triangle L.
fn square(l: &DMatrix<f64>) -> DMatrix<f64> {
    let n = l.nrows();
    let mut square = DMatrix::zeros(n, n);
    let view = MatRef::from_column_major_slice(l.as_slice(), n, n);
    matmul(
        MatMut::from_column_major_slice_mut(square.as_mut_slice(), n, n),
        BlockStructure::TriangularLower,
        Accum::Replace,
        view,
        BlockStructure::TriangularLower,
        view.transpose(),
        BlockStructure::TriangularUpper,
        1.0,
        Par::Seq,
    );
    square.fill_upper_triangle_with_lower_triangle();
    square
}
