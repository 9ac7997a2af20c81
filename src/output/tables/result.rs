//! What a reader asks of a run first.

use std::collections::BTreeSet;

use super::{direction, equilibrium, error_of_mesh};
use crate::layout::{counted, listed};
use crate::model::Report;
use crate::numbers::{
    Digits, coordinates, decimals_of_places, figure, percent, six_digits, with_unit,
};
use engine::estimates::{Cause, NoLimit, contact_ends};
use engine::{Assessment, Cycle, Resultant, Solution, Stretch, locking_of, share_of_load};
use numbers::largest::largest;
use problem::model::NodeId;
use problem::modelling::{Friction, Variant};

/// What is said of the estimate of the error of the mesh.
pub const PROBABLY_MORE: &str = "probably more";

/// The cosine of the angle from the load up to which a contact force carries it, rather than acts across it:
/// 45 degrees.
const ALONG: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The most stretches of contact that have a line each.
const MOST_STRETCHES: usize = 10;

/// Reports whether contact passes the load on, its pressure and width, the largest displacement and stresses,
/// how exact they are, and whether this is the only equilibrium.
pub fn result(solution: &Solution, assessment: &Assessment) -> Report {
    let error = error_of_mesh(assessment);
    let ends = contact_ends(solution);
    let report = Report::default()
        .heading("Result")
        .notes(equilibrium::overlap(solution))
        .notes(equilibrium::initial_gaps(&solution.model, &solution.request.scene.units))
        .notes(locking_of(&solution.model).map(|why| format!("NOTE: {why}")))
        .notes(group_ends(solution, &ends))
        .notes(passes_on(solution))
        .notes(in_contact(solution))
        .notes(resultant(solution))
        .notes(peak(solution, &ends, error))
        .then(width(solution))
        .notes(displacement(assessment, solution, error))
        .notes(stresses(assessment, solution, error))
        .notes(mesh_error(assessment, solution, error));
    match &solution.equilibrium {
        Some(found) => report.then(equilibrium::lines(solution, found)),
        None => report.notes(end(solution)).notes(from_equilibrium(assessment)),
    }
}

/// Says first where nothing is in contact, or passes the load on; else how much of the load that is.
fn passes_on(solution: &Solution) -> Option<String> {
    solution.model.target()?;
    let none = solution.touches_nothing();
    if solution.transmits_nothing() {
        let why = if none { "no node is in contact" } else { "contact couples nothing" };
        return Some(format!(
            "Nothing transmitted: no load reaches the target, an audit result: {why}"
        ));
    }
    let units = &solution.request.scene.units;
    if none {
        let least = solution.contact.iter().min_by(|a, b| a.gap.total_cmp(&b.gap));
        let least = least.map_or("no contact node faces the target".into(), |at| {
            let gap = with_unit(&figure(at.gap, None), &units.length);
            format!("the least gap is {gap}, at node {}", at.node)
        });
        return Some(format!("Nothing in contact: no node is, at the end; {least}"));
    }
    let force = |size: f64| with_unit(&six_digits(size), &units.force);
    let along = solution.target_force();
    let resultant = engine::resultant(solution).map(|resultant| resultant.force);
    if resultant == Some([0.0; 2]) && solution.in_contact().all(|node| node.force == Some(0.0)) {
        return Some("Nothing pressed: the bodies touch without a force".into());
    }
    let is_along = resultant.is_none_or(|[fx, fy]| along.abs() >= ALONG * fx.hypot(fy));
    let share = share_of_load(&solution.model, along).filter(|_| is_along);
    Some(match (share, resultant) {
        (Some(share), _) => {
            let share = match percent(share).as_str() {
                "100 %" => "the whole load".into(),
                part => format!("{part} of the load"),
            };
            format!("Contact transmits {share}: force on the target {}", force(along))
        }
        (None, None) => {
            format!(
                "Contact presses one body on itself: the forces on its nodes sum to {}",
                force(solution.pressed())
            )
        }
        (None, Some([fx, fy])) => {
            let why = match solution.model.load.amax() > 0.0 {
                true => "",
                false if solution.is_displaced() => " under given displacements",
                false => " without a load",
            };
            let (size, towards) = (fx.hypot(fy), towards([fx, fy]));
            if size == 0.0 {
                return Some(format!(
                    "Contact presses{why}: its forces balance, and sum to {}",
                    force(solution.pressed())
                ));
            }
            format!("Contact presses{why}: force on the target {}{towards}", force(size))
        }
    })
}

