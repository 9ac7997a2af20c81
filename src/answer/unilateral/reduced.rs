//! The reduced equations Tᵀ K T q = f, solved by factors of their own or by those of nearly the same
//! equations, with refinement.

use std::cell::RefCell;
use std::rc::Rc;

use nalgebra::DVector;

use crate::answer::contact::Status;
use crate::answer::elimination::Elimination;
use crate::answer::stiffness::Stiffness;
use crate::numbers::solve::{Singular, SparseCholesky, backward_error};

/// The relative residual at which refinement ends.
const REFINED: f64 = 4.0 * f64::EPSILON;

/// The relative residual that is enough where refinement brings no more.
const ENOUGH: f64 = 32.0 * f64::EPSILON;

/// The part of its residual to which a step of refinement must bring the next one; equations that
/// differ more are factored anew.
const CONTRACTION: f64 = 0.2;

/// What a status holds of a node's motion: nothing, the one along the normal, or both.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Held {
    Nothing,
    Normal,
    Both,
}

/// The factors that were made last, and the statuses under which they were made. Other shapes and
/// loads under statuses that hold the same motions have equations that are the same or nearly so.
#[derive(Default)]
pub(super) struct Last(RefCell<Option<(Vec<Held>, Rc<Factors>)>>);

/// Factors, and the norm of their matrix, force/length.
struct Factors {
    cholesky: SparseCholesky,
    norm: f64,
}

/// The reduced equations under imposed statuses.
pub(super) struct Reduced<'a> {
    stiffness: &'a Stiffness,
    t: &'a Elimination,
    factors: RefCell<Rc<Factors>>,
    last: &'a Last,
    held: Vec<Held>,
}

impl<'a> Reduced<'a> {
    /// Takes the last factors where the statuses hold the same motions, else factors anew.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn new(
        stiffness: &'a Stiffness,
        t: &'a Elimination,
        statuses: &[Status],
        last: &'a Last,
    ) -> Result<Self, Singular> {
        let held = |status: &Status| match status {
            Status::Open => Held::Nothing,
            Status::Slip(_) => Held::Normal,
            Status::Stick => Held::Both,
        };
        let held: Vec<Held> = statuses.iter().map(held).collect();
        let same =
            last.0.borrow().as_ref().filter(|(same, _)| *same == held).map(|(_, f)| f.clone());
        let factors = match same {
            Some(factors) => factors,
            None => Rc::new(factored(stiffness, t)?),
        };
        *last.0.borrow_mut() = Some((held.clone(), Rc::clone(&factors)));
        Ok(Reduced { stiffness, t, factors: RefCell::new(factors), last, held })
    }

    /// Returns q, and its relative residual.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn solve(&self, f: &DVector<f64>) -> Result<(DVector<f64>, f64), Singular> {
        let first = Rc::clone(&self.factors.borrow());
        if let Some(solved) = self.refined(&first, f) {
            return Ok(solved);
        }
        let factors = Rc::new(factored(self.stiffness, self.t)?);
        *self.last.0.borrow_mut() = Some((self.held.clone(), Rc::clone(&factors)));
        *self.factors.borrow_mut() = Rc::clone(&factors);
        let q = factors.cholesky.solve(f);
        let residual = factors.cholesky.residual(&q, f);
        Ok((q, residual))
    }

    /// Refines by factors; None where they are too far from those of these equations.
    fn refined(&self, factors: &Factors, f: &DVector<f64>) -> Option<(DVector<f64>, f64)> {
        let mut q = factors.cholesky.solve(f);
        let mut before = f64::INFINITY;
        loop {
            let rest = f - self.times(&q);
            let error = backward_error(&rest, factors.norm, &q, f);
            if error <= REFINED || (error <= ENOUGH && error > CONTRACTION * before) {
                return Some((q, error));
            }
            if error.is_nan() || error > CONTRACTION * before {
                return None;
            }
            before = error;
            q += factors.cholesky.solve(&rest);
        }
    }

    /// Returns Tᵀ K T q.
    fn times(&self, q: &DVector<f64>) -> DVector<f64> {
        self.t.load(&self.stiffness.times(&(self.t.expand(q) - self.t.shift())))
    }
}

fn factored(stiffness: &Stiffness, t: &Elimination) -> Result<Factors, Singular> {
    let matrix = stiffness.reduced(t);
    let norm = matrix.norm();
    Ok(Factors { cholesky: SparseCholesky::new(matrix)?, norm })
}
