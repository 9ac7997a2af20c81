//! The assessment of a solution: the largest values of its bodies, estimates of its errors, and its
//! distance from the reference solution. It is computed once; reports only print it.

use std::borrow::Cow;

use super::distance::{Distance, distance};
use super::error::Error;
use super::estimates::ErrorEstimates;
use super::factors::Kept;
use super::hertz::Hertz;
use super::probe::{Probe, probes};
use super::request::Request;
use super::side_by_side::side_by_side;
use super::solution::Solution;
use super::solve::solve;
use super::summary::{BodySummary, summaries};
use crate::error::InputError;
use crate::problem::modelling::ContactModel;

/// The values and estimates that reports print beside a solution.
pub struct Assessment<'a> {
    /// The largest values of each body.
    pub bodies: Vec<BodySummary>,
    /// The estimated errors from rounding and from the mesh; None where they are left out.
    pub estimates: Option<ErrorEstimates>,
    /// What the run says of the points that were asked for: [`Assessment::probe`].
    pub probes: Vec<Probe>,
    /// The change of the largest displacement component against a path of half as many steps of the
    /// load, length: what is left of the size of the steps. None without a path, where there is none
    /// such to compare with, and where estimates are left out.
    pub path_change: Option<f64>,
    /// Hertz's contact for the load of the solution; None where his theory does not apply.
    pub hertz: Option<Hertz>,
    /// The comparison with the reference solution, or why there is none; None without contact.
    pub reference: Option<Result<Measured<'a>, Error>>,
    /// The comparison with the equilibrium under the scene's own friction and geometry, or why
    /// there is none; None without contact, and where that is the reference solution.
    pub equilibrium: Option<Result<Measured<'a>, Error>>,
}

/// Another solution and the distance of a solution from it.
pub struct Measured<'a> {
    /// The other solution: borrowed where the assessed solution is that one itself.
    pub reference: Cow<'a, Solution>,
    /// The distance of the assessed solution from the other one.
    pub distance: Distance,
    /// Hertz's contact for the other solution; None where his theory does not apply.
    pub hertz: Option<Hertz>,
}

impl<'a> Assessment<'a> {
    /// Assesses a solution, and solves for the reference solution and for the equilibrium under the
    /// scene's own friction and geometry, unless it is one of them.
    pub fn new(solution: &'a Solution) -> Self {
        let estimates = || (ErrorEstimates::new(solution), path_change(solution));
        let assessment = || Self::without_estimates(solution);
        let (assessment, (estimates, path_change)) =
            side_by_side(&solution.model, assessment, estimates);
        Assessment { estimates: Some(estimates), path_change, ..assessment }
    }

    /// Does the same without the estimates: neither their fields nor `path_change`, which takes
    /// another run, are computed.
    pub fn without_estimates(solution: &'a Solution) -> Self {
        let request = &solution.request;
        let (reference, equilibrium) = (request.reference(), request.equilibrium());
        let own = (!equilibrium.is_same_equilibrium(&reference)).then_some(equilibrium);
        let solved = |wanted: Request| match request.is_same_equilibrium(&wanted) {
            true => Ok(Cow::Borrowed(solution)),
            false => solve(&wanted, &mut |_| ()).map(|other| Cow::Owned(without_factors(other))),
        };
        let target = solution.model.target();
        let (reference, equilibrium) = side_by_side(
            &solution.model,
            || target.map(|_| solved(reference)),
            || target.and(own).map(solved),
        );
        Assessment::measured(solution, reference, equilibrium)
    }

    /// Assesses a solution against solutions that are already known: the reference solution, and
    /// the equilibrium under the scene's own friction and geometry.
    pub fn against(
        solution: &'a Solution,
        [reference, equilibrium]: [Option<&'a Solution>; 2],
    ) -> Self {
        let known = |other: Option<&'a Solution>| other.map(|other| Ok(Cow::Borrowed(other)));
        let (estimates, path_change) = (ErrorEstimates::new(solution), path_change(solution));
        let assessment = Assessment::measured(solution, known(reference), known(equilibrium));
        Assessment { estimates: Some(estimates), path_change, ..assessment }
    }

    fn measured(
        solution: &'a Solution,
        reference: Option<Result<Cow<'a, Solution>, Error>>,
        equilibrium: Option<Result<Cow<'a, Solution>, Error>>,
    ) -> Self {
        let measured = |other: Option<Result<Cow<'a, Solution>, Error>>| {
            other.map(|other| other.map(|other| Measured::new(solution, other)))
        };
        Assessment {
            bodies: summaries(solution),
            estimates: None,
            probes: Vec::new(),
            path_change: None,
            hertz: Hertz::of(solution),
            reference: measured(reference),
            equilibrium: measured(equilibrium),
        }
    }

    /// Adds what `solution`, which is assessed, says of `points` of the undeformed shape.
    ///
    /// # Errors
    /// A point lies outside every body.
    pub fn probe(&mut self, solution: &Solution, points: &[[f64; 2]]) -> Result<(), InputError> {
        if points.is_empty() {
            return Ok(());
        }
        let own = self.estimates.is_none().then(|| ErrorEstimates::new(solution));
        let estimates = self.estimates.as_ref().or(own.as_ref()).expect("one of the two");
        self.probes = probes(solution, estimates, points)?;
        Ok(())
    }

    /// Returns the comparison with the equilibrium under the scene's own friction and geometry,
    /// where that one was solved.
    pub fn own(&self) -> Option<&Measured<'a>> {
        match &self.equilibrium {
            Some(measured) => measured.as_ref().ok(),
            None => self.measure(),
        }
    }

    /// Returns the comparison with the reference solution, where that one was solved.
    pub fn measure(&self) -> Option<&Measured<'a>> {
        self.reference.as_ref()?.as_ref().ok()
    }
}

/// Returns a solution without what only its own estimates need: large factors.
fn without_factors(solution: Solution) -> Solution {
    Solution { factors: Kept::default(), ..solution }
}

/// Follows the path of the load in half as many steps.
fn path_change(solution: &Solution) -> Option<f64> {
    let path = solution.equilibrium.as_ref()?.path.as_ref()?;
    if path.steps % 2 == 1 {
        return None;
    }
    let contact = ContactModel { load_steps: path.steps / 2, ..solution.request.contact };
    let other = solve(&solution.request.clone().contact(contact), &mut |_| ()).ok()?;
    Some((&other.u - &solution.u).amax())
}

impl<'a> Measured<'a> {
    fn new(solution: &Solution, reference: Cow<'a, Solution>) -> Self {
        let (distance, hertz) = (distance(solution, &reference), Hertz::of(&reference));
        Measured { reference, distance, hertz }
    }
}
