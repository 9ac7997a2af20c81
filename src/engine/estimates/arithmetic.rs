//! The arithmetic error: the effect of rounding on displacements and stresses, under the variants that the
//! paper describes. Under `unilateral` it is measured (`perturbed.rs`).
//!
//! A run is repeated in numbers with a running bound on the error, `f64` ([`Bounded`]) or where the
//! run has more digits double-double, by the solver that is the scalar's own. The bound of that run and
//! its distance from the assessed run bound the error of the latter, whatever its numbers and its
//! solver, where no decision on who is in contact is left to rounding and both runs decided alike.

use nalgebra::{DVector, SVector};
use serde::Serialize;

use crate::linear::{Arithmetic, ScalarName};
use crate::{Decision, Detail, Request, Solution, Step, StepBounds, Stiffness, solve};
use numbers::finite;
use numbers::scalar::{Bounded, Scalar};
use problem::element::Plane;
use problem::model::Model;
use problem::modelling::Variant;

/// The number of roundings in a von Mises value from its stresses, in units of 2^-53.
const ROUNDINGS: f64 = 32.0;

/// What rounding may do to a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounding {
    /// A bound on the error of any displacement, length; None where nothing is known, as where
    /// rounding may have decided who is in contact.
    pub displacement: Option<f64>,
    /// The decisions on who is in contact that rounding may have taken; None where that is not known.
    pub decisions: Option<Vec<Decision>>,
    /// The bounds of each step; None from the first decision on that rounding may have taken.
    pub steps: Vec<Option<StepBounds>>,
}

/// Whether rounding decides who is in contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Certainty {
    /// It decides nothing.
    Certain,
    /// It may decide in the numbers asked for, and decides nothing in the double-doubles in which
    /// the run was repeated.
    InDoubleDouble,
    /// It may decide, or whether it does is not known.
    Unknown,
    /// Under `unilateral` it was not looked at: [`perturbed`](super::perturbed) measures it.
    Unchecked,
}

/// Returns the solution itself where rounding decides nothing in it, else that of the same request in
/// double-doubles where it decides nothing there, and which of the two it is. Under `unilateral` the
/// solution stays as it is.
pub fn certain(solution: Solution) -> (Solution, Certainty) {
    match rounding(&solution) {
        None => return (solution, Certainty::Unchecked),
        Some(Rounding { displacement: Some(_), .. }) => return (solution, Certainty::Certain),
        Some(_) => (),
    }
    let arithmetic = Arithmetic {
        scalar: ScalarName::BoundedDouble,
        solver: None,
        ..solution.request.arithmetic
    };
    let request = Request { arithmetic, ..solution.request.clone() };
    match solve(&request, &mut |_| ()) {
        Ok(again) if again.error_bound.is_some_and(f64::is_finite) => {
            (again, Certainty::InDoubleDouble)
        }
        // A run that rounding may lead elsewhere, or to a failure, shows nothing of this one.
        Ok(_) | Err(_) => (solution, Certainty::Unknown),
    }
}

/// Returns the stiffness of each triangle with a bound on its rounding.
pub fn bounded(model: &Model) -> Stiffness<Bounded> {
    Stiffness::new(model, Bounded::from_f64)
}

/// Returns what rounding may do to a solution of a variant that the paper describes; None under
/// `unilateral`.
pub fn rounding(solution: &Solution) -> Option<Rounding> {
    let request = &solution.request;
    if request.variant == Variant::Unilateral {
        return None;
    }
    if !request.arithmetic.scalar.is_exact() {
        return Some(repeated_run_rounding(solution));
    }
    // What is rounded is the displacements themselves, to be written as f64.
    Some(Rounding {
        displacement: Some(solution.u.amax() * f64::EPSILON / 2.0),
        decisions: Some(Vec::new()),
        steps: solution.steps.iter().map(written).collect(),
    })
}

fn repeated_run_rounding(solution: &Solution) -> Rounding {
    let Some(again) = bounded_run(solution) else {
        return Rounding::unknown(solution);
    };
    let undecided = again.steps.iter().map(|step| step.undecided().map(<[Decision]>::to_vec));
    let undecided: Option<Vec<Vec<Decision>>> = undecided.collect();
    let decisions = undecided.map(|undecided| {
        undecided
            .into_iter()
            .flatten()
            .chain(first_divergence(solution, &again))
            .collect::<Vec<_>>()
    });
    let is_certain = decisions.as_ref().is_some_and(Vec::is_empty);
    let bound = again.error_bound.filter(|_| is_certain).unwrap_or(f64::INFINITY);
    // Digits beyond those of an f64 are rounded away in `u`.
    let written = if again.digits.is_some() { f64::EPSILON / 2.0 } else { 0.0 };
    let u = again.u.map(|u| Bounded::new(u, bound + written * u.abs()));
    let first = decisions.iter().flatten().map(|decision| decision.iteration).min();
    let is_before = |k: usize| decisions.is_some() && first.is_none_or(|first| k < first);
    let pairs = solution.steps.iter().zip(&again.steps);
    let steps = pairs.map(|(own, other)| step_bounds(own, other).filter(|_| is_before(own.k)));
    let steps = steps.collect();
    Rounding { displacement: finite(error(solution, &u)), decisions, steps }
}

