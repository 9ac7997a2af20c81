//! `result.json`: everything that a machine needs of a run. Floats read back to the same bits.

use serde::Serialize;
use serde_json::{Value, json};

use crate::answer::contact::ContactNode;
use crate::answer::estimates::ErrorEstimates;
use crate::answer::{Assessment, BodySummary, Cycle, Distance, Hertz, Solution, Step};
use crate::numbers::scalar::rational;
use crate::numbers::solve::{Arithmetic, ScalarName};
use crate::paper::mirror::{Pairs, Reading};
use crate::problem::modelling::{Coupling, Friction, Geometry, StatusRule};
use crate::problem::scene::Units;
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
    bodies: &'a [BodySummary],
    /// The contact surface at the end.
    contact: &'a [ContactNode],
    /// Hertz's contact, where his theory applies.
    hertz: Option<&'a Hertz>,
    /// How far its numbers may be from the truth.
    error_bars: Value,
    /// How far the run is from the converged answer; none without contact, and where there is none.
    distance: Option<&'a Distance>,
    /// Displacement of each node, length.
    u: Vec<[f64; 2]>,
    /// The same with all digits, where the scalar has more than an f64.
    #[serde(skip_serializing_if = "Option::is_none")]
    u_digits: Option<Vec<Vec<String>>>,
    elements: Vec<ElementRow>,
}

#[derive(Serialize)]
struct Row<'a> {
    k: usize,
    in_contact: usize,
    dy: Vec<u8>,
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

/// `result.json` of a run that followed `plan`.
pub fn result(solution: &Solution, assessment: &Assessment, plan: Option<&Plan>) -> String {
    let request = &solution.request;
    let (scene, contact) = (&request.scene, request.contact);
    let document = Document {
        scene: &scene.name,
        title: &scene.title,
        variant: request.variant.name(),
        reading: reading(solution),
        coupling: contact.coupling,
        friction: contact.friction,
        geometry: contact.geometry,
        status: contact.status,
        units: &scene.units,
        arithmetic: Some(request.arithmetic).filter(|a| !a.is_default()),
        error_bound: solution.error_bound.filter(|bound| bound.is_finite()),
        plan: plan.map(super::plan::line),
        load: solution.model.total_load(),
        dropped: &scene.dropped,
        iterations: solution.steps.iter().map(row).collect(),
        bodies: &assessment.bodies,
        contact: &solution.contact,
        hertz: assessment.hertz.as_ref(),
        error_bars: error_bars(&assessment.estimates),
        distance: assessment.measure().map(|measured| &measured.distance),
        u: solution.displacements(),
        u_digits: digits(solution),
        elements: elements(solution),
    };
    serde_json::to_string(&document).expect("the document has string keys only") + "\n"
}

/// Displacements of each node in decimal, where the scalar has more digits than an `f64`.
fn digits(solution: &Solution) -> Option<Vec<Vec<String>>> {
    let digits = match solution.request.arithmetic.scalar {
        ScalarName::Exact => 40,
        _ => 32,
    };
    let of_node = |u: &[_]| u.iter().map(|u| rational::decimal(u, digits)).collect();
    Some(solution.digits.as_ref()?.chunks(2).map(of_node).collect())
}

/// Null stands for a bar that is not known.
fn error_bars(bars: &ErrorEstimates) -> Value {
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
fn reading(solution: &Solution) -> Value {
    let Reading { r1, r2, r3, r4, r5, r8, .. } = solution.request.reading;
    json!({
        "R1": r1, "R2": r2, "R3": r3, "R4": r4, "R5": r5,
        "R6": solution.model.plane, "R7": solution.request.schedule(), "R8": r8,
    })
}

fn row(step: &Step) -> Row<'_> {
    Row {
        k: step.k,
        in_contact: step.in_contact,
        dy: step.statuses().into_iter().map(u8::from).collect(),
        max_displacement: step.max_displacement,
        cycle: &step.cycle,
        eq1_residual: step.contact_residual(),
        eq1_residual_step: step.contact_residual_step(),
        target_force: step.target_force,
        solve_residual: step.solve_residual,
    }
}

fn elements(solution: &Solution) -> Vec<ElementRow> {
    let rows = solution.elements.iter().enumerate();
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
