//! What `solve` and `listing run c_cnt` report.

mod call;
mod distance;
mod equilibrium;
mod estimates;
mod iterations;

pub use call::{figure_numbers, pairs};
pub use distance::distance;
pub use equilibrium::nearest_decision;
pub use estimates::{UNDERESTIMATE, certainty, error_estimates, perturbed};

use crate::layout::{counted, listed};
use crate::model::Report;
use crate::numbers::{short, with_unit};
use crate::quantities;
use engine::contact::{ContactNode, hidden, oddity};
use engine::{Assessment, BodySummary, Solution, SupportForce, beyond_range};
use paper::mirror::Reading;
use problem::model::Model;
use problem::modelling::{ContactModel, Variant};

/// What is said of a run in which contact passes no load on.
const NOTHING_TRANSMITTED: &str =
    "Nothing transmitted: no load reaches the target, an audit result";

/// Reports the end of a run: what is in contact, whether that is the only equilibrium, its bodies and its
/// contact surface.
pub fn solution(solution: &Solution, assessment: &Assessment) -> Report {
    let equilibrium = solution.equilibrium.as_ref();
    heading(solution)
        .then(contact_set(solution))
        .then(equilibrium.map_or(Report::default(), |found| equilibrium::lines(solution, found)))
        .then(bodies(solution, &assessment.bodies))
        .then(reactions(solution))
        .then(contact_surface(solution))
}

/// Reports how a run came to its end: its iterations, or the steps of its load.
pub fn steps(solution: &Solution, assessment: &Assessment) -> Report {
    let path = solution.equilibrium.as_ref().and_then(|found| found.path.as_ref());
    match path {
        Some(path) => iterations::load_steps(solution, path, assessment),
        None => iterations::iterations(solution),
    }
}

/// Names the scene, the variant and the sizes, and what differs from an ordinary run.
fn heading(solution: &Solution) -> Report {
    let (request, model) = (&solution.request, &solution.model);
    let edited = request.edited.iter();
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
        .notes(contact(solution))
        .notes(edited.map(|edited| format!("with {} as edited in {}", edited.which, edited.place)))
        .notes(arithmetic(solution))
        .notes(request.scene.adapted().to_vec())
        .notes(dropped(model))
}

/// Names how contact is modelled under `unilateral`.
fn contact(solution: &Solution) -> Option<String> {
    let ContactModel { coupling, friction, geometry, .. } = solution.request.contact;
    let is_used = solution.request.variant == Variant::Unilateral && solution.model.has_contact();
    is_used.then(|| format!("contact: {coupling}, friction {friction}, {geometry} geometry"))
}

/// Names the arithmetic, unless it is the default, and its bound on rounding errors.
fn arithmetic(solution: &Solution) -> Vec<String> {
    let arithmetic = solution.request.arithmetic;
    let bound = solution.error_bound.map(|bound| match bound.is_finite() {
        true => format!(
            "rounding changes no displacement by more than {bound:.1e} {}",
            solution.request.scene.units.length
        ),
        false => "rounding error unknown".into(),
    });
    let other = (!arithmetic.is_default()).then(|| {
        let (solver, inputs) = (solution.request.solver(), arithmetic.inputs);
        format!("in {} by {solver}, inputs {inputs}", arithmetic.scalar)
    });
    other.into_iter().chain(bound).collect()
}

/// Names the nodes that were dropped, by their numbers in the mesh file.
fn dropped(model: &Model) -> Option<String> {
    let nodes = listed(&model.dropped);
    (!nodes.is_empty()).then(|| {
        format!("Dropped: nodes {nodes} of the mesh belong to no triangle and have no equations")
    })
}

/// Names the nodes in contact at the end.
fn contact_set(solution: &Solution) -> Report {
    if solution.model.target().is_none() {
        return Report::default();
    }
    let nodes = match solution.last().contact_set(&solution.model) {
        nodes if nodes.is_empty() => "no node".into(),
        nodes => format!("nodes {}", listed(nodes)),
    };
    let is_printed = solution.request.is_as_printed();
    let (reading, shape) = (&solution.request.reading, &solution.last().shape);
    let hidden = is_printed.then(|| direction(&solution.model, reading, shape)).flatten();
    let transmitted = solution.transmits_nothing().then_some(NOTHING_TRANSMITTED);
    Report::default()
        .notes(transmitted)
        .notes(hidden)
        .line(format!("In contact at the end: {nodes}"))
        .notes(peak(solution))
}

/// Names the contact node under the largest pressure. The pressures of `printed` stay in the contact body.
fn peak(solution: &Solution) -> Option<String> {
    let pressed = solution.in_contact().filter_map(|node| Some((node.pressure?, node)));
    let (pressure, at) = pressed.max_by(|(a, _), (b, _)| a.total_cmp(b))?;
    let units = &solution.request.scene.units;
    let [x, y] = solution.model.nodes[at.node.index()].map(short);
    let place = with_unit(&format!("{x}, {y}"), &units.length);
    let pressure = with_unit(&short(pressure), &units.stress);
    (solution.request.variant != Variant::Printed)
        .then(|| format!("Peak contact pressure {pressure} at node {}: {place}", at.node))
}

/// Says that no node is in contact because of the direction of the target's edges.
fn direction(model: &Model, reading: &Reading, shape: &[[f64; 2]]) -> Option<String> {
    hidden(model, reading, shape).map(|why| format!("No node is in contact: {why}"))
}

fn bodies(solution: &Solution, bodies: &[BodySummary]) -> Report {
    let table = quantities::table(bodies, BodySummary::QUANTITIES, &solution.request.scene.units);
    let beyond = beyond_range(&solution.model, &solution.elements, &solution.u);
    Report::default().table("Bodies", table).notes(beyond.map(|what| format!("NOTE: {what}")))
}

/// Lists what each restraint carries, and compares their sum with the loads.
fn reactions(solution: &Solution) -> Report {
    let rows = SupportForce::all(solution);
    if rows.is_empty() {
        return Report::default();
    }
    let units = &solution.request.scene.units;
    let table = quantities::table(&rows, SupportForce::QUANTITIES, units);
    let vector = |[x, y]: [f64; 2]| with_unit(&format!("{}, {}", short(x), short(y)), &units.force);
    let sum = rows.iter().fold([0.0; 2], |[x, y], row| [x + row.reaction[0], y + row.reaction[1]]);
    let load = solution.model.total_load();
    Report::default().table("Reactions", table).line(format!(
        "Sum of the reactions {}; of the loads {}",
        vector(sum),
        vector(load)
    ))
}

/// Lists the nodes in contact at the end.
fn contact_surface(solution: &Solution) -> Report {
    let nodes: Vec<ContactNode> = solution.in_contact().cloned().collect();
    if nodes.is_empty() {
        return Report::default();
    }
    // All of them are in contact.
    let shown = ContactNode::QUANTITIES.iter().filter(|quantity| quantity.name != "dy");
    let table = quantities::table(&nodes, shown, &solution.request.scene.units);
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
