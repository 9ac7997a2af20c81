//! The cheapest precision that meets an accuracy: each in turn runs, and its displacements are
//! compared with a bound on what rounding did to them. A precision that fails (a number that
//! overflows or vanishes in it, an edge that collapses to a point) only passes on to the next one.
//!
//! Each keeps a bound of its own, and exact numbers have none. `unilateral` runs in f64 only: there is nothing to choose.

use base::error::InputError;
use engine::error::Error;
use engine::estimates::discretisation::Discretisation;
use engine::linear::{Arithmetic, ScalarName, Solver};
use engine::{Request, Solution, max_displacement, solve};
use problem::modelling::{Coupling, Variant};

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
    /// The bound on the rounding error of the displacements, relative to the largest.
    Bound(f64),
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
pub fn solve_to(request: &Request, accuracy: f64) -> Result<AccurateSolution, Error> {
    check_accuracy(accuracy)?;
    let precisions = precisions(request);
    if precisions.is_empty() {
        let what = "unilateral runs in f64 only, whatever the accuracy";
        let fix =
            "ask for another variant, or for --check-rounding, which measures what rounding does";
        return Err(InputError::new("accuracy", what, fix).into());
    }
    let (mut attempts, mut failure) = (Vec::new(), None);
    for arithmetic in precisions {
        let mut add = |rounding| attempts.push(Attempt { arithmetic, rounding });
        if let Some(why) = not_run(request, arithmetic.scalar, accuracy) {
            add(Rounding::NotRun(why));
            continue;
        }
        match solve(&request.clone().arithmetic(arithmetic), &mut |_| ()) {
            Ok(solution) => {
                let bound = relative_bound(&solution);
                add(Rounding::Bound(bound));
                if bound <= accuracy {
                    let mesh = Discretisation::new(&solution.model, &solution.elements);
                    return Ok(AccurateSolution { mesh: mesh.relative(), solution, attempts });
                }
            }
            Err(why) => {
                add(Rounding::Failed(why.to_string().lines().next().unwrap_or_default().into()));
                failure = Some(why);
            }
        }
    }
    let ran = attempts.iter().any(|attempt| matches!(attempt.rounding, Rounding::Bound(_)));
    Err(failure.filter(|_| !ran).unwrap_or_else(|| unmet(accuracy, &attempts).into()))
}

/// The precisions, the cheapest first: none of `unilateral`, of mortar those that have its digits and its roots.
fn precisions(request: &Request) -> Vec<Arithmetic> {
    /// Degrees of freedom up to which `printed`, whose matrix may be indefinite, is solved by LU.
    const DENSE: usize = 600;
    if request.variant == Variant::Unilateral {
        return Vec::new();
    }
    let is_printed = request.variant == Variant::Printed;
    let by_lu = is_printed && request.scene.model.dofs() <= DENSE;
    let is_mortar = request.contact.coupling == Coupling::Mortar && !is_printed;
    let runs = |scalar: &ScalarName| !is_mortar || scalar.properties().no_mortar.is_none();
    let arithmetic = |scalar: ScalarName| {
        let solver =
            if by_lu && !scalar.is_exact() { Solver::DenseLu } else { Solver::SparseCholesky };
        Arithmetic { scalar, solver: Some(solver), ..Arithmetic::default() }
    };
    // Those that bound their own rounding: `f64-bounded` stands for f64, whose digits it has. `f32` is dearer
    // than f64: 1.5 to 2.8 times its time on the strand with 0.4 to 0.1 mm elements, with equal peak memory, as
    // f64 has the better solver.
    let bounds = |scalar: &ScalarName| match scalar {
        ScalarName::Bounded | ScalarName::BoundedDouble | ScalarName::Exact => true,
        ScalarName::F32 | ScalarName::F64 | ScalarName::F64x2 => false,
    };
    let tried = ScalarName::ALL.iter().copied().filter(bounds);
    tried.filter(runs).map(arithmetic).collect()
}

/// Returns why it is pointless to run in `scalar`.
fn not_run(request: &Request, scalar: ScalarName, accuracy: f64) -> Option<String> {
    // Of exact displacements 40 digits are written.
    let digits = scalar.properties().digits.unwrap_or(39);
    if accuracy.log10() < -f64::from(digits) {
        return Some("its digits are too few".into());
    }
    let most = most_exact(request);
    let is_large = scalar.is_exact() && request.scene.model.free_dofs() > most;
    is_large.then(|| format!("it takes too long for more than {most} free equations"))
}

/// Returns the bound on the rounding error of a solution's displacements, with all their digits,
/// relative to the largest one without rounding; infinite where nothing is known.
fn relative_bound(solution: &Solution) -> f64 {
    // Exact numbers have none.
    let bound = solution.error_bound.unwrap_or(0.0);
    if bound == 0.0 {
        return 0.0;
    }
    // A bound holds for each of a displacement's two components.
    let least = max_displacement(&solution.u) - std::f64::consts::SQRT_2 * bound;
    if least > 0.0 { bound / least } else { f64::INFINITY }
}

fn unmet(accuracy: f64, attempts: &[Attempt]) -> InputError {
    let tried = attempts.iter().map(|attempt| {
        let rounding = match &attempt.rounding {
            Rounding::NotRun(why) | Rounding::Failed(why) => why.clone(),
            Rounding::Bound(bound) if bound.is_finite() => format!("within {bound:.0e}"),
            Rounding::Bound(_) => "no bound".into(),
        };
        format!("{}: {rounding}", attempt.arithmetic.scalar)
    });
    let tried: Vec<String> = tried.collect();
    let what = format!("no precision meets an accuracy of {accuracy:e} ({})", tried.join("; "));
    InputError::new("accuracy", what, "ask for less")
}
