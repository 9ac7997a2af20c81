//! The assessment of a solution: the largest values of its bodies, estimates of its errors, and its
//! distance from the reference solution. It is computed once; reports only print it.

use std::borrow::Cow;

use super::distance::{Distance, distance};
use super::error::Error;
use super::estimates::{Estimates, Perturbed, perturbed};
use super::hertz::Hertz;
use super::quantities::{BodySummary, summaries};
use super::request::Request;
use super::solution::{Solution, Start};
use super::solve::solve;
use problem::modelling::{ContactModel, Friction, Variant};

/// The values and estimates that reports print beside a solution.
pub struct Assessment<'a> {
    /// The largest values of each body.
    pub bodies: Vec<BodySummary>,
    /// The estimated errors from the mesh; None where they are left out.
    pub estimates: Option<Estimates>,
    /// What changes of the input in the last digits do to the run; None where that was not measured, and of
    /// exact numbers.
    pub rounding: Option<Perturbed>,
    /// The largest difference of a displacement component from a path of half as many steps of the
    /// load, length: what is left of the size of the steps; or why that path has no end. None without a
    /// path, where it says nothing, and where estimates are left out.
    pub path_change: Option<Result<f64, Error>>,
    /// Hertz's contact for the load of the solution; None where his theory does not apply.
    pub hertz: Option<Hertz>,
    /// The comparison with the reference solution, or why there is none; None without contact.
    pub reference: Option<Result<SolutionDistance<'a>, Error>>,
    /// The comparison with the equilibrium under the scene's own friction and geometry, or why
    /// there is none; None without contact, and where that is the reference solution.
    pub equilibrium: Option<Result<SolutionDistance<'a>, Error>>,
}

/// Another solution and the distance of a solution from it.
pub struct SolutionDistance<'a> {
    /// The other solution: borrowed where the assessed solution is that one itself.
    pub reference: Cow<'a, Solution>,
    /// The distance of the assessed solution from the other one.
    pub distance: Distance,
    /// Hertz's contact for the other solution; None where his theory does not apply.
    pub hertz: Option<Hertz>,
}

impl<'a> Assessment<'a> {
    /// Assesses a solution, and solves for the reference solution and for the equilibrium under the scene's
    /// own friction and geometry, unless it is one of them. What rounding does is measured under the paper's
    /// variants; under `unilateral` that may take long, and is asked for.
    pub fn new(solution: &'a Solution) -> Self {
        let request = &solution.request;
        let ((others, half), (estimates, rounding)) = rayon::join(
            || rayon::join(|| others(solution), || half_as_many_steps(request)),
            || rayon::join(|| Estimates::new(solution), || rounding(solution)),
        );
        let path_change = change(half, solution);
        let assessment = Assessment::beside(solution, others);
        Assessment { estimates: Some(estimates), rounding, path_change, ..assessment }
    }

    /// Does the same without the estimates: neither their fields nor `path_change`, which takes
    /// another run, are computed.
    pub fn without_estimates(solution: &'a Solution) -> Self {
        Assessment::beside(solution, others(solution))
    }

    /// Takes a solution as it is: only the largest values of its bodies are computed.
    pub fn none(solution: &'a Solution) -> Self {
        Assessment::beside(solution, [None, None])
    }

