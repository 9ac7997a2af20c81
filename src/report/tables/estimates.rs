//! How far the numbers of a run may be from the truth.

use crate::layout::counted;
use crate::model::Report;
use crate::numbers::{or_dash, percent, short, uncertain, with_unit};
use engine::estimates::{BodyEstimates, Certainty, ErrorEstimates, NoLimit};
use engine::{Assessment, Decision, Solution, locking};
use problem::modelling::Variant;
use problem::scene::Units;

/// The relative error of the mesh in the energy norm beyond which the estimates that rest on it
/// missed the truth now and then (`engine::estimates::discretisation`).
const FAIR: f64 = 0.2;

/// Says in which numbers a run is done where rounding in f64 may decide who is in contact.
pub fn certainty(certainty: Certainty) -> Option<String> {
    let numbers = match certainty {
        Certainty::Certain => return None,
        Certainty::InDoubleDouble => "this is the run in double-doubles, where it decides nothing",
        Certainty::Unknown => "in no other numbers is it known not to",
    };
    Some(format!("rounding in f64 may decide who is in contact; {numbers}"))
}

/// Reports the estimated errors; nothing where they were left out.
pub fn error_estimates(solution: &Solution, assessment: &Assessment) -> Report {
    let Some(estimates) = &assessment.estimates else { return Report::default() };
    let errors = &estimates.errors;
    let units = &solution.request.scene.units;
    let is_estimate = solution.model.has_contact() && errors.displacement_mesh.is_some();
    let contact = is_estimate
        .then_some("with contact an estimate and no bound: contact changes with the mesh");
    contact
        .into_iter()
        .fold(
            Report::default()
                .heading("Error estimates")
                .note(displacement(assessment, errors, units)),
            Report::detail,
        )
        .notes(errors.bodies.iter().map(|body| stress(body, units)))
        .note(error_of_mesh(solution, errors))
        .notes(by_rounding(solution, errors.decided_by_rounding.as_deref()))
        .notes(rechecked(solution))
}

fn displacement(assessment: &Assessment, errors: &ErrorEstimates, units: &Units) -> String {
    let largest = assessment.bodies.iter().map(|body| body.max_displacement).fold(0.0, f64::max);
    let value = match errors.displacement_no_limit {
        Some((node, cause)) => format!(
            "{} on this mesh; in the plane it diverges under refinement: at node {node}, {cause}",
            with_unit(&short(largest), &units.length)
        ),
        None => uncertain(
            largest,
            &units.length,
            &[(errors.displacement_mesh, "mesh"), (errors.displacement_arithmetic, "arithmetic")],
        ),
    };
    format!("largest |u|: {value}")
}

fn stress(body: &BodyEstimates, units: &Units) -> String {
    let errors = [(body.mesh, "mesh"), (body.arithmetic, "arithmetic")];
    let bounded = uncertain(body.von_mises_stress, &units.stress, &errors);
    let value = match &body.no_limit {
        Some(NoLimit { node, cause, is_largest: true }) => format!(
            "{} on this mesh; it {} under refinement: at node {node}, {cause}",
            with_unit(&short(body.von_mises_stress), &units.stress),
            cause.diverges()
        ),
        Some(NoLimit { node, cause, is_largest: false }) => {
            let diverges = cause.diverges();
            format!(
                "{bounded}, away from node {node}, {cause}, where it {diverges} under refinement"
            )
        }
        None => bounded,
    };
    format!("largest von Mises stress, {}: {value}", body.name)
}

/// Says the error of the mesh in the energy norm, and how far it is to be relied on.
fn error_of_mesh(solution: &Solution, errors: &ErrorEstimates) -> String {
    let Some(relative) = errors.mesh_energy_relative else {
        let model = &solution.model;
        let locks = model.triangles.iter().find_map(|t| locking(model.plane, t.material.nu));
        let why = locks.unwrap_or("a body is too small for an estimate".into());
        return format!("error of the mesh: unknown: {why}");
    };
    let how_far = if relative > FAIR {
        ": too coarse for its estimates to be relied on"
    } else if errors.bodies.iter().any(|body| body.no_limit.is_some()) {
        ": too low where the stress diverges; trade --only mesh measures it"
    } else {
        ""
    };
    format!("error of the mesh: {} in the energy norm{how_far}", percent(relative, 1))
}

/// Says what rounding may have decided: the first decision, and how many there are.
fn by_rounding(solution: &Solution, decisions: Option<&[Decision]>) -> Option<String> {
    let Some(decisions) = decisions else {
        return Some("who is in contact: whether rounding decides it is not known".into());
    };
    let Decision { iteration, node, condition, margin, bound } = decisions.first()?;
    let length = |x: f64| with_unit(&format!("{x:.1e}"), &solution.request.scene.units.length);
    let margin = margin.map_or(String::new(), |margin| {
        format!(" (margin {}, bound {})", length(margin), or_dash(*bound, length))
    });
    let times = counted(decisions.len(), "time", "times");
    Some(format!(
        "who is in contact: rounding may have decided {times}, first in iteration {iteration} at node \
         {node}: {condition}{margin}"
    ))
}

/// Says in which iterations of `unilateral` the decisions on contact were checked for rounding.
fn rechecked(solution: &Solution) -> Option<&'static str> {
    let is_unilateral = solution.request.variant == Variant::Unilateral;
    (is_unilateral && solution.model.has_contact()).then(|| match solution.depends_on_path() {
        true => "who is in contact: rechecked in each iteration, between the faces of a corner too",
        false => {
            "who is in contact: rechecked in the last state, between the faces of a corner too; the \
             states before do not count, as there is no other equilibrium"
        }
    })
}
