//! The reduced equations Tᵀ K T q = f, solved by the factors of the condensed bodies, by factors of
//! their own, or by those of nearly the same equations, with refinement.

use std::cell::RefCell;
use std::rc::Rc;

use nalgebra::DVector;

use super::problem::Problem;
use crate::answer::condensation::refined;
use crate::answer::contact::Status;
use crate::answer::elimination::{Constraint, Elimination};
use crate::answer::stiffness::Stiffness;
use crate::numbers::solve::{Factors, Singular, SparseCholesky};

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
pub(super) struct Last(RefCell<Option<(Vec<Held>, Rc<Made>)>>);

/// Factors, and the norm of their matrix, force/length.
struct Made {
    factors: Box<dyn Factors<f64>>,
    norm: f64,
}

/// The reduced equations under imposed statuses.
pub(super) struct Reduced<'a> {
    problem: &'a Problem<'a>,
    t: &'a Elimination,
    factors: RefCell<Rc<Made>>,
    held: Vec<Held>,
}

impl<'a> Reduced<'a> {
    /// Takes the last factors where the statuses hold the same motions, else factors anew.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn new(
        problem: &'a Problem,
        t: &'a Elimination,
        constraints: &[Constraint],
        statuses: &[Status],
    ) -> Result<Self, Singular> {
        let held = |status: &Status| match status {
            Status::Open => Held::Nothing,
            Status::Slip(_) => Held::Normal,
            Status::Stick => Held::Both,
        };
        let held: Vec<Held> = statuses.iter().map(held).collect();
        let last = problem.last.0.borrow();
        let same = last.as_ref().filter(|(same, _)| *same == held).map(|(_, made)| made.clone());
        drop(last);
        let bound = || {
            let (stiffness, model) = (&problem.stiffness, problem.model);
            let bound = problem.bodies.factors(stiffness, model, t, constraints)?;
            Some(Made { norm: bound.norm(), factors: Box::new(bound) })
        };
        let factors = match same {
            Some(factors) => factors,
            None => Rc::new(bound().map_or_else(|| factored(&problem.stiffness, t), Ok)?),
        };
        let reduced = Reduced { problem, t, factors: RefCell::new(factors), held };
        reduced.keep();
        Ok(reduced)
    }

    /// Keeps the factors for other shapes and loads.
    fn keep(&self) {
        let made = Rc::clone(&self.factors.borrow());
        self.problem.last.0.replace(Some((self.held.clone(), made)));
    }

    /// Returns q, and its relative residual.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(super) fn solve(&self, f: &DVector<f64>) -> Result<(DVector<f64>, f64), Singular> {
        let stiffness = &self.problem.stiffness;
        let solve = |made: &Made| refined(stiffness, self.t, &*made.factors, made.norm, f);
        let first = Rc::clone(&self.factors.borrow());
        if let Ok(solved) = solve(&first) {
            return Ok(solved);
        }
        self.factors.replace(Rc::new(factored(stiffness, self.t)?));
        self.keep();
        let solved = solve(&self.factors.borrow());
        Ok(solved.unwrap_or_else(|best| best))
    }
}

/// Factors the whole matrix.
fn factored(stiffness: &Stiffness, t: &Elimination) -> Result<Made, Singular> {
    let matrix = stiffness.reduced(t);
    let norm = matrix.norm();
    Ok(Made { factors: Box::new(SparseCholesky::new(matrix)?), norm })
}