/// Says where a force points, among eight directions.
fn towards([fx, fy]: [f64; 2]) -> String {
    // The tangent of 22.5 degrees.
    let least = (std::f64::consts::SQRT_2 - 1.0) * fx.abs().max(fy.abs());
    let word = |f: f64, [less, more]: [&'static str; 2]| match f {
        f if f < -least => Some(less),
        f if f > least => Some(more),
        _ => None,
    };
    let words = [word(fy, ["down", "up"]), word(fx, ["to the left", "to the right"])];
    match words.into_iter().flatten().collect::<Vec<_>>()[..] {
        [] => String::new(),
        ref words => format!(", {}", words.join(" and ")),
    }
}

/// Names the nodes in contact at the end, and why there is none where the target's edges have the wrong
/// direction.
fn in_contact(solution: &Solution) -> Vec<String> {
    let (request, model, last) = (&solution.request, &solution.model, solution.last());
    if model.target().is_none() {
        return Vec::new();
    }
    let nodes = match last.contact_set(model) {
        nodes if nodes.is_empty() => "no node".into(),
        nodes => format!("nodes {}", listed(nodes)),
    };
    let is_printed = request.is_as_printed();
    let hidden = is_printed.then(|| direction(model, &request.reading, &last.shape)).flatten();
    hidden.into_iter().chain([format!("In contact at the end: {nodes}")]).collect()
}

/// Says what contact passes to the target, and where.
fn resultant(solution: &Solution) -> Option<String> {
    let passed = engine::resultant(solution).filter(|passed| passed.through.is_some())?;
    Some(format!("Contact force on the target {}", force_along(solution, &passed)))
}

/// Writes a force and its line of action.
fn force_along(solution: &Solution, Resultant { force, through }: &Resultant) -> String {
    let units = &solution.request.scene.units;
    let digits = Digits::of(force[0].hypot(force[1]), Some(f64::EPSILON));
    let [fx, fy] = force.map(|x| digits.write(x));
    let at = through.map(|at| with_unit(&coordinates(at, decimals(solution)), &units.length));
    let along = at.map_or(String::new(), |at| format!(", along a line through {at}"));
    format!("{}{along}", with_unit(&format!("{fx}, {fy}"), &units.force))
}

/// Names the contact node under the largest pressure. The pressures of `printed` stay in the contact body.
fn peak(solution: &Solution, ends: &[(Cause, [NodeId; 2])], error: Option<f64>) -> Option<String> {
    let pressed: Vec<_> =
        solution.in_contact().filter_map(|node| Some((node.pressure?, node))).collect();
    let found = largest(pressed.iter().map(|(pressure, _)| *pressure))?;
    let (pressure, at) = pressed[found.first];
    if solution.request.variant == Variant::Printed || pressure == 0.0 {
        return None;
    }
    let units = &solution.request.scene.units;
    let gap = with_unit(&figure(at.gap, error), &units.length);
    let is_apart = solution.is_apart(at);
    let across = match is_apart {
        true => format!(", although the gap is open ({gap})"),
        false => String::new(),
    };
    let caution = of_the_mesh(solution, ends, at.node);
    Some(format!(
        "Peak contact pressure {} at {}{}{across}{caution}",
        with_unit(&figure(pressure, error), &units.stress),
        place(solution, at.node),
        others(found.others)
    ))
}

