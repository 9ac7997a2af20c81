//! The cheapest precision that meets an accuracy: its error is predicted, checked afterwards, and
//! where it is too large the next precision is tried.
//!
//! Rounding at unit eps moves x by at most |A⁻¹| (|A| |x| + |b|) times some eps, entry by entry:
//! this amplification is estimated once, on the contact state of the initial shape, for the
//! prediction, and again on the last contact state of the run for the check. Of n roundings, as
//! many go up as down: they add up to some sqrt(n) of them, not to n. A precision that keeps a
//! bound of its own (`f64-bounded`) is checked by that; it and the estimate hold while rounding
//! does not change who is in contact.

use nalgebra::DVector;
use serde::Serialize;

use super::trials::sparse;
use crate::answer::error::Error;
use crate::answer::estimates::discretisation::Discretisation;
use crate::answer::{
    Constraint, Elimination, Request, Solution, Stiffness, max_displacement, solve,
};
use crate::error::InputError;
use crate::numbers::solve::{Arithmetic, Factors, ScalarName, SparseCholesky, inverse_norm};
use crate::paper::door::{self, Call};
use crate::paper::mirror::Reading;
use crate::problem::model::Model;
use crate::problem::modelling::{Coupling, Variant};

/// Roundings of an entry of the matrix and of the solution that add up, in units of the scalar's
/// eps: a handful of operations by element, some six elements a node.
const ROUNDINGS: f64 = 16.0;

/// A precision that was tried, and its errors relative to the largest displacement.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Attempt {
    pub arithmetic: Arithmetic,
    pub predicted: f64,
    /// The error estimate or bound of the run; nothing where the prediction was already too large,
    /// so that nothing was run.
    pub found: Option<f64>,
    /// Whether what was found is a bound, not an estimate.
    pub bound: bool,
}

#[derive(Clone, Debug)]
pub struct Reached {
    pub solution: Solution,
    /// What was tried, the last one with success.
    pub attempts: Vec<Attempt>,
    /// The mesh's own error, estimated: relative, in the energy norm; infinite where unknown.
    pub mesh: f64,
}

/// Solves `request` in the cheapest precision in which the relative error of the displacements, by
/// rounding alone, is at most `accuracy`; the request's own arithmetic does not count.
/// Errors: those of [`solve`]; an accuracy that is not between 0 and 1, or that no precision meets.
pub fn solve_to(request: &Request, accuracy: f64) -> Result<Reached, Error> {
    if !(accuracy > 0.0 && accuracy < 1.0) {
        let what = format!("the accuracy {accuracy:e} is not between 0 and 1");
        let fix = "give a relative error of the displacements, as 1e-3";
        return Err(InputError::new("--accuracy", what, fix).into());
    }
    let model = request.model()?;
    let constraints = first_constraints(&model, &request.reading);
    let amplification = amplification(&model, &constraints, None).unwrap_or(1.0);
    let mut attempts = Vec::new();
    for arithmetic in precisions(request) {
        let predicted = ROUNDINGS * eps(arithmetic.scalar) * amplification;
        let not_run = Attempt { arithmetic, predicted, found: None, bound: false };
        if predicted.is_nan() || predicted > accuracy {
            attempts.push(not_run);
            continue;
        }
        let solution = match solve(&request.clone().arithmetic(arithmetic), &mut |_| ()) {
            // What is singular to few digits need not be so to more.
            Err(Error::Singular(_)) if arithmetic.scalar == ScalarName::F32 => {
                attempts.push(not_run);
                continue;
            }
            solved => solved?,
        };
        let (error, bound) = rounding_error(&solution);
        attempts.push(Attempt { found: Some(error), bound, ..not_run });
        if error <= accuracy {
            let mesh = Discretisation::new(&solution.model, &solution.elements).relative();
            return Ok(Reached { solution, attempts, mesh });
        }
    }
    Err(unmet(accuracy, &attempts).into())
}