    /// Assesses a solution against solutions that are already known: the reference solution, and
    /// the equilibrium under the scene's own friction and geometry.
    pub fn against(solution: &'a Solution, others: [Option<&'a Solution>; 2]) -> Self {
        let estimates = Some(Estimates::new(solution));
        let path_change = change(half_as_many_steps(&solution.request), solution);
        let rounding = rounding(solution);
        let others = others.map(|other| other.map(|other| Ok(Cow::Borrowed(other))));
        Assessment { estimates, rounding, path_change, ..Assessment::beside(solution, others) }
    }

    /// Assesses a solution without estimates beside the reference solution and the equilibrium.
    fn beside(
        solution: &'a Solution,
        [reference, equilibrium]: [Option<OtherSolution<'a>>; 2],
    ) -> Self {
        let measured = |other: Option<OtherSolution<'a>>| {
            Some(other?.map(|reference| SolutionDistance {
                distance: distance(solution, &reference),
                hertz: Hertz::from_solution(&reference),
                reference,
            }))
        };
        let (reference, equilibrium) =
            rayon::join(|| measured(reference), || measured(equilibrium));
        Assessment {
            bodies: summaries(solution),
            estimates: None,
            rounding: None,
            path_change: None,
            hertz: Hertz::from_solution(solution),
            reference,
            equilibrium,
        }
    }

    /// Returns the comparison with the equilibrium under the scene's own friction and geometry,
    /// where that one was solved.
    pub fn own(&self) -> Option<&SolutionDistance<'a>> {
        match &self.equilibrium {
            Some(measured) => measured.as_ref().ok(),
            None => self.measure(),
        }
    }

    /// Returns the error of the mesh in each triangle, over that of a mean one, where errors are
    /// estimated.
    pub fn mesh_error(&self) -> Option<Vec<f64>> {
        self.estimates.as_ref().map(|estimates| estimates.mesh.error_map())
    }

    /// Returns the comparison with the reference solution, where that one was solved.
    pub fn measure(&self) -> Option<&SolutionDistance<'a>> {
        self.reference.as_ref()?.as_ref().ok()
    }
}

/// Another solution, which may be the assessed one itself, or why there is none.
type OtherSolution<'a> = Result<Cow<'a, Solution>, Error>;

/// Returns the reference solution and the equilibrium under the scene's own friction and geometry; None
/// without contact, and of an equilibrium that is the reference solution.
fn others<'a>(solution: &'a Solution) -> [Option<OtherSolution<'a>>; 2] {
    if solution.model.target().is_none() {
        return [None, None];
    }
    let solved = |wanted: &Request| {
        if solution.request.is_same_equilibrium(wanted) {
            Ok(Cow::Borrowed(solution))
        } else {
            solve(wanted, &mut |_| ()).map(Cow::Owned)
        }
    };
    let (reference, own) = (solution.request.reference(), solution.request.equilibrium());
    let has_own = !own.is_same_equilibrium(&reference);
    let (reference, own) = rayon::join(|| solved(&reference), || has_own.then(|| solved(&own)));
    [Some(reference), own]
}

/// Measures what rounding does to a run of the paper's variants; None under `unilateral`.
fn rounding(solution: &Solution) -> Option<Perturbed> {
    match solution.request.variant {
        Variant::Printed | Variant::Tied | Variant::Stepped => perturbed(solution),
        Variant::Unilateral => None,
    }
}

/// Returns the largest difference of displacements at the end of a path of half as many steps from those
/// of a solution, length; None where it says nothing of the size of the steps, as the first of them brings
/// the bodies into contact.
fn change(
    half: Option<Result<Solution, Error>>,
    solution: &Solution,
) -> Option<Result<f64, Error>> {
    let path = solution.equilibrium.as_ref()?.path.as_ref()?;
    let counts = !matches!(path.start, Start::Loose | Start::Overlapping);
    half.filter(|_| counts).map(|half| Ok((half?.u - &solution.u).amax()))
}

/// Follows the path of a request's load in half as many steps; None where these are no whole number.
fn half_as_many_steps(request: &Request) -> Option<Result<Solution, Error>> {
    let ContactModel { friction, load_steps, .. } = request.contact;
    let has_path = request.variant == Variant::Unilateral && friction != Friction::NONE;
    let steps = Some(load_steps / 2).filter(|_| has_path && load_steps % 2 == 0)?;
    let contact = ContactModel { load_steps: steps, ..request.contact };
    Some(solve(&request.clone().contact(contact), &mut |_| ()))
}
