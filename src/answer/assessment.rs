//! The assessment of a solution: the largest values of its bodies, estimates of its errors, and its
//! distance from the reference solution. It is computed once; reports only print it.

use std::borrow::Cow;

use super::distance::{Distance, distance};
use super::error::Error;
use super::estimates::ErrorEstimates;
use super::hertz::Hertz;
use super::solution::Solution;
use super::solve::reference;
use super::summary::{BodySummary, summaries};
use crate::problem::modelling::{Coupling, Variant};

/// The values and estimates that reports print beside a solution.
pub struct Assessment<'a> {
    /// The largest values of each body.
    pub bodies: Vec<BodySummary>,
    /// The estimated errors from rounding and from the mesh.
    pub estimates: ErrorEstimates,
    /// Hertz's contact for the load of the solution; None where his theory does not apply.
    pub hertz: Option<Hertz>,
    /// The comparison with the reference solution, or why there is none; None without contact.
    pub reference: Option<Result<Measured<'a>, Error>>,
}

/// The reference solution and the distance of a solution from it.
pub struct Measured<'a> {
    /// The reference solution: borrowed where the assessed solution is the reference itself.
    pub reference: Cow<'a, Solution>,
    /// The distance of the assessed solution from the reference solution.
    pub distance: Distance,
    /// Hertz's contact for the reference solution; None where his theory does not apply.
    pub hertz: Option<Hertz>,
}

impl<'a> Assessment<'a> {
    /// Assesses a solution, and solves for the reference solution unless it is the same request.
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

    /// Assesses a solution against a reference solution that is already known.
    pub fn against(solution: &'a Solution, reference: Option<&'a Solution>) -> Self {
        Assessment::measured(solution, reference.map(|reference| Ok(Cow::Borrowed(reference))))
    }

    fn measured(
        solution: &'a Solution,
        reference: Option<Result<Cow<'a, Solution>, Error>>,
    ) -> Self {
        Assessment {
            bodies: summaries(solution),
            estimates: ErrorEstimates::new(solution),
            hertz: Hertz::of(solution),
            reference: reference.map(|reference| reference.map(|r| Measured::new(solution, r))),
        }
    }

    /// Returns the comparison with the reference solution, where that one was solved.
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
