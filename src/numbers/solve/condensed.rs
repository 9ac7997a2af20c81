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
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, amd};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use nalgebra::{DMatrix, DVector};

use super::sparse::SparseSymmetric;

/// A symmetric matrix condensed to the equations that are kept.
pub struct Condensed {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    /// The equation at each place of the order: those inside, then those kept, as they were given.
    order: Vec<usize>,
    /// The last block of the factor, k x k.
    last: DMatrix<f64>,
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
    /// Condenses `matrix` to the equations `kept`; None where A_ii is not positive definite, or the
    /// diagonal of A_kk not positive.
    pub fn new(matrix: &SparseSymmetric, kept: &[usize]) -> Option<Self> {
        let order = order(matrix, kept);
        let inside = order.len() - kept.len();
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(k, e)| place[*e] = k);
        let raised = matrix.map_diagonal(|e, a| if place[e] >= inside { a + a } else { a });
        let symbolic = symbolic(raised.pattern(), &order, &place)?;
        let values = numeric(&symbolic, &raised)?;
        let last = last_block(&symbolic, &values, inside);
        let mut schur = &last * last.transpose();
        let diagonal = matrix.diagonal();
        for (k, e) in kept.iter().enumerate() {
            schur[(k, k)] -= diagonal[*e];
        }
        Some(Condensed { symbolic, values, order, last, schur })
    }

    /// Returns S, in the order in which the kept equations were given.
    pub fn schur(&self) -> &DMatrix<f64> {
        &self.schur
    }

    /// Eliminates the equations inside from a right-hand side.
    pub fn eliminate(&self, b: &DVector<f64>) -> Eliminated {
        let mut z: Vec<f64> = self.order.iter().map(|e| b[*e]).collect();
        self.triangular(&mut z, |factor, z, stack| {
            factor.l_solve_with_conj(Conj::No, z, Par::Seq, stack);
        });
        let kept = &self.last * DVector::from_column_slice(&z[self.inside()..]);
        Eliminated { z, kept }
    }

    /// Returns the solution on all equations from that on the kept ones.
    pub fn expand(&self, eliminated: &Eliminated, kept: &DVector<f64>) -> DVector<f64> {
        let mut x = eliminated.z.clone();
        x[self.inside()..].copy_from_slice(self.last.tr_mul(kept).as_slice());
        self.triangular(&mut x, |factor, x, stack| {
            factor.l_transpose_solve_with_conj(Conj::No, x, Par::Seq, stack);
        });
        let mut solution = DVector::zeros(x.len());
        self.order.iter().zip(&x).for_each(|(e, x)| solution[*e] = *x);
        // What was given is returned to the bit.
        self.order[self.inside()..].iter().zip(kept).for_each(|(e, x)| solution[*e] = *x);
        solution
    }

    /// Returns the number of equations inside.
    fn inside(&self) -> usize {
        self.order.len() - self.last.nrows()
    }

    /// Solves with the factor or its transpose in place.
    fn triangular(
        &self,
        x: &mut [f64],
        solve: impl Fn(&SupernodalLltRef<'_, usize, f64>, MatMut<'_, f64>, &mut MemStack),
    ) {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else {
            unreachable!("the factor was asked for by supernodes")
        };
        let n = x.len();
        let mut memory = MemBuffer::new(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let factor = SupernodalLltRef::new(symbolic, &self.values);
        let stack = MemStack::new(&mut memory);
        solve(&factor, MatMut::from_column_major_slice_mut(x, n, 1), stack);
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

/// Returns the pattern of the factor in a given order; None without equations.
fn symbolic(
    pattern: SymbolicSparseColMatRef<usize>,
    order: &[usize],
    place: &[usize],
) -> Option<SymbolicCholesky<usize>> {
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..CholeskySymbolicParams::default()
    };
    let order = SymmetricOrdering::Custom(PermRef::new_checked(order, place, order.len()));
    let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, order, params).ok()?;
    matches!(symbolic.raw(), SymbolicCholeskyRaw::Supernodal(_)).then_some(symbolic)
}

/// Returns the values of the factor; None where a pivot is not positive.
fn numeric(symbolic: &SymbolicCholesky<usize>, matrix: &SparseSymmetric) -> Option<Vec<f64>> {
    let mut values = vec![0.0; symbolic.len_val()];
    let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
    let mut memory = MemBuffer::new(scratch);
    let matrix = SparseColMatRef::new(matrix.pattern(), matrix.values());
    let (regularization, stack) = (LltRegularization::default(), MemStack::new(&mut memory));
    symbolic
        .factorize_numeric_llt(
            &mut values,
            matrix,
            Side::Lower,
            regularization,
            Par::Seq,
            stack,
            Default::default(),
        )
        .ok()?;
    Some(values)
}

/// Returns the block of the factor from the row and column `from` on.
fn last_block(symbolic: &SymbolicCholesky<usize>, values: &[f64], from: usize) -> DMatrix<f64> {
    let SymbolicCholeskyRaw::Supernodal(symbolic) = symbolic.raw() else {
        unreachable!("the factor was asked for by supernodes")
    };
    let size = symbolic.nrows() - from;
    let mut block = DMatrix::zeros(size, size);
    let factor = SupernodalLltRef::new(symbolic, values);
    for s in 0..symbolic.n_supernodes() {
        let supernode = factor.supernode(s);
        let (start, matrix) = (supernode.start(), supernode.val());
        let row = |i: usize| match i.checked_sub(matrix.ncols()) {
            None => start + i,
            Some(below) => supernode.pattern()[below],
        };
        for column in (0..matrix.ncols()).filter(|j| start + j >= from) {
            for i in column..matrix.nrows() {
                block[(row(i) - from, start + column - from)] = matrix[(i, column)];
            }
        }
    }
    block
}
