//! What is left of a symmetric matrix on its last equations, its Schur complement.
//!
//! ```text
//!   A = | A_ff  A_fl |  first     S = A_ll − A_lf A_ff⁻¹ A_fl     S x_l = b_l − A_lf A_ff⁻¹ b_f
//!       | A_lf  A_ll |  last
//! ```
//!
//! The last block of the Cholesky factor of A is that of S. A may be singular, as of a body that only contact
//! holds: what is factored is A + R, where R is the diagonal of A_ll, and R is taken off S again.
//!
//! Source: T. A. Davis, *Direct Methods for Sparse Linear Systems*, 2006, section 4.

use nalgebra::{DMatrix, DVector};

use super::cholesky::{Cholesky, is_large};
use super::dense::square;
use super::sparse::solve;
use super::symmetric::SparseSymmetric;

/// A sparse symmetric matrix factored, and what is left of it on its last equations.
pub struct Schur {
    factors: Cholesky,
    /// The last equations, in their order.
    last: Vec<usize>,
    complement: DMatrix<f64>,
    /// R.
    raised: DVector<f64>,
}

/// A right-hand side b from which the first equations are eliminated.
pub struct EliminatedLoad {
    /// (A + R)⁻¹ of b without its last part.
    under: DVector<f64>,
    /// b_l − A_lf A_ff⁻¹ b_f.
    pub last: DVector<f64>,
}

impl Schur {
    /// Factors a matrix with some equations as the last ones; None where A_ff is singular or nearly so, or
    /// S has lost its digits against A_ll.
    pub fn new(matrix: SparseSymmetric, last: Vec<usize>) -> Option<Self> {
        let mut is_last = vec![false; matrix.size()];
        last.iter().for_each(|e| is_last[*e] = true);
        let raised = matrix.diagonal().select_rows(&last);
        let matrix = matrix.map_diagonal(|e, a| if is_last[e] { a + a } else { a });
        let factors = Cholesky::with_last(&matrix, &last)?;
        if !factors.has_large_pivots(&matrix.diagonal()) {
            return None;
        }
        let mut complement = square(&factors.last_block(matrix.size() - last.len()));
        for (k, r) in raised.iter().enumerate() {
            complement[(k, k)] -= r;
            if !is_large(complement[(k, k)], *r) {
                return None;
            }
        }
        Some(Schur { factors, last, complement, raised })
    }

    /// Returns S, in the order of the last equations.
    pub fn complement(&self) -> &DMatrix<f64> {
        &self.complement
    }

    /// Eliminates the first equations from a right-hand side.
    pub fn eliminate(&self, b: &DVector<f64>) -> EliminatedLoad {
        let mut first = b.clone();
        self.last.iter().for_each(|e| first[*e] = 0.0);
        let under = solve(&self.factors, &first);
        // (S + R) x_l is what the first part of b brings to the last equations.
        let last = b.select_rows(&self.last) + self.times_raised(&under.select_rows(&self.last));
        EliminatedLoad { under, last }
    }

    /// Returns the solution on all equations from that on the last ones.
    pub fn expand(&self, load: &EliminatedLoad, last: &DVector<f64>) -> DVector<f64> {
        let missing = self.times_raised(&(last - load.under.select_rows(&self.last)));
        let mut more = DVector::zeros(load.under.len());
        self.last.iter().zip(&missing).for_each(|(e, b)| more[*e] = *b);
        let mut x = solve(&self.factors, &more) + &load.under;
        self.last.iter().zip(last).for_each(|(e, l)| x[*e] = *l);
        x
    }

    /// Returns (S + R) x.
    fn times_raised(&self, x: &DVector<f64>) -> DVector<f64> {
        &self.complement * x + self.raised.component_mul(x)
    }
}