/// Says that contact reaches the end of a contact group where the bodies go on, unless they are known to
/// enter each other there.
fn group_ends(solution: &Solution, ends: &[(Cause, [NodeId; 2])]) -> Option<String> {
    let ends = ends.iter().filter(|(cause, _)| *cause == Cause::Group);
    let nodes: BTreeSet<NodeId> = ends.map(|(_, [node, _])| *node).collect();
    (!nodes.is_empty() && solution.overlap.is_none()).then(|| {
        format!(
            "NOTE: contact reaches the end of a contact group though the bodies go on, at {}: beyond it nothing keeps \
             them apart, so that pressures and stresses may be far off; extend both contact groups until nodes at their \
             ends are open, or to a corner of a body",
            listed(nodes.into_iter().map(|node| place(solution, node)))
        )
    })
}

/// Says where the mesh, or a contact group, decides the pressure of a node: it carries contact alone, or
/// stands at the edge of a body, as that of a punch, or at the end of a group, or in the next place.
fn of_the_mesh(solution: &Solution, ends: &[(Cause, [NodeId; 2])], node: NodeId) -> String {
    if solution.in_contact().count() == 1 {
        return "; one node alone is in contact: the finer its edges the higher its pressure, and its force is what counts".into();
    }
    let is_beside = |end: NodeId| {
        solution.model.triangles.iter().any(|t| [end, node].iter().all(|n| t.nodes.contains(n)))
    };
    let cause = ends
        .iter()
        .find(|(cause, [end, _])| *end == node || *cause == Cause::Group && is_beside(*end));
    cause.map_or(String::new(), |(cause, _)| {
        format!("; unbounded under refinement ({})", cause.name())
    })
}

/// Says how wide the contact is: from its first node to its last, whose edges leave the error; of several
/// unbroken stretches also what each passes on.
fn width(solution: &Solution) -> Report {
    let (units, stretches) = (&solution.request.scene.units, engine::stretches(solution));
    let span = |Stretch { nodes, width, .. }: &Stretch| {
        let [first, .., last] = nodes[..] else { return format!("node {} alone", nodes[0]) };
        let wide = figure(*width, Some(1.0 / (nodes.len() as f64 - 1.0)));
        format!(
            "{} along the surface, from node {first} to node {last}",
            with_unit(&wide, &units.length)
        )
    };
    match &stretches[..] {
        [] => Report::default(),
        [one] if one.nodes.len() == 1 => Report::default(),
        [one] => Report::default().note(format!("Contact width {}", span(one))),
        several => {
            let line = |stretch: &Stretch| {
                let [own, target] = &stretch.bodies;
                let passed = match solution.transmits_nothing() {
                    true => String::new(),
                    false => format!(": {}", force_along(solution, &stretch.passed)),
                };
                format!("{own} on {target}, {}{passed}", span(stretch))
            };
            let more = several.len().saturating_sub(MOST_STRETCHES);
            Report::default()
                .note(format!("Contact in {} stretches:", several.len()))
                .details(several.iter().take(MOST_STRETCHES).map(line))
                .details((more > 0).then(|| format!("and {more} more, in result.json")))
        }
    }
}

/// Names the node that moves farthest, and whether that has a limit.
fn displacement(
    assessment: &Assessment,
    solution: &Solution,
    error: Option<f64>,
) -> Option<String> {
    let sizes: Vec<f64> = solution.displacements().iter().map(|[x, y]| x.hypot(*y)).collect();
    let found = largest(sizes.iter().copied())?;
    let node = solution.model.node_ids().nth(found.first).expect("it has a displacement");
    let size = figure(sizes[found.first], error);
    let size = with_unit(&size, &solution.request.scene.units.length);
    if sizes[found.first] == 0.0 {
        return Some(format!("Largest |u| {size}"));
    }
    let no_limit = assessment.estimates.as_ref().and_then(|of| of.errors.displacement_no_limit);
    let diverges =
        no_limit.map_or(String::new(), |(node, cause)| format!("; {}", unbounded(node, cause)));
    let (place, others) = (place(solution, node), others(found.others));
    Some(format!("Largest |u| {size} at {place}{others}{diverges}"))
}

fn unbounded(node: NodeId, cause: Cause) -> String {
    format!("unbounded under refinement (node {node}, {cause})")
}

