//! What `solve` and `listing run c_cnt` report.

mod call;
mod distance;
pub(crate) mod equilibrium;
mod estimates;
mod iterations;
mod result;

pub use call::{figure_numbers, pairs};
pub use distance::distance;
pub use equilibrium::overlap;
pub use estimates::{certainty, error_estimates, perturbed};
pub use result::{PROBABLY_MORE, decimals};

use crate::layout::{counted, listed};
use crate::model::Report;
use crate::numbers::{Digits, six_digits, with_unit};
use crate::quantities;
use engine::contact::{ContactNode, hidden, oddity};
use engine::{
    Assessment, BodySummary, NodeFields, Solution, SupportForce, TriangleValues, beyond_range,
};
use paper::mirror::{Reading, ToleranceUnit};
use problem::model::Model;
use problem::modelling::{ContactModel, Variant};

/// Reports the end of a run: its result, its bodies and its contact surface.
pub fn solution(solution: &Solution, assessment: &Assessment) -> Report {
    summary(solution, assessment).then(details(solution, assessment))
}

/// Reports what was run, and its result.
pub fn summary(solution: &Solution, assessment: &Assessment) -> Report {
    heading(solution).then(result::result(solution, assessment))
}

/// Reports the bodies, the restraints and the contact surface of a run.
pub fn details(solution: &Solution, assessment: &Assessment) -> Report {
    let error = error_of_mesh(assessment);
    Report::default()
        .then(bodies(solution, &assessment.bodies, error))
        .then(reactions(solution))
        .then(contact_surface(solution, error))
}

/// Returns the relative error by which all figures of a run are written: that of the mesh in the energy norm.
fn error_of_mesh(assessment: &Assessment) -> Option<f64> {
    assessment.estimates.as_ref()?.errors.mesh_energy_relative
}

/// Returns the values at all nodes, triangles and contact nodes as tables, which files have.
pub fn fields(solution: &Solution, assessment: &Assessment) -> Report {
    let units = &solution.request.scene.units;
    let values = TriangleValues::all(solution, assessment.mesh_error().as_deref());
    let triangles = quantities::table(&values, TriangleValues::QUANTITIES, units, None);
    let contact = quantities::table(&solution.contact, ContactNode::QUANTITIES, units, None);
    Report::default()
        .table("Nodes", quantities::nodes(&NodeFields::new(solution), units))
        .table("Triangles", triangles.numbered("triangle"))
        .table("Contact", contact)
}

/// Reports how a run came to its end: its iterations, or the steps of its load, of many those that change
/// something unless `all` are asked for.
pub fn steps(solution: &Solution, assessment: &Assessment, all: bool) -> Report {
    let path = solution.equilibrium.as_ref().and_then(|found| found.path.as_ref());
    match path {
        Some(path) => iterations::load_steps(solution, path, assessment, all),
        None => iterations::iterations(solution, assessment, all),
    }
}

/// Names the scene, the variant and the sizes, and what differs from an ordinary run.
fn heading(solution: &Solution) -> Report {
    let (request, model) = (&solution.request, &solution.model);
    let (units, arithmetic) = (&request.scene.units, request.arithmetic);
    let ContactModel { coupling, friction, geometry, .. } = request.contact;
    let is_unilateral = request.variant == Variant::Unilateral && model.has_contact();
    let contact = is_unilateral
        .then(|| format!("contact: {coupling}, friction {friction}, {geometry} geometry"));
    let edited = request.edited.iter();
    let edited =
        edited.map(|edited| format!("with {} as edited in {}", edited.which, edited.place));
    let in_numbers = (!arithmetic.is_default()).then(|| {
        let (solver, inputs) = (request.solver(), arithmetic.inputs);
        format!("in {} by {solver}, inputs {inputs}", arithmetic.scalar)
    });
    // The paper's example is measured in mm.
    let is_in_metres = request.reading.r8 == ToleranceUnit::Metre && units.length != "mm";
    let tolerance = (is_in_metres && model.has_contact()).then(|| {
        let tolerance = with_unit(&six_digits(model.contact.tolerance), &units.length);
        let why = match &*units.length {
            "" => "the scene names no unit of length, and mm is assumed".into(),
            unit => format!("the scene is measured in {unit}, the paper's example in mm"),
        };
        format!("NOTE: R8 = m takes c_tll in metres, which is {tolerance} here: {why}")
    });
    Report::titled(&request.scene.title)
        .line(format!(
            "scene {}, variant {}: {} load, plane {}; {} nodes, {}; {} factored",
            request.scene.name,
            request.variant,
            request.schedule(),
            model.plane,
            model.nodes.len(),
            counted(model.triangles.len(), "triangle", "triangles"),
            counted(solution.factored, "matrix", "matrices")
        ))
        .notes(contact)
        .notes(edited)
        .notes(in_numbers)
        .notes(request.scene.adapted().to_vec())
        .notes(tolerance)
        .notes(dropped(model))
}

