//! A run of a variant on a scene, and what comes of it.

use nalgebra::{DVector, SVector};
use serde::Serialize;

use super::pairing::Pairing;
use super::pressure::{ContactNode, contact_nodes};
use super::published::published;
use super::support::{against_load, support};
use super::unilateral::{Step, unilateral};
use super::variant::Variant;
use crate::element::State;
use crate::error::{Error, InputError};
use crate::mathcad::array::{Column, Table};
use crate::mirror::{Failure, Km, Pairs, Reading, Schedule, Worksheet};
use crate::scene::Scene;

/// One iteration.
#[derive(Clone, Debug)]
pub struct Iteration {
    /// Its number, from 1.
    pub k: usize,
    /// The shape that the iteration started from: R x 4, as `node`.
    pub node_n: Table<f64>,
    /// What `c_cnt` found in it.
    pub pairs: Pairs<f64>,
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
    let sheet = scene.worksheet(reading)?;
    let outcome = match variant {
        Variant::Unilateral => converged(scene, sheet, reading, watch)?,
        _ => published(scene, sheet, variant, reading, watch)?,
    };
    check_finite(&outcome)?;
    Ok(outcome)
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
    let contact = contact_nodes(&sheet, scene.thickness, pairings, &dy, &last.reaction);
    let (elements, u) = (states(&sheet, &last.u), last.u);
    let (variant, reading) = (Variant::Unilateral, *reading);
    let schedule = variant.schedule(&reading);
    Ok(Outcome { variant, schedule, reading, sheet, iterations, u, elements, contact, factored })
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
pub fn free_stiffness(sheet: &Worksheet<f64>, reading: &Reading) -> Result<Table<f64>, Failure> {
    let free = Worksheet { S: Column::filled(2 * sheet.R(), 0), ..sheet.clone() };
    Km(&free, reading, &Table::filled(sheet.R(), 4, 0.0))
}

/// node_n = node + U: R x 4, length.
pub fn shape(sheet: &Worksheet<f64>, u: &DVector<f64>) -> Table<f64> {
    let mut node_n = sheet.node.clone();
    for n in 1..=sheet.R() {
        node_n[(n, 2)] += u[2 * n - 2];
        node_n[(n, 3)] += u[2 * n - 1];
    }
    node_n
}

/// Largest |u| of a node.
pub fn max_displacement(u: &DVector<f64>) -> f64 {
    u.as_slice().chunks(2).map(|u| u[0].hypot(u[1])).fold(0.0, f64::max)
}

/// Stresses and strains of every triangle.
pub(super) fn states(sheet: &Worksheet<f64>, u: &DVector<f64>) -> Vec<State> {
    (1..=sheet.M())
        .map(|n| {
            let of_element = SVector::<f64, 6>::from_fn(|k, _| {
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
