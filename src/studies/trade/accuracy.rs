//! The cheapest rung that meets an accuracy: predicted, checked afterwards, climbed where it is missed.
//!
//! Rounding at unit eps moves x by at most |A⁻¹| (|A| |x| + |b|) times some eps, entry by entry: this amplification is estimated once, on the
//! contact state of the initial shape, for the prediction, and again on the last contact state of the run for the check. Of n roundings, as many
//! go up as down: they add up to some sqrt(n) of them, not to n. A rung that keeps a bound of its own (`f64-bounded`) is checked by that; it
//! and the estimate hold while rounding does not change who is in contact.

use nalgebra::DVector;
use serde::Serialize;

use crate::answer::contact::{
    Elimination, Outcome, Stiffness, Tie, max_displacement, run_in, ties,
};
use crate::answer::error::Error;
use crate::answer::estimates::discretisation::Discretisation;
use crate::error::InputError;
use crate::numbers::solve::{
    Arithmetic, Factors, ScalarName, Solver, SparseCholesky, inverse_norm,
};
use crate::paper::mirror::{Reading, Worksheet, c_cnt};
use crate::problem::modelling::{Coupling, Variant};
use crate::problem::scene::Scene;

/// Roundings of an entry of the matrix and of the solution that add up, in units of the scalar's eps: a handful of operations by
/// element, some six elements a node.
const ROUNDINGS: f64 = 16.0;

/// A rung that was tried, relative to the largest displacement.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Attempt {
    /// In which numbers, by which solver.
    pub arithmetic: Arithmetic,
    /// The error that was predicted.
    pub predicted: f64,
    /// The bar that was found; nothing where the prediction was already too large, so that the rung was not run.
    pub found: Option<f64>,
    /// Whether the bar is a bound, not an estimate.
    pub bound: bool,
}

/// A run that meets an accuracy.
#[derive(Clone, Debug)]
pub struct Reached {
    /// The run.
    pub outcome: Outcome,
    /// What was tried, the last one with success.
    pub attempts: Vec<Attempt>,
    /// The mesh's own error, estimated: relative, in the energy norm; infinite where nothing is known.
    pub mesh: f64,
}

/// Runs `variant` by the cheapest rung whose relative error of the displacements, of rounding alone, is at most `accuracy`.
///
/// # Errors
/// Those of [`run_in`]; an accuracy that is not between 0 and 1, or that no rung meets.
pub fn solve_to(
    scene: &Scene,
    variant: Variant,
    reading: &Reading,
    accuracy: f64,
) -> Result<Reached, Error> {
    if !(accuracy > 0.0 && accuracy < 1.0) {
        let what = format!("the accuracy {accuracy:e} is not between 0 and 1");
        let mend = "give a relative error of the displacements, as 1e-3";
        return Err(InputError::new("--accuracy", what, mend).into());
    }
    let sheet = scene.worksheet(reading)?;
    let state = first_ties(&sheet, reading);
    let amplification = amplification(scene, &sheet, &state, None).unwrap_or(1.0);
    let mut attempts = Vec::new();
    for arithmetic in rungs(scene, variant) {
        let predicted = ROUNDINGS * eps(arithmetic.scalar) * amplification;
        let mut attempt = Attempt { arithmetic, predicted, found: None, bound: false };
        if predicted <= accuracy {
            let outcome = match run_in(scene, variant, reading, arithmetic, |_| ()) {
                // What is singular to few digits need not be so to more.
                Err(Error::Singular(_)) if arithmetic.scalar == ScalarName::F32 => {
                    attempts.push(attempt);
                    continue;
                }
                run => run?,
            };
            let (bar, bound) = bar(scene, &outcome);
            (attempt.found, attempt.bound) = (Some(bar), bound);
            if bar <= accuracy {
                attempts.push(attempt);
                let mesh = Discretisation::new(&outcome.sheet, &outcome.elements).relative();
                return Ok(Reached { outcome, attempts, mesh });
            }
        }
        attempts.push(attempt);
    }
    Err(unmet(accuracy, &attempts).into())
}

/// The rungs, the cheapest first. `unilateral` and mortar run in f64 only.
fn rungs(scene: &Scene, variant: Variant) -> Vec<Arithmetic> {
    let rung = |scalar| Arithmetic {
        scalar,
        solver: Some(Solver::SparseCholesky),
        ..Arithmetic::default()
    };
    if variant == Variant::Unilateral || scene.contact.coupling == Coupling::Mortar {
        return vec![rung(ScalarName::F64)];
    }
    [ScalarName::F32, ScalarName::Bounded, ScalarName::F64x2].map(rung).to_vec()
}

/// The unit of rounding.
fn eps(scalar: ScalarName) -> f64 {
    match scalar {
        ScalarName::F32 => f64::from(f32::EPSILON) / 2.0,
        ScalarName::F64 | ScalarName::Bounded => f64::EPSILON / 2.0,
        ScalarName::F64x2 => f64::EPSILON * f64::EPSILON,
        ScalarName::Exact => 0.0,
    }
}

/// The error bar of a run, relative to its largest displacement, and whether it is a bound. The one place that asks for it.
fn bar(scene: &Scene, outcome: &Outcome) -> (f64, bool) {
    let largest = max_displacement(&outcome.u);
    if let Some(bound) = outcome.error_bound {
        return (if bound == 0.0 { 0.0 } else { bound / largest }, true);
    }
    let last = outcome.iterations.last().expect("a run has an iteration");
    let residual = outcome.iterations.iter().map(|it| it.solve_residual).fold(0.0, f64::max);
    let amplification =
        amplification(scene, &outcome.sheet, &last.ties, Some(&outcome.u)).unwrap_or(f64::INFINITY);
    ((residual + ROUNDINGS * eps(outcome.arithmetic.scalar)) * amplification, false)
}

/// Eq. (1) for what `c_cnt` finds in the initial shape; nothing where it fails, as the run then does.
fn first_ties(sheet: &Worksheet<f64>, reading: &Reading) -> Vec<Tie> {
    if sheet.cnt.rows() == 0 {
        return Vec::new();
    }
    c_cnt(sheet, reading, &sheet.node).map_or(Vec::new(), |pairs| ties(sheet, &pairs))
}

/// The largest entry of |A⁻¹| (|A| |x| + |b|) over the largest of x and over sqrt(n), A of n equations being the stiffness under `ties`; nothing where it is singular. `u`:
/// the displacements, else those under the whole load.
fn amplification(
    scene: &Scene,
    sheet: &Worksheet<f64>,
    ties: &[Tie],
    u: Option<&DVector<f64>>,
) -> Option<f64> {
    let t = Elimination::new(sheet, ties);
    let matrix = Stiffness::new(sheet).reduced(&t);
    let b = t.load(&scene.free_load());
    let factors = SparseCholesky::new(matrix.clone()).ok()?;
    let x = match u {
        Some(u) => DVector::from_fn(t.size(), |k, _| u[t.equation(k)]),
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
    let tried: Vec<String> = attempts
        .iter()
        .map(|a| format!("{} {:.0e}", a.arithmetic.scalar, a.found.unwrap_or(a.predicted)))
        .collect();
    let what = format!("no rung meets an accuracy of {accuracy:e}: {}", tried.join(", "));
    InputError::new("--accuracy", what, "ask for less, or run --scalar exact")
}