/// The precisions, the cheapest first. `unilateral` and mortar run in f64 only.
fn precisions(request: &Request) -> Vec<Arithmetic> {
    let mortar = request.contact.coupling == Coupling::Mortar;
    if request.variant == Variant::Unilateral || mortar {
        return vec![sparse(ScalarName::F64)];
    }
    [ScalarName::F32, ScalarName::Bounded, ScalarName::F64x2].map(sparse).to_vec()
}

/// The largest relative error of one rounding.
fn eps(scalar: ScalarName) -> f64 {
    match scalar {
        ScalarName::F32 => f64::from(f32::EPSILON) / 2.0,
        ScalarName::F64 | ScalarName::Bounded => f64::EPSILON / 2.0,
        ScalarName::F64x2 | ScalarName::BoundedDouble => f64::EPSILON * f64::EPSILON,
        ScalarName::Exact => 0.0,
    }
}

/// The error of a solution by rounding, estimated or bounded, relative to its largest displacement,
/// and whether it is a bound.
fn rounding_error(solution: &Solution) -> (f64, bool) {
    let largest = max_displacement(&solution.u);
    if let Some(bound) = solution.error_bound {
        return (if bound == 0.0 { 0.0 } else { bound / largest }, true);
    }
    let constraints = &solution.last().constraints;
    let residual = solution.steps.iter().map(|step| step.solve_residual).fold(0.0, f64::max);
    let amplification = amplification(&solution.model, constraints, Some(&solution.u));
    let rounding = ROUNDINGS * eps(solution.request.arithmetic.scalar);
    ((residual + rounding) * amplification.unwrap_or(f64::INFINITY), false)
}

/// Eq. (1) for what the listing finds in the initial shape; nothing where it and the run fail.
fn first_constraints(model: &Model, reading: &Reading) -> Vec<Constraint> {
    let call = model.has_contact().then(|| Call::c_cnt(model, reading, &model.nodes).ok());
    let linked = call.flatten().map_or(Vec::new(), |call| door::linked(&call.sheet, &call.pairs));
    linked.into_iter().map(Constraint::from).collect()
}

/// The largest entry of |A⁻¹| (|A| |x| + |b|) over the largest of x and over sqrt(n), A of n
/// equations being the stiffness under `constraints`; nothing where it is singular. `u`: the
/// displacements, else those under the whole load.
fn amplification(
    model: &Model,
    constraints: &[Constraint],
    u: Option<&DVector<f64>>,
) -> Option<f64> {
    let t = Elimination::new(&model.restrained, constraints);
    let matrix = Stiffness::new(model, |x| x).reduced(&t);
    let b = t.load(&model.free_load());
    let factors = SparseCholesky::new(matrix.clone()).ok()?;
    let x = match u {
        Some(u) => DVector::from_fn(t.size(), |k, _| u[t.dof(k).index()]),
        None => factors.solve(&b),
    };
    let mut w = b.map(f64::abs);
    for (i, j, a) in matrix.entries() {
        w[i] += a.abs() * x[j].abs();
        if i != j {
            w[j] += a.abs() * x[i].abs();
        }
    }
    let amplified = inverse_norm(&factors as &dyn Factors<f64>, &w);
    if amplified == 0.0 { Some(0.0) } else { Some(amplified / x.amax() / (t.size() as f64).sqrt()) }
}

fn unmet(accuracy: f64, attempts: &[Attempt]) -> InputError {
    let error = |a: &Attempt| a.found.unwrap_or(a.predicted);
    let tried = attempts.iter().map(|a| format!("{} {:.0e}", a.arithmetic.scalar, error(a)));
    let tried: Vec<String> = tried.collect();
    let what = format!("no precision meets an accuracy of {accuracy:e}: {}", tried.join(", "));
    InputError::new("--accuracy", what, "ask for less, or run --scalar exact")
}