/// Names the nodes that were dropped, by their numbers in the mesh file.
fn dropped(model: &Model) -> Option<String> {
    let words = match model.dropped.len() {
        0 => return None,
        1 => ["node", "belongs to no triangle and has no equation"],
        _ => ["nodes", "belong to no triangle and have no equations"],
    };
    Some(format!("Dropped: {} {} of the mesh {}", words[0], listed(&model.dropped), words[1]))
}

/// Says that no node is in contact because of the direction of the target's edges.
fn direction(model: &Model, reading: &Reading, shape: &[[f64; 2]]) -> Option<String> {
    hidden(model, reading, shape).map(|why| format!("No node is in contact: {why}"))
}

fn bodies(solution: &Solution, bodies: &[BodySummary], error: Option<f64>) -> Report {
    let has_equals = bodies.iter().any(|body| body.as_large > 0);
    let shown = BodySummary::QUANTITIES.iter().filter(|q| q.name != "as_large" || has_equals);
    let table = quantities::table(bodies, shown, &solution.request.scene.units, error);
    let beyond = beyond_range(&solution.model, &solution.elements, &solution.u);
    let doubts = solution.request.scene.doubtful_units(beyond.is_some());
    let notes = beyond.into_iter().chain(doubts).map(|what| format!("NOTE: {what}"));
    Report::default().table("Bodies", table).notes(notes)
}

/// Lists what each restraint carries, and compares their sum with the loads.
fn reactions(solution: &Solution) -> Report {
    let rows = SupportForce::all(solution);
    if rows.is_empty() {
        return Report::default();
    }
    let units = &solution.request.scene.units;
    // They balance the loads to rounding, whatever the mesh.
    let error = Some(f64::EPSILON);
    let table = quantities::table(&rows, SupportForce::QUANTITIES, units, error);
    let sum = rows.iter().fold([0.0; 2], |[x, y], row| [x + row.reaction[0], y + row.reaction[1]]);
    let load = solution.model.total_load();
    let size = sum.iter().chain(&load).map(|x| x.abs()).fold(0.0, f64::max);
    let digits = Digits::of(size, error);
    let [sum, load] = [sum, load].map(|vector| {
        let [x, y] = vector.map(|x| digits.write(x));
        with_unit(&format!("{x}, {y}"), &units.force)
    });
    let words = format!("Sum of the reactions {sum}; of the loads {load}");
    Report::default().table("Reactions", table).note(words)
}

/// Lists the nodes in contact at the end.
fn contact_surface(solution: &Solution, error: Option<f64>) -> Report {
    let nodes: Vec<ContactNode> = solution.in_contact().cloned().collect();
    if nodes.is_empty() {
        return Report::default();
    }
    // All of them are in contact.
    let shown = ContactNode::QUANTITIES.iter().filter(|quantity| quantity.name != "dy");
    let table = quantities::table(&nodes, shown, &solution.request.scene.units, error);
    let variant = solution.request.variant;
    let uncoupled = (variant == Variant::Printed).then_some(
        "The pressures are carried by the blocks that Km adds to a body's own equations; nothing \
         couples the bodies (finding K1), so that none of it reaches the other body",
    );
    let unordered = oddity(&solution.model).filter(|_| variant != Variant::Unilateral);
    let unordered = unordered.map(|what| {
        format!(
            "cnt does not follow its surface: {what}; c_cnt takes it as it is (findings C12, C13)"
        )
    });
    Report::default().table("Contact surface", table).notes(uncoupled).notes(unordered)
}
