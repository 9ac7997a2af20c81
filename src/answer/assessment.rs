//! What is said of a solution once it is there: the largest values of its bodies, estimates of its
//! errors, and its distance from the reference solution. Computed once; reports only print it.

use std::borrow::Cow;

use super::distance::{Distance, distance};
use super::error::Error;
use super::estimates::ErrorBars;
use super::hertz::Hertz;
use super::solution::Solution;
use super::solve::reference;
use super::summary::{BodySummary, summaries};
use crate::problem::modelling::{Coupling, Variant};

/// What is said of a solution.
pub struct Assessment<'a> {
    /// The largest values of each body.
    pub bodies: Vec<BodySummary>,
    /// What rounding and the mesh do to its numbers.
    pub estimates: ErrorBars,
    /// Hertz's contact, where his theory applies.
    pub hertz: Option<Hertz>,
    /// What it is measured against, or why there is none; nothing without contact.
    pub reference: Option<Result<Measured<'a>, Error>>,
}

/// What a solution is measured against.
pub struct Measured<'a> {
    /// The reference solution; the solution itself where it is that.
    pub reference: Cow<'a, Solution>,
    /// How far the solution is from it.
    pub distance: Distance,
    /// Hertz's contact for the reference solution, where his theory applies.
    pub hertz: Option<Hertz>,
}

impl<'a> Assessment<'a> {
    /// Assesses a solution; solves for the reference solution where that is another one.
    pub fn new(solution: &'a Solution) -> Self {
        let request = &solution.request;
        let is_reference =
            (request.variant, request.contact.coupling) == (Variant::Unilateral, Coupling::Mortar);
        let other = || match is_reference {
            true => Ok(Cow::Borrowed(solution)),
            false => reference(request).map(Cow::Owned),
        };
        Assessment::measured(solution, solution.model.target().map(|_| other()))
    }

    /// Assesses a solution against a reference solution that is there already.
    pub fn against(solution: &'a Solution, reference: Option<&'a Solution>) -> Self {
        Assessment::measured(solution, reference.map(|reference| Ok(Cow::Borrowed(reference))))
    }

    fn measured(
        solution: &'a Solution,
        reference: Option<Result<Cow<'a, Solution>, Error>>,
    ) -> Self {
        Assessment {
            bodies: summaries(solution),
            estimates: ErrorBars::new(solution),
            hertz: Hertz::of(solution),
            reference: reference.map(|reference| reference.map(|r| Measured::new(solution, r))),
        }
    }

    /// What it is measured against, where there is such a solution.
    pub fn measure(&self) -> Option<&Measured<'a>> {
        self.reference.as_ref()?.as_ref().ok()
    }
}

impl<'a> Measured<'a> {
    fn new(solution: &Solution, reference: Cow<'a, Solution>) -> Self {
        let (distance, hertz) = (distance(solution, &reference), Hertz::of(&reference));
        Measured { reference, distance, hertz }
    }
}