/// Returns the bounds of a step whose numbers only their writing as `f64` rounds.
fn written(step: &Step) -> Option<StepBounds> {
    let Detail::Published(own) = &step.detail else { return None };
    let half = |largest: f64| largest * f64::EPSILON / 2.0;
    let largest = |values: &[f64]| values.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    Some(StepBounds {
        yt: half(largest(own.pairs.yt.as_slice())),
        weights: half(own.pairs.k_cnt().as_matrix().amax()),
        u: half(step.max_displacement),
    })
}

/// Returns the bounds of a step from the same step in numbers that keep them: theirs, and how far
/// those numbers are from its own.
fn step_bounds(own: &Step, other: &Step) -> Option<StepBounds> {
    let (Detail::Published(a), Detail::Published(b)) = (&own.detail, &other.detail) else {
        return None;
    };
    let far = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs() + f64::EPSILON * b.abs()))
    };
    let bounds = b.bounds?;
    let steps = [own.max_displacement, other.max_displacement];
    Some(StepBounds {
        yt: bounds.yt + far(a.pairs.yt.as_slice(), b.pairs.yt.as_slice()),
        weights: bounds.weights
            + far(a.pairs.k_cnt().as_matrix().as_slice(), b.pairs.k_cnt().as_matrix().as_slice()),
        // |u| of a node moves by at most sqrt(2) of a component.
        u: 1.5 * bounds.u + far(&steps[..1], &steps[1..]),
    })
}

impl Rounding {
    fn unknown(solution: &Solution) -> Self {
        let steps = vec![None; solution.steps.len()];
        Rounding { displacement: None, decisions: None, steps }
    }
}

/// Returns the first iteration and node whose edge or status differs from that of the same run in
/// numbers with a bound.
fn first_divergence(solution: &Solution, again: &Solution) -> Option<Decision> {
    solution.steps.iter().zip(&again.steps).find_map(|(own, other)| {
        let (Detail::Published(a), Detail::Published(b)) = (&own.detail, &other.detail) else {
            return None;
        };
        let at = a.pairs.first_difference(&b.pairs)?;
        let node = solution.model.contact.nodes[at];
        let scalar = again.request.arithmetic.scalar;
        let condition = format!("the edge or status is another one in {scalar}");
        Some(Decision { iteration: own.k, node, condition, margin: None, bound: None })
    })
}

/// Returns the largest distance of a displacement from one that is known within a bound, length.
fn error(solution: &Solution, u: &DVector<Bounded>) -> f64 {
    let error = |e: usize| (u[e].to_f64() - solution.u[e]).abs() + u[e].error();
    (0..u.len()).map(error).fold(0.0, f64::max)
}

/// Repeats the run with a bound on each displacement; None where it fails, as nothing is known then.
fn bounded_run(solution: &Solution) -> Option<Solution> {
    let own = solution.request.arithmetic;
    let arithmetic = Arithmetic {
        scalar: match own.scalar {
            ScalarName::F64x2 | ScalarName::BoundedDouble => ScalarName::BoundedDouble,
            ScalarName::F32 | ScalarName::F64 | ScalarName::Bounded | ScalarName::Exact => {
                ScalarName::Bounded
            }
        },
        inputs: own.inputs,
        ..Arithmetic::default()
    };
    let request = Request { arithmetic, ..solution.request.clone() };
    solve(&request, &mut |_| ()).ok()
}

/// Returns, for each triangle, a bound on the error of its von Mises stress where displacements are
/// known to `displacement`, stress.
pub fn stress_bounds(
    solution: &Solution,
    stiffness: &Stiffness<Bounded>,
    displacement: Option<f64>,
) -> Vec<f64> {
    let model = &*solution.model;
    let u = solution.u.map(|u| Bounded::new(u, displacement.unwrap_or(f64::INFINITY)));
    let stresses = stiffness.stresses(&u);
    let triangles = model.triangles.iter().zip(&stresses).zip(&solution.elements);
    triangles
        .map(|((triangle, stress), state)| {
            let rounding = ROUNDINGS * f64::EPSILON / 2.0 * state.von_mises_stress;
            von_mises_bound(model, triangle.material.nu, stress) + rounding
        })
        .collect()
}

/// Returns the von Mises value of a stress's error bounds. The von Mises values of two stresses
/// differ by at most that of their difference, because it is a seminorm.
fn von_mises_bound(model: &Model, nu: f64, stress: &SVector<Bounded, 3>) -> f64 {
    let [x, y, xy] = [0, 1, 2].map(|k| stress[k].error());
    let z = match model.plane {
        Plane::Strain => nu.abs() * (x + y),
        Plane::Stress => 0.0,
    };
    let squares = (x + y).powi(2) + (y + z).powi(2) + (z + x).powi(2);
    (squares / 2.0 + 3.0 * xy * xy).sqrt()
}