/// Says how large the error of the mesh is, or why that is not known.
fn mesh_error(assessment: &Assessment, solution: &Solution, error: Option<f64>) -> Option<String> {
    assessment.estimates.as_ref()?;
    Some(match (error, locking_of(&solution.model)) {
        (Some(error), _) => {
            let is_own =
                solution.request.variant == Variant::Unilateral && solution.model.has_contact();
            // The meshes of a trade are solved without friction.
            let is_own = is_own && solution.request.contact.friction == Friction::NONE;
            let word = &solution.request.scene.word;
            let more = is_own.then(|| {
                format!("; of the contact force and the peak pressure: trade {word} --only mesh")
            });
            format!(
                "Mesh error {} in the energy norm, {PROBABLY_MORE}{}",
                percent(error),
                more.unwrap_or_default()
            )
        }
        (None, Some(_)) => "Mesh error unknown: the triangles lock".into(),
        (None, None) => "Mesh error unknown: a body is too small for an estimate".into(),
    })
}

/// Says where each body has its largest von Mises stress, and whether that has a limit.
fn stresses(assessment: &Assessment, solution: &Solution, error: Option<f64>) -> Vec<String> {
    let units = &solution.request.scene.units;
    let limits = assessment.estimates.as_ref().map(|estimates| &estimates.errors.bodies);
    let mut lines = Vec::new();
    for (k, body) in assessment.bodies.iter().enumerate() {
        if body.max_von_mises_stress == 0.0 {
            let none = with_unit("0", &units.stress);
            lines.push(format!("Largest von Mises stress, {}: {none}", body.name));
            continue;
        }
        let limit = limits.and_then(|bodies| bodies.get(k)?.no_limit.as_ref());
        let diverges = match limit {
            Some(NoLimit { node, cause, is_largest: true }) => {
                format!("; {}", unbounded(*node, *cause))
            }
            Some(NoLimit { node, cause, is_largest: false }) => {
                format!("; elsewhere {}", unbounded(*node, *cause))
            }
            None => String::new(),
        };
        lines.push(format!(
            "Largest von Mises stress, {}: {} at {}{}{diverges}",
            body.name,
            with_unit(&figure(body.max_von_mises_stress, error), &units.stress),
            with_unit(&coordinates(body.centre, decimals(solution)), &units.length),
            others(body.as_large)
        ));
    }
    lines
}

/// Says that the run does not iterate to equilibrium, and whether the contact state came to rest.
fn end(solution: &Solution) -> Option<String> {
    solution.model.target()?;
    let (variant, last) = (solution.request.variant, solution.last());
    let from = if variant == Variant::Stepped { "step" } else { "iteration" };
    let state = match &last.cycle {
        None => ", and is new in the last".into(),
        Some(Cycle { length: 1, .. }) => String::new(),
        Some(cycle) => format!(
            "; DOES NOT SETTLE: the contact state alternates with a period of {}, and all figures are those of \
             iteration {}",
            cycle.length, last.k
        ),
    };
    Some(format!(
        "{variant} does not iterate to equilibrium: contact is decided from the previous {from}{state}"
    ))
}

/// Says how far the run is from the equilibrium under the scene's own friction, or the reference solution
/// where that is the same.
fn from_equilibrium(assessment: &Assessment) -> Option<String> {
    let other = assessment.equilibrium.as_ref().or(assessment.reference.as_ref())?;
    Some(match other {
        Ok(other) => {
            let far = percent(other.distance.energy_relative);
            format!("{far} from the equilibrium, in the energy norm on the same mesh")
        }
        Err(_) => "There is no equilibrium to compare with".into(),
    })
}

pub(super) fn place(solution: &Solution, node: NodeId) -> String {
    let place = coordinates(solution.model.coordinates(node), decimals(solution));
    format!("node {node}: {}", with_unit(&place, &solution.request.scene.units.length))
}

/// Returns the decimals of places: four digits of the size of the bodies.
pub fn decimals(solution: &Solution) -> usize {
    decimals_of_places(solution.model.bounds().larger_side())
}

/// Says how many other places have the same value to 1e-9 of it, as mirror images have.
fn others(n: usize) -> String {
    if n == 0 { String::new() } else { format!(" ({} as large)", counted(n, "other", "others")) }
}
