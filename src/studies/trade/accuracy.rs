//! The cheapest precision that meets an accuracy: each in turn runs, and its displacements are compared with
//! those of the next one that has more digits. A precision that fails (a number that overflows or vanishes in
//! it, an edge that collapses to a point) only passes on to the next one.
//!
//! Exact numbers round nothing. Where they would take too long, what rounding does in f64x2 is what it was
//! seen to do in f64, times what a digit of the one is of a digit of the other. `unilateral` runs in f64
//! only: there is nothing to choose.

use std::cell::OnceCell;

use base::error::InputError;
use engine::error::Result;
use engine::estimates::discretisation::Discretisation;
use engine::linear::{Arithmetic, ScalarName, Solver};
use engine::{Request, Solution, max_displacement, over, solve};
use numbers::scalar::{F64x2, Scalar};
use output::layout::first_line;
use problem::modelling::Variant;

use super::trial::most_exact;

/// A precision that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Attempt {
    pub arithmetic: Arithmetic,
    pub rounding: Rounding,
}

/// What is known of the rounding of an attempt.
#[derive(Clone, Debug, PartialEq)]
pub enum Rounding {
    /// Why it was not run.
    NotRun(String),
    /// Why its run failed.
    Failed(String),
    /// What rounding does to the displacements, relative to the largest; infinite where that is not known.
    Measured(f64),
}

/// A solution of the accuracy that was asked for.
#[derive(Clone, Debug)]
pub struct AccurateSolution {
    /// The solution.
    pub solution: Solution,
    /// What was tried, the last one with success.
    pub attempts: Vec<Attempt>,
    /// The mesh's own error, estimated: relative, in the energy norm; infinite where unknown.
    pub mesh: f64,
}

/// Checks that an accuracy is between 0 and 1.
///
/// # Errors
/// It is not between 0 and 1.
pub fn check_accuracy(accuracy: f64) -> Result<(), InputError> {
    if accuracy > 0.0 && accuracy < 1.0 {
        return Ok(());
    }
    let what = format!("the accuracy {accuracy:e} is not between 0 and 1");
    let fix = "give a relative error of the displacements, as 1e-3";
    Err(InputError::new("accuracy", what, fix))
}

/// Solves `request` in the cheapest precision in which the relative error of the displacements, by
/// rounding alone, is at most `accuracy`; the request's own arithmetic does not count.
///
/// # Errors
/// An accuracy that is not between 0 and 1, or that no precision meets; those of [`solve`]
/// in the last precision where none has a result.
pub fn solve_to(request: &Request, accuracy: f64) -> Result<AccurateSolution> {
    check_accuracy(accuracy)?;
    let precisions = precisions(request);
    if precisions.is_empty() {
        let what = "unilateral runs in f64 only, whatever the accuracy";
        let fix =
            "ask for another variant, or for --check-rounding, which measures what rounding does";
        return Err(InputError::new("accuracy", what, fix).into());
    }
    let mut attempts = Vec::new();
    for (k, precision) in precisions.iter().enumerate() {
        let rounding = precision.rounding(&precisions, k, accuracy);
        let is_met = matches!(rounding, Rounding::Measured(error) if error <= accuracy);
        attempts.push(Attempt { arithmetic: precision.request.arithmetic, rounding });
        if let Some(solution) = precision.solution().filter(|_| is_met) {
            let mesh = Discretisation::new(&solution.model, &solution.elements).relative();
            return Ok(AccurateSolution { mesh, solution: solution.clone(), attempts });
        }
    }
    let ran = precisions.iter().any(|precision| precision.solution().is_some());
    let failure =
        precisions.into_iter().rev().find_map(|precision| precision.run.into_inner()?.err());
    Err(failure.filter(|_| !ran).unwrap_or_else(|| unmet(accuracy, &attempts).into()))
}

/// A precision, which runs when its result is first asked for.
struct Precision {
    request: Request,
    /// Why it is pointless to run in it.
    pointless: Option<String>,
    run: OnceCell<Result<Solution>>,
}

