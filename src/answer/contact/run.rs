//! A run of a variant on a scene.

use super::outcome::{Iteration, Outcome, max_displacement, states};
use super::pairing::Pairing;
use super::pressure::Surface;
use super::published::published;
use super::sparse;
use super::support::{against_load, support};
use super::task::Task;
use super::unilateral::{Step, unilateral};
use super::variant::schedule;
use crate::answer::error::Error;
use crate::error::InputError;
use crate::numbers::scalar::{self, Bounded, Exact, F64x2};
use crate::numbers::solve::{Arithmetic, ScalarName, Solver};
use crate::paper::mathcad::array::Column;
use crate::paper::mirror::{Pairs, Reading, Worksheet};
use crate::problem::element::State;
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;

/// Runs `variant` on `scene`; `watch` is called after each iteration.
///
/// # Errors
/// The published algorithm failing as printed, a matrix that cannot be solved, a dense matrix that does not fit; under `unilateral`
/// bodies that contact and restraints do not hold.
pub fn run(
    scene: &Scene,
    variant: Variant,
    reading: &Reading,
    watch: impl FnMut(&Iteration),
) -> Result<Outcome, Error> {
    run_in(scene, variant, reading, Arithmetic::default(), watch)
}

/// The same in other numbers or by another solver.
///
/// # Errors
/// Those of [`run`](fn@run); a rung that the ladder does not have; exact numbers on a scene too large for them.
pub fn run_in(
    scene: &Scene,
    variant: Variant,
    reading: &Reading,
    arithmetic: Arithmetic,
    mut watch: impl FnMut(&Iteration),
) -> Result<Outcome, Error> {
    watched(scene, variant, reading, arithmetic, &mut watch)
}

/// The same, compiled once whatever watches it.
fn watched(
    scene: &Scene,
    variant: Variant,
    reading: &Reading,
    arithmetic: Arithmetic,
    watch: &mut dyn FnMut(&Iteration),
) -> Result<Outcome, Error> {
    arithmetic.check()?;
    let sheet = scene.worksheet(reading)?;
    let task = Task { scene, sheet: &sheet, variant, reading, arithmetic };
    let outcome = match (variant, arithmetic.scalar) {
        (Variant::Unilateral, _) => {
            unilateral_rung(arithmetic)?;
            converged(scene, sheet, reading, watch)?
        }
        (_, ScalarName::F64) => published::<f64>(&task, Some(sparse::cholesky), watch)?,
        (_, ScalarName::F32) => published::<f32>(&task, Some(sparse::cholesky), watch)?,
        (_, ScalarName::F64x2) => published::<F64x2>(&task, Some(sparse::ldlt), watch)?,
        (_, ScalarName::Bounded) => published::<Bounded>(&task, Some(sparse::bounded), watch)?,
        (_, ScalarName::Exact) => scalar::scope(|| published::<Exact>(&task, None, watch))?,
    };
    check_finite(&outcome)?;
    Ok(outcome)
}

/// That `unilateral` is asked for in its own rung: f64, sparse Cholesky.
fn unilateral_rung(arithmetic: Arithmetic) -> Result<(), InputError> {
    if arithmetic.scalar != ScalarName::F64 {
        let what =
            format!("unilateral does not run in {}: normals take square roots", arithmetic.scalar);
        return Err(InputError::new("--scalar", what, "use f64, or another variant"));
    }
    match arithmetic.solver {
        None | Some(Solver::SparseCholesky) => Ok(()),
        Some(other) => {
            let what = format!("unilateral does not solve by {other}");
            Err(InputError::new("--solver", what, "use sparse-cholesky, or another variant"))
        }
    }
}

/// The variant `unilateral`.
fn converged(
    scene: &Scene,
    sheet: Worksheet<f64>,
    reading: &Reading,
    watch: &mut dyn FnMut(&Iteration),
) -> Result<Outcome, Error> {
    let mut iterations = Vec::new();
    let steps = unilateral(scene, &sheet, |step| {
        let iteration = of_step(scene, &sheet, step);
        watch(&iteration);
        iterations.push(iteration);
    })?;
    let factored = steps.len();
    let last = steps.into_iter().next_back().expect("an equilibrium takes an iteration");
    let (dy, pairings) = (closed(&last), &last.after.pairings);
    let current = scene.contact.measures_current_shape();
    let surface = Surface {
        sheet: &sheet,
        thickness: scene.thickness,
        measured_in: if current { &last.after.node_n } else { &sheet.node },
        pairings,
        dy: &dy,
        reaction: &last.reaction,
    };
    let contact = surface.nodes()?;
    let (elements, u) = (states(&sheet, &last.u), last.u);
    let (variant, reading) = (Variant::Unilateral, *reading);
    let schedule = schedule(variant, &reading);
    let model = scene.contact;
    Ok(Outcome {
        variant,
        schedule,
        reading,
        model,
        sheet,
        iterations,
        u,
        elements,
        contact,
        factored,
        arithmetic: Arithmetic::default(),
        digits: None,
        error_bound: None,
    })
}

fn closed(step: &Step) -> Vec<usize> {
    step.closed.iter().map(|closed| usize::from(*closed)).collect()
}

/// An iteration of `unilateral` in the paper's terms: `ct` the edge that a node faces, `yt` the gap along the normal, `dy` 1 where it is closed.
fn of_step(scene: &Scene, sheet: &Worksheet<f64>, step: &Step) -> Iteration {
    let faced = |of: &dyn Fn(&Pairing) -> f64| -> Vec<f64> {
        step.before.pairings.iter().map(|p| p.as_ref().map_or(0.0, of)).collect()
    };
    let pairs = Pairs {
        ct: Column::from_vec(faced(&|p| p.edge as f64).into_iter().map(|e| e as usize).collect()),
        yt: Column::from_vec(faced(&|p| p.gap)),
        dy: Column::from_vec(closed(step)),
        ..Pairs::none(sheet.R())
    };
    let held: Vec<bool> = sheet.S.iter().map(|s| *s == 1).collect();
    Iteration {
        k: step.k,
        node_n: step.before.node_n.clone(),
        in_contact: pairs.dy.iter().sum(),
        pairs,
        ties: step.ties.clone(),
        max_displacement: max_displacement(&step.u),
        cycle: step.cycle.clone(),
        eq1_residual: step.violation,
        eq1_residual_step: step.violation,
        target_force: against_load(scene, support(scene, &held, &step.ties, &step.reaction)),
        solve_residual: step.residual,
    }
}

/// That every displacement, stress and strain can be represented.
fn check_finite(outcome: &Outcome) -> Result<(), InputError> {
    let of_element = |s: &State| (s.von_mises_stress + s.von_mises_strain).is_finite();
    let of_iteration = |it: &Iteration| {
        (it.max_displacement + it.eq1_residual + it.target_force + it.solve_residual).is_finite()
    };
    if outcome.u.iter().all(|x| x.is_finite())
        && outcome.elements.iter().all(of_element)
        && outcome.iterations.iter().all(of_iteration)
    {
        return Ok(());
    }
    let what = "the displacements or stresses are too large to represent";
    Err(InputError::new("loads, materials, mesh", what, "choose other units"))
}
