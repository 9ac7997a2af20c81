//! A run of a variant on a scene, and what comes of it.

use nalgebra::{DVector, SVector};
use serde::Serialize;

use super::elimination::Tie;
use super::pairing::Pairing;
use super::pressure::{ContactNode, Surface};
use super::published::published;
use super::sparse;
use super::support::{against_load, support};
use super::unilateral::{Step, unilateral};
use super::variant::{Model, Variant};
use crate::element::State;
use crate::error::{Error, InputError};
use crate::mathcad::array::{Column, Table};
use crate::mirror::{Failure, Km, Pairs, Reading, Schedule, Worksheet};
use crate::scalar::{self, Bounded, Exact, F64x2, Scalar};
use crate::scene::Scene;
use crate::solve::{Arithmetic, ScalarName, Solver};

/// One iteration.
#[derive(Clone, Debug)]
pub struct Iteration {
    /// Its number, from 1.
    pub k: usize,
    /// The shape that the iteration started from: R x 4, as `node`.
    pub node_n: Table<f64>,
    /// What `c_cnt` found in it.
    pub pairs: Pairs<f64>,
    /// What bound contact nodes to the target, by elimination; empty under `printed`.
    pub ties: Vec<Tie>,
    /// Number of contact nodes with dy = 1.
    pub in_contact: usize,
    /// Largest |u| of a node, total, length.
    pub max_displacement: f64,
    /// Where this contact state (all of k_cnt) was met before.
    pub cycle: Option<Cycle>,
    /// Eq. (1): largest |u_cont − u_targ|, |v_cont − v_targ| over nodes in contact, total displacements, length. Under `unilateral` the
    /// largest gap of a closed node or penetration of another one in the shape that the iteration leads to.
    pub eq1_residual: f64,
    /// The same on what this iteration solved for: the increment where the load is stepped.
    pub eq1_residual_step: f64,
    /// Sum of the reactions of the target body against the direction of the load applied so far, force; 0 without contact.
    pub target_force: f64,
    /// Relative residual |A x − b| / (|A| |x| + |b|) of the solution.
    pub solve_residual: f64,
}

/// A contact state that came before.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Cycle {
    /// Iterations since the state was last met; 1 = it did not change.
    pub length: usize,
    /// Those iterations: the last that had this state, and those between.
    pub members: Vec<usize>,
}

/// The outcome of a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// What was run.
    pub variant: Variant,
    /// What an iteration carried.
    pub schedule: Schedule,
    /// The reading.
    pub reading: Reading,
    /// How contact is modelled beyond what the paper prints.
    pub model: Model,
    /// The paper's arrays.
    pub sheet: Worksheet<f64>,
    /// The iterations.
    pub iterations: Vec<Iteration>,
    /// Displacements of the 2R equations, length.
    pub u: DVector<f64>,
    /// Stresses and strains, by row of `EL`.
    pub elements: Vec<State>,
    /// The contact surface at the end, in the order of `cnt`.
    pub contact: Vec<ContactNode>,
    /// Number of matrices factored: one for each contact state.
    pub factored: usize,
    /// In which numbers and by which solver.
    pub arithmetic: Arithmetic,
    /// `u` in decimal, where the scalar has more digits than an `f64`.
    pub digits: Option<Vec<String>>,
    /// A bound on the largest error of an entry of `u` against the same run without rounding, where the scalar keeps one: it
    /// holds while rounding does not change who is in contact. Length.
    pub error_bound: Option<f64>,
}

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
    watch: impl FnMut(&Iteration),
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

/// What a run of a published variant is given.
pub(super) struct Task<'a> {
    pub scene: &'a Scene,
    pub sheet: &'a Worksheet<f64>,
    pub variant: Variant,
    pub reading: &'a Reading,
    pub arithmetic: Arithmetic,
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
    mut watch: impl FnMut(&Iteration),
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
    let schedule = variant.schedule(&reading);
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

/// `Km` without contact and without restraints: 2R x 2R, force/length.
///
/// # Errors
/// An overflow.
pub fn free_stiffness<T: Scalar>(
    sheet: &Worksheet<T>,
    reading: &Reading,
) -> Result<Table<T>, Failure> {
    let free = Worksheet { S: Column::filled(2 * sheet.R(), 0), ..sheet.clone() };
    Km(&free, reading, &Table::filled(sheet.R(), 4, T::zero()))
}

/// node_n = node + U: R x 4, length.
pub fn shape<T: Scalar>(sheet: &Worksheet<T>, u: &DVector<T>) -> Table<T> {
    let mut node_n = sheet.node.clone();
    for n in 1..=sheet.R() {
        node_n[(n, 2)] += u[2 * n - 2];
        node_n[(n, 3)] += u[2 * n - 1];
    }
    node_n
}

/// Largest |u| of a node.
pub fn max_displacement<T: Scalar>(u: &DVector<T>) -> f64 {
    u.as_slice().chunks(2).map(|u| Scalar::hypot(u[0], u[1])).fold(0.0, f64::max)
}

/// Stresses and strains of every triangle.
pub(super) fn states<T: Scalar>(sheet: &Worksheet<T>, u: &DVector<T>) -> Vec<State> {
    (1..=sheet.M())
        .map(|n| {
            let of_element = SVector::<T, 6>::from_fn(|k, _| {
                u[2 * sheet.EL[(n, sheet.ind_1 + k / 2)] - 2 + k % 2]
            });
            State::new(sheet.plane, sheet.E[n], sheet.nu[n], &sheet.B[n], &of_element)
        })
        .collect()
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
