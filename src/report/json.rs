//! `result.json`: everything that a machine needs of a run. Floats read back to the same bits.

use serde::Serialize;
use serde_json::{Value, json};

use crate::answer::contact::{
    BodySummary, ContactNode, Cycle, Distance, Hertz, Iteration, Outcome, distance, summaries,
};
use crate::answer::estimates::ErrorBars;
use crate::numbers::solve::Arithmetic;
use crate::paper::mirror::{Pairs, Reading};
use crate::problem::modelling::{Coupling, Friction, Geometry, StatusRule};
use crate::problem::scene::{Scene, Units};
use crate::studies::plan::Plan;

/// The content of `result.json`.
#[derive(Serialize)]
struct Document<'a> {
    scene: &'a str,
    title: &'a str,
    variant: &'static str,
    reading: Value,
    coupling: Coupling,
    friction: Friction,
    geometry: Geometry,
    status: StatusRule,
    units: &'a Units,
    /// Absent: f64 by the variant's own solver.
    #[serde(skip_serializing_if = "Option::is_none")]
    arithmetic: Option<Arithmetic>,
    /// Bound on the error of `u`, where one is kept, length.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_bound: Option<f64>,
    /// What was built and what not, in one line; none where no plan was made.
    #[serde(skip_serializing_if = "Option::is_none")]
    plan: Option<String>,
    /// Sum of the loads, force.
    load: [f64; 2],
    /// Numbers, in the mesh file, of nodes that were dropped.
    dropped: &'a [usize],
    iterations: Vec<Row<'a>>,
    bodies: Vec<BodySummary>,
    /// The contact surface at the end.
    contact: &'a [ContactNode],
    /// Hertz's contact, where his theory applies.
    hertz: Option<Hertz>,
    /// How far its numbers may be from the truth.
    error_bars: Value,
    /// How far the run is from the converged answer; none without contact, and where there is none.
    distance: Option<Distance>,
    /// Displacement of each node, length.
    u: Vec<[f64; 2]>,
    /// The same with all digits, where the scalar has more than an f64.
    #[serde(skip_serializing_if = "Option::is_none")]
    u_digits: Option<Vec<&'a [String]>>,
    elements: Vec<ElementRow>,
}

#[derive(Serialize)]
struct Row<'a> {
    k: usize,
    in_contact: usize,
    dy: &'a [usize],
    max_displacement: f64,
    cycle: &'a Option<Cycle>,
    eq1_residual: f64,
    eq1_residual_step: f64,
    target_force: f64,
    solve_residual: f64,
}

#[derive(Serialize)]
struct ElementRow {
    /// Row of `EL`.
    n: usize,
    sigma: [f64; 3],
    epsilon: [f64; 3],
    von_mises_stress: f64,
    von_mises_strain: f64,
}

/// `result.json` of a run that followed `plan`; `converged` is the answer that it is measured against.
pub fn result(
    scene: &Scene,
    outcome: &Outcome,
    bars: &ErrorBars,
    converged: Option<&Outcome>,
    plan: Option<&Plan>,
) -> String {
    let document = Document {
        scene: &scene.name,
        title: &scene.title,
        variant: outcome.variant.name(),
        reading: reading(outcome),
        coupling: outcome.model.coupling,
        friction: outcome.model.friction,
        geometry: outcome.model.geometry,
        status: outcome.model.status,
        units: &scene.units,
        arithmetic: Some(outcome.arithmetic).filter(|a| !a.is_default()),
        error_bound: outcome.error_bound.filter(|bound| bound.is_finite()),
        plan: plan.map(super::plan::line),
        load: scene.total_load(),
        dropped: &scene.dropped,
        iterations: outcome.iterations.iter().map(row).collect(),
        bodies: summaries(scene, outcome),
        contact: &outcome.contact,
        hertz: Hertz::of(outcome, scene.thickness),
        error_bars: error_bars(bars),
        distance: converged.map(|converged| distance(scene, outcome, converged)),
        u: outcome.u.as_slice().chunks(2).map(|u| [u[0], u[1]]).collect(),
        u_digits: outcome.digits.as_ref().map(|digits| digits.chunks(2).collect()),
        elements: elements(outcome),
    };
    serde_json::to_string(&document).expect("the document has string keys only") + "\n"
}

/// Null stands for a bar that is not known.
fn error_bars(bars: &ErrorBars) -> Value {
    let known = |bar: f64| if bar.is_finite() { json!(bar) } else { Value::Null };
    let bodies = bars.bodies.iter().map(|body| {
        json!({
            "name": body.name, "von_mises_stress": body.value, "recovered": body.recovered,
            "mesh": known(body.mesh), "arithmetic": known(body.arithmetic),
        })
    });
    json!({
        "displacement_arithmetic": known(bars.displacement),
        "mesh_energy_relative": known(bars.mesh.relative()),
        "bodies": bodies.collect::<Vec<_>>(),
    })
}

/// All eight readings as they were in force.
fn reading(outcome: &Outcome) -> Value {
    let Reading { r1, r2, r3, r4, r5, r8, .. } = outcome.reading;
    json!({
        "R1": r1, "R2": r2, "R3": r3, "R4": r4, "R5": r5,
        "R6": outcome.sheet.plane, "R7": outcome.schedule, "R8": r8,
    })
}

fn row(iteration: &Iteration) -> Row<'_> {
    Row {
        k: iteration.k,
        in_contact: iteration.in_contact,
        dy: iteration.pairs.dy.as_slice(),
        max_displacement: iteration.max_displacement,
        cycle: &iteration.cycle,
        eq1_residual: iteration.eq1_residual,
        eq1_residual_step: iteration.eq1_residual_step,
        target_force: iteration.target_force,
        solve_residual: iteration.solve_residual,
    }
}

fn elements(outcome: &Outcome) -> Vec<ElementRow> {
    let rows = outcome.elements.iter().enumerate();
    rows.map(|(k, state)| ElementRow {
        n: k + 1,
        sigma: state.sigma.into(),
        epsilon: state.epsilon.into(),
        von_mises_stress: state.von_mises_stress,
        von_mises_strain: state.von_mises_strain,
    })
    .collect()
}

/// What one call of `c_cnt` found.
pub fn pairs(pairs: &Pairs<f64>) -> String {
    pairs_value(pairs).to_string() + "\n"
}

/// `ct`, `yt`, `dy` by contact node, `k_cnt` by node.
pub fn pairs_value(pairs: &Pairs<f64>) -> Value {
    let k_cnt: Vec<Vec<f64>> =
        (1..=pairs.k_cnt.rows()).map(|n| pairs.k_cnt.row(n).copied().collect()).collect();
    json!({
        "ct": pairs.ct.as_slice(), "yt": pairs.yt.as_slice(), "dy": pairs.dy.as_slice(), "k_cnt": k_cnt,
    })
}