/// The precisions, the cheapest first: none of `unilateral`, of mortar those that have its digits and its
/// roots.
fn precisions(request: &Request) -> Vec<Precision> {
    /// Degrees of freedom up to which `printed`, whose matrix may be indefinite, is solved by LU.
    const DENSE: usize = 600;
    if request.variant == Variant::Unilateral {
        return Vec::new();
    }
    let is_printed = request.variant == Variant::Printed;
    let by_lu = is_printed && request.scene.model.dofs() <= DENSE;
    // `f32` is dearer than f64: 1.5 to 2.8 times its time on the strand with 0.4 to 0.1 mm elements, with
    // equal peak memory, as f64 has the better solver.
    let tried = [ScalarName::F64, ScalarName::F64x2, ScalarName::Exact].into_iter();
    let runs = |scalar: &ScalarName| request.bound_by().is_none_or(|c| scalar.refuses(c).is_none());
    let precision = |scalar: ScalarName| {
        let solver =
            if by_lu && !scalar.is_exact() { Solver::DenseLu } else { Solver::SparseCholesky };
        let arithmetic = Arithmetic { scalar, solver: Some(solver), ..Arithmetic::default() };
        let most = most_exact(request);
        let is_large = scalar.is_exact() && request.scene.model.free_dofs() > most;
        let pointless =
            is_large.then(|| format!("it takes too long for more than {most} free equations"));
        let request = request.clone().arithmetic(arithmetic);
        Precision { request, pointless, run: OnceCell::new() }
    };
    tried.filter(runs).map(precision).collect()
}

impl Precision {
    /// Returns its solution; None where it is pointless to run in it, or the run fails.
    fn solution(&self) -> Option<&Solution> {
        let run = || solve(&self.request, &mut |_| ());
        match self.pointless {
            Some(_) => None,
            None => self.run.get_or_init(run).as_ref().ok(),
        }
    }

    /// Returns what rounding does in it; it is number `k` of the `precisions`.
    fn rounding(&self, precisions: &[Precision], k: usize, accuracy: f64) -> Rounding {
        // Of exact displacements 40 digits are written.
        let scalar = self.request.arithmetic.scalar;
        let digits = scalar.properties().digits.unwrap_or(39);
        if accuracy.log10() < -f64::from(digits) {
            return Rounding::NotRun("its digits are too few".into());
        }
        if let Some(why) = &self.pointless {
            return Rounding::NotRun(why.clone());
        }
        let Some(own) = self.solution() else {
            let why = self.run.get().and_then(|run| run.as_ref().err()).map(ToString::to_string);
            return Rounding::Failed(first_line(&why.unwrap_or_default()).into());
        };
        if scalar.is_exact() {
            return Rounding::Measured(0.0);
        }
        let finer = precisions[k + 1..].iter().find_map(Precision::solution);
        let coarser = precisions[..k].iter().rev().find_map(Precision::solution);
        Rounding::Measured(match (finer, coarser) {
            (Some(finer), _) => away(own, finer),
            (None, Some(coarser)) if same_contact(own, coarser) => {
                away(coarser, own) * <F64x2 as Scalar>::EPSILON / f64::EPSILON
            }
            (None, _) => f64::INFINITY,
        })
    }
}

/// Returns the largest difference of a displacement component from that of a solution with more digits, over
/// the largest displacement of the latter.
fn away(solution: &Solution, finer: &Solution) -> f64 {
    let pairs = solution.exact_displacements().into_iter().zip(finer.exact_displacements());
    let away = pairs.map(|(a, b)| (a - b).to_f64().value().abs()).fold(0.0, f64::max);
    if away == 0.0 { 0.0 } else { over(away, max_displacement(&finer.u)) }
}

/// Returns whether two runs find the same nodes in contact in each iteration.
fn same_contact(one: &Solution, other: &Solution) -> bool {
    one.steps.iter().map(|step| &step.statuses).eq(other.steps.iter().map(|step| &step.statuses))
}

fn unmet(accuracy: f64, attempts: &[Attempt]) -> InputError {
    let tried = attempts.iter().map(|attempt| {
        let rounding = match &attempt.rounding {
            Rounding::NotRun(why) | Rounding::Failed(why) => why.clone(),
            Rounding::Measured(error) if error.is_finite() => format!("measured {error:.0e}"),
            Rounding::Measured(_) => "rounding unknown".into(),
        };
        format!("{}: {rounding}", attempt.arithmetic.scalar)
    });
    let tried: Vec<String> = tried.collect();
    let what = format!("no precision meets an accuracy of {accuracy:e} ({})", tried.join("; "));
    InputError::new("accuracy", what, "ask for less")
}
