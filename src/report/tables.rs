//! The tables of `solve` and `listing run c_cnt`.

use super::layout::{Table, aligned, counted, listed};
use super::numbers::{note, or_dash, percent, place, quantity, short, uncertain, with_unit};
use super::trace::in_figure;
use super::{pressure, quantities};
use engine::Decision;
use engine::contact::{ContactNode, Status, hidden, oddity};
use engine::error::Error;
use engine::estimates::ErrorEstimates;
use engine::estimates::{Certainty, NoLimit};
use engine::{
    Assessment, BodySummary, Equilibrium, IterationRow, Measured, Path, Probe, Solution, Start,
    Step, Unilateral, Uniqueness, beyond_range, last_under_each_load, locking, max_displacement,
};
use paper::door::Call;
use paper::mirror::Reading;
use problem::model::{EdgeId, Model, NodeId};
use problem::modelling::{Coupling, Geometry, Variant};
use problem::scene::{Scene, Units};

/// The relative error of the mesh in the energy norm beyond which the estimates that rest on it
/// missed the truth now and then (`engine::estimates::discretisation`).
const FAIR: f64 = 0.2;

/// The change of displacements, over the largest, below which a path of half as many steps comes to the
/// same: where nodes changed their status within steps, both may have missed when.
const UNMOVED: f64 = 1e-6;

/// Says in which numbers a run was made where rounding in f64 may decide; nothing where it decides
/// nothing.
pub fn certainty(certainty: Certainty) -> Option<String> {
    let numbers = match certainty {
        Certainty::Certain => return None,
        Certainty::InDoubleDouble => "this is the run in double-doubles, where it decides nothing",
        Certainty::Unknown => "in no other numbers is it known not to",
    };
    Some(format!("rounding in f64 may decide who is in contact; {numbers}"))
}

/// Lays out what a run came to: its iterations, its bodies and its contact surface.
pub fn solution(solution: &Solution, assessment: &Assessment) -> String {
    let scene = &solution.request.scene;
    let mut text = format!("{} ({})\n{}", scene.title, heading(solution), dropped(scene));
    text += &match path(solution) {
        Some(path) => {
            format!("\nPath of the load\n{}", load_steps(solution, path, assessment))
        }
        None => format!("\nIterations\n{}", iterations(solution)),
    };
    text +=
        &solution.equilibrium.as_ref().map_or(String::new(), |found| equilibrium(solution, found));
    if solution.model.target().is_some() {
        let nodes = match solution.last().contact_set(&solution.model) {
            nodes if nodes.is_empty() => "no node".into(),
            nodes => format!("nodes {}", listed(nodes)),
        };
        text += &format!("\nIn contact at the end: {nodes}\n");
        if solution.request.is_as_printed() {
            let shape = &solution.last().shape;
            text += &direction(&solution.model, &solution.request.reading, shape);
        }
    }
    text += &format!("\nBodies\n{}", bodies(&scene.units, &assessment.bodies));
    text += &beyond_range(&solution.model, &solution.elements, &solution.u)
        .map_or(String::new(), |what| format!("  NOTE: {what}\n"));
    if solution.in_contact().next().is_some() {
        text += &format!("\nContact surface\n{}", contact_surface(solution));
        if solution.request.variant == Variant::Printed {
            text += "  The pressures are what the blocks that Km adds to a body's own equations take up; \
                     nothing couples the bodies\n  (finding K1), so that none of it reaches the other \
                     body\n";
        }
        text += &list_of_contact(solution);
    }
    text
}

/// Tells what c_cnt takes as it stands in the list of the contact surface; nothing under
/// `unilateral`, which orders it.
fn list_of_contact(solution: &Solution) -> String {
    let is_published = solution.request.variant != Variant::Unilateral;
    let oddity = is_published.then(|| oddity(&solution.model)).flatten();
    oddity.map_or(String::new(), |what| {
        format!(
            "  cnt is no walk along its surface: {what}.\n  c_cnt takes it as it stands (findings \
             C12, C13)\n"
        )
    })
}

fn heading(solution: &Solution) -> String {
    let (request, model) = (&solution.request, &solution.model);
    let heading = format!(
        "scene {}, variant {}: {} load, plane {}; {} nodes, {}; {} factored",
        request.scene.name,
        request.variant,
        request.schedule(),
        model.plane,
        model.nodes.len(),
        counted(model.triangles.len(), "triangle", "triangles"),
        counted(solution.factored, "matrix", "matrices")
    );
    heading + &edited(solution) + &arithmetic(solution)
}

/// Names the edited listings that were executed; nothing where there is none.
fn edited(solution: &Solution) -> String {
    let edited = solution.request.edited.iter();
    edited.map(|edited| format!("\nwith {} as edited in {}", edited.which, edited.place)).collect()
}

/// Tells in which numbers a run was done, unless in those of every run, and the bound they keep.
fn arithmetic(solution: &Solution) -> String {
    let done = solution.request.arithmetic;
    let mut text = match done.is_default() {
        true => String::new(),
        false => {
            format!("\nin {} by {}, inputs {}", done.scalar, solution.request.solver(), done.inputs)
        }
    };
    if let Some(bound) = solution.error_bound {
        let unit = &solution.request.scene.units.length;
        text += &match bound.is_finite() {
            true => format!("; rounding changes no displacement by more than {bound:.1e} {unit}"),
            false => "; rounding error unknown".into(),
        };
    }
    text
}

/// Tells which nodes were dropped, by their numbers in the mesh file; nothing where none was.
fn dropped(scene: &Scene) -> String {
    let Model { dropped, .. } = &*scene.model;
    if dropped.is_empty() {
        return String::new();
    }
    format!(
        "Dropped: nodes {} of the mesh belong to no triangle; no equation has them\n",
        listed(dropped)
    )
}

fn iterations(solution: &Solution) -> String {
    let springs = |step: &Step| step.unilateral().map_or(0.0, |own| own.springs);
    // Of a shape that was reached on springs, the last iteration.
    let is_shown = |k: usize| {
        let own = springs(&solution.steps[k]);
        own == 0.0 || solution.steps.get(k + 1).is_none_or(|next| springs(next) != own)
    };
    let rows = IterationRow::all(solution).into_iter().enumerate();
    let rows: Vec<_> = rows.filter(|(k, _)| is_shown(*k)).map(|(_, row)| row).collect();
    quantities::table(&rows, IterationRow::QUANTITIES, &solution.request.scene.units)
}

fn path(solution: &Solution) -> Option<&Path> {
    solution.equilibrium.as_ref()?.path.as_ref()
}

/// Lays out the last iteration under each load of a path.
fn load_steps(solution: &Solution, path: &Path, assessment: &Assessment) -> String {
    let units = &solution.request.scene.units;
    let length = |name| quantity(name, &units.length);
    let last = last_under_each_load(&solution.steps);
    let own: Vec<&Unilateral> =
        last.iter().filter_map(|i| solution.steps[*i].unilateral()).collect();
    let before = |row: usize| row.checked_sub(1).map_or(0, |before| last[before] + 1);
    let count = |row: usize, counted: fn(&Status) -> bool| {
        own[row].statuses.iter().filter(|status| counted(status)).count()
    };
    let table = Table::of(0..last.len())
        .column("load", |row| short(own[*row].load))
        .column("iterations", |row| last[*row] + 1 - before(*row))
        .column("stick", |row| count(*row, |status| *status == Status::Stick))
        .column("slip", |row| count(*row, |status| matches!(status, Status::Slip(_))))
        .column(length("largest |u|"), |row| {
            or_dash(solution.steps[last[*row]].max_displacement, short)
        })
        .column(length("gap or overlap left"), |row| {
            short(solution.steps[last[*row]].contact_residual())
        })
        .column(quantity("force on target", &units.force), |row| {
            or_dash(solution.steps[last[*row]].target_force, short)
        })
        .text();
    let largest = max_displacement(&solution.u);
    let change = match assessment.path_change {
        Some(change) => {
            let says_little = match path.changes {
                n if n > 0 && change <= UNMOVED * largest => format!(
                    "; that says little, as nodes come to stick, to slide or to open in {}",
                    counted(n, "step", "steps")
                ),
                _ => String::new(),
            };
            format!(
                "half as many steps change a displacement component by at most {} = {} of the largest \
                 |u|{says_little}",
                with_unit(&short(change), &units.length),
                percent(if largest > 0.0 { change / largest } else { 0.0 }, 2)
            )
        }
        None => {
            let why = match () {
                () if path.start == Start::Loose => {
                    "is not known: nothing holds the bodies before the first step, which moves them to \
                     where contact does"
                }
                () if path.start == Start::Overlapping => {
                    "is not known: nodes that overlap the target close with the first step, as no \
                     equilibrium was found without load"
                }
                () if path.steps % 2 == 1 => "is not known: ask for an even number",
                () if assessment.estimates.is_none() => "was not asked for",
                () => "is not known: half as many find no equilibrium",
            };
            format!("what is left of the size of the steps {why}")
        }
    };
    let halved = match path.halved {
        0 => String::new(),
        n => format!("; {n} halved, as no equilibrium was found"),
    };
    format!("{table}  {} steps a stage{halved}; {change}\n", path.steps)
}

/// Says whether the equilibrium is the only one, and what is left of the change of shape.
fn equilibrium(solution: &Solution, found: &Equilibrium) -> String {
    let length = |x: f64| with_unit(&short(x), &solution.request.scene.units.length);
    let mut text = match &found.uniqueness {
        Uniqueness::Unique => {
            "Equilibrium: the only one in the shape reached (convex, no friction)\n".into()
        }
        Uniqueness::Indifferent { node } => format!(
            "Equilibrium: NOT THE ONLY ONE: node {node} can move without work, as contacts that carry \
             nothing may open\n"
        ),
        Uniqueness::Unknown { node } => {
            let free = node.map_or(String::new(), |node| {
                format!(
                    "; node {node} can move without work as long as the normals of contact stay as they \
                     are"
                )
            });
            format!("Equilibrium: whether it is the only one is not known{free}\n")
        }
        Uniqueness::Tried { states, steps, all, last_only, others } => {
            let tried = tried(solution, (*states, *steps), [*all, *last_only]);
            match others.len() {
                0 => format!("Equilibrium: no other one found among {tried}\n"),
                n => format!("Equilibrium: NOT THE ONLY ONE: {n} more among {tried}\n"),
            }
        }
    };
    if let Uniqueness::Tried { others, .. } = &found.uniqueness {
        for other in others {
            let nodes = |nodes: &[NodeId]| match nodes {
                [] => "none".into(),
                nodes => format!("nodes {}", listed(nodes)),
            };
            text += &format!(
                "  at load {}: stick {}; slip {}: displacement components change by at most {}\n",
                short(other.load),
                nodes(&other.stick),
                nodes(&other.slip),
                length(other.change)
            );
        }
    }
    if let Some(carried) = found.springs {
        text += &format!(
            "Found on springs, which hold the bodies on the way to rest: in the end they carry at most \
             {carried:.0e} of the largest force\n"
        );
    }
    if let Some((node, depth)) = found.unseen {
        text += &format!(
            "Node to segment watches contact nodes only: target node {node} lies {} inside the contact \
             surface; mortar sees it\n",
            length(depth)
        );
    }
    if let Some((node, depth)) = found.inside {
        text += &format!(
            "Contact node {node} lies {} INSIDE THE TARGET in the shape reached{}\n",
            length(depth),
            why_inside(solution, node)
        );
    }
    if found.shape_change > 0.0 {
        text += &format!(
            "Shape: when contact was last measured, no displacement component changed by more than {}\n",
            length(found.shape_change)
        );
    }
    text
}

/// Names the contact states that were tried for other equilibria, and those that were not.
fn tried(
    solution: &Solution,
    (states, steps): (usize, usize),
    [all, last_only]: [bool; 2],
) -> String {
    let shapes = match solution.request.contact.geometry {
        Geometry::Initial => "",
        Geometry::Current => ", each in the shape reached",
    };
    let steps = match last_only {
        true => "the last step".into(),
        false => counted(steps, "step of the load", "steps of the load"),
    };
    let states = match all {
        true => format!("all {states} contact states of {steps}"),
        false => {
            let states = counted(states, "contact state", "contact states");
            format!("{states} of {steps} that differ at one node")
        }
    };
    let earlier = if last_only { "; earlier steps were not looked at" } else { "" };
    format!("{states}{shapes}{earlier}")
}

/// Says how a contact node may lie inside the target.
fn why_inside(solution: &Solution, node: NodeId) -> &'static str {
    let contact = solution.request.contact;
    let is_closed = solution.in_contact().any(|contact| contact.node == node);
    match (is_closed, contact.coupling, contact.geometry) {
        (false, ..) => {
            ": it is treated as separated, as no edge of the target faced it, so that this is NO EQUILIBRIUM \
             of that shape; give smaller loads, or list the side of the target that it meets"
        }
        (_, Coupling::Mortar, _) => ": mortar closes the averaged gap of the edges at a node",
        (_, _, Geometry::Initial) => ": gaps were closed along the normals of the initial shape",
        (_, _, Geometry::Current) => "",
    }
}

fn bodies(units: &Units, bodies: &[BodySummary]) -> String {
    quantities::table(bodies, BodySummary::QUANTITIES, units)
}

/// Lays out the contact nodes that are in contact at the end.
fn contact_surface(solution: &Solution) -> String {
    let nodes: Vec<ContactNode> = solution.in_contact().cloned().collect();
    let shown = ContactNode::QUANTITIES.iter().filter(|quantity| quantity.name != "dy");
    quantities::table(&nodes, shown, &solution.request.scene.units)
}

/// Lays out how far the numbers of a run may be from the truth; nothing where that was left out.
pub fn error_estimates(solution: &Solution, assessment: &Assessment) -> String {
    let Some(estimates) = &assessment.estimates else { return String::new() };
    let errors = &estimates.errors;
    let units = &solution.request.scene.units;
    let moved = assessment.bodies.iter().map(|body| body.max_displacement).fold(0.0, f64::max);
    let of_displacement =
        [(errors.displacement_mesh, "mesh"), (errors.displacement_arithmetic, "arithmetic")];
    let mut text = format!(
        "\nError estimates\n  largest |u|: {}\n",
        match errors.displacement_no_limit {
            Some((node, cause)) => format!(
                "{} on this mesh; in the plane it diverges under refinement: at node {node}, {cause}",
                with_unit(&short(moved), &units.length)
            ),
            None => uncertain(moved, &units.length, &of_displacement),
        }
    );
    if solution.model.has_contact() && errors.displacement_mesh.is_some() {
        text += "    with contact an estimate and no bound: contact changes with the mesh\n";
    }
    for body in &errors.bodies {
        let of_stress = [(body.mesh, "mesh"), (body.arithmetic, "arithmetic")];
        let stress = match &body.no_limit {
            Some(NoLimit { node, cause, is_largest: true }) => format!(
                "{} on this mesh; it {} no limit on finer ones: at node {node}, {cause}",
                with_unit(&short(body.von_mises_stress), &units.stress),
                cause.has()
            ),
            Some(NoLimit { node, cause, .. }) => format!(
                "{}, away from node {node}, {cause}, where it {} no limit",
                uncertain(body.von_mises_stress, &units.stress, &of_stress),
                cause.has()
            ),
            None => uncertain(body.von_mises_stress, &units.stress, &of_stress),
        };
        text += &format!("  largest von Mises stress, {}: {stress}\n", body.name);
    }
    text += &error_of_mesh(solution, errors);
    text += &by_rounding(solution, errors.decided_by_rounding.as_deref());
    if solution.request.variant == Variant::Unilateral && solution.model.has_contact() {
        text += match solution.way_counts() {
            true => {
                "  who is in contact: looked at in every iteration, between the faces of a corner too\n"
            }
            false => {
                "  who is in contact: looked at in the last state, between the faces of a corner too; \
                 the way to it does not count, as there is no other equilibrium\n"
            }
        };
    }
    text
}

/// Tells the error of the mesh in the energy norm, and how far it is to be relied on.
fn error_of_mesh(solution: &Solution, errors: &ErrorEstimates) -> String {
    let Some(relative) = errors.mesh_energy_relative else {
        let model = &solution.model;
        let why = model.triangles.iter().find_map(|t| locking(model.plane, t.material.nu));
        let why = why.unwrap_or("a body is too small for an estimate".into());
        return format!("  error of the mesh: unknown: {why}\n");
    };
    let how_far = match () {
        () if relative > FAIR => ": too coarse for its estimates to be relied on",
        () if errors.bodies.iter().any(|body| body.no_limit.is_some()) => {
            ": too low where the stress has no limit; trade --only mesh measures it"
        }
        () => "",
    };
    format!("  error of the mesh: {} in the energy norm{how_far}\n", percent(relative, 1))
}

/// Tells what rounding may have decided, its first decision and how many there are; nothing where it
/// decided nothing.
fn by_rounding(solution: &Solution, decisions: Option<&[Decision]>) -> String {
    let unit = &solution.request.scene.units.length;
    let length = |x: f64| with_unit(&format!("{x:.1e}"), unit);
    let Some(decisions) = decisions else {
        return "  who is in contact: whether rounding decides it is not known\n".into();
    };
    let Some(Decision { iteration, node, condition, margin, bound }) = decisions.first() else {
        return String::new();
    };
    let margin = margin.map_or(String::new(), |margin| {
        let bound = or_dash(*bound, length);
        format!(" (margin {}, bound {bound})", length(margin))
    });
    format!(
        "  who is in contact: rounding may have decided {}, first in iteration {iteration} at \
         node {node}: {condition}{margin}\n",
        match decisions.len() {
            1 => "once".into(),
            times => format!("{times} times"),
        }
    )
}

/// Lays out what a run says of the points that were asked for.
pub fn probes(solution: &Solution, assessment: &Assessment) -> String {
    let units = &solution.request.scene.units;
    assessment.probes.iter().map(|probe| self::probe(units, probe)).collect()
}

fn probe(units: &Units, probe: &Probe) -> String {
    let [x, y] = probe.at;
    let shared = match &probe.shared[..] {
        [] => String::new(),
        others => format!(
            " (edge or node shared with {}: values are its own, recovered ones are common)",
            listed(others)
        ),
    };
    let error = |error: Option<f64>| or_dash(error, |x| format!("{x:.1e}"));
    let table = Table::of(&probe.quantities)
        .column("", |q| quantity(&q.name, q.unit.in_scene(units)))
        .column("value", |q| short(q.value))
        .column("recovered", |q| or_dash(q.recovered, short))
        .column("+- mesh", |q| error(q.mesh))
        .column("+- arithmetic", |q| error(q.arithmetic))
        .text();
    let no_limit = probe.no_limit.map_or(String::new(), |cause| {
        let has = cause.has();
        format!("  beside {cause}, where the stress {has} no limit: no mesh bounds it\n")
    });
    let head = format!("\nAt {x}, {y}: body {}, triangle {}{shared}\n", probe.body, probe.triangle);
    head + &no_limit + &table
}

/// Lays out how far a run is from the reference solution and from the equilibrium under the scene's
/// own friction, or why there is none.
pub fn distance(solution: &Solution, assessment: &Assessment) -> String {
    let reference = assessment.reference.as_ref();
    let own = assessment.equilibrium.as_ref();
    let of = |what: &str, other: Option<&Result<Measured, Error>>| {
        other.map_or(String::new(), |other| distance_from(solution, what, other))
    };
    of("reference solution", reference)
        + &of("equilibrium under the scene's own friction and geometry", own)
}

fn distance_from(solution: &Solution, what: &str, other: &Result<Measured, Error>) -> String {
    let measured = match other {
        Err(why) => return format!("\nNo {what} to measure this against: {why}\n"),
        Ok(measured) => measured,
    };
    let units = &solution.request.scene.units;
    let (of, reference) = (&measured.distance, &measured.reference);
    let whole = |name: String, difference| vec![name, "-".into(), "-".into(), difference];
    let moved = format!("{} = {}", short(of.displacement), percent(of.displacement_relative, 2));
    let wholes = [
        whole(quantity("largest difference of a displacement", &units.length), moved),
        whole("energy norm of the difference".into(), percent(of.energy_relative, 2)),
    ];
    let bodies = of.bodies.iter().map(|body| {
        vec![
            quantity(&format!("largest von Mises stress, {}", body.name), &units.stress),
            short(body.von_mises_stress),
            short(body.reference),
            percent(body.relative, 2),
        ]
    });
    format!(
        "\nDistance from the {what} ({}, {} geometry; {} in contact)\n{}{}{}",
        pressure::name(reference),
        reference.request.contact.geometry,
        reference.in_contact().count(),
        aligned(["", "this run", "there", "difference"], wholes.into_iter().chain(bodies)),
        note("displacement_relative", [of.displacement_relative]),
        note("relative", of.bodies.iter().map(|body| body.relative)),
    )
}

/// Lays out a call of `c_cnt` at the initial shape: its contact nodes, then the rows of k_cnt that are
/// not zero. In the scene of the paper's fig. 1 each node has its number there.
pub fn pairs(scene: &Scene, model: &Model, reading: &Reading, call: &Call) -> String {
    let number = |edge: Option<EdgeId>| edge.map_or(0, |edge| model.edge(edge).number);
    let in_figure = |node: NodeId| or_dash(in_figure(scene, model, node), |number| number);
    let mut found = Table::of(call.statuses.iter().enumerate())
        .column("i1", |(k, _)| k + 1)
        .column("cnt", |(_, status)| status.node)
        .column("ct", |(_, status)| number(status.edge))
        .column("yt", |(_, status)| short(status.distance))
        .column("dy", |(_, status)| u8::from(status.in_contact));
    let linked = model.node_ids().filter(|n| call.row(*n).iter().any(|x| *x != 0.0));
    let cell = |node: NodeId, j: usize| match (call.row(node)[j], j % 2) {
        (mate, 0) => format!("{mate:.0}"),
        (weight, _) => short(weight),
    };
    let mut rows = Table::of(linked)
        .column("node", |node| *node)
        .column("mate", |node| cell(*node, 0))
        .column("weight", |node| cell(*node, 1))
        .column("mate", |node| cell(*node, 2))
        .column("weight", |node| cell(*node, 3))
        .column("surface", |node| match model.contact.nodes.contains(node) {
            true => "contact",
            false => "target",
        });
    if scene.name == "fig1" {
        found = found.column("in fig. 1", |(_, status)| in_figure(status.node));
        rows = rows.column("in fig. 1", |node| in_figure(*node));
    }
    let count = model.node_ids().filter(|n| call.row(*n).iter().any(|x| *x != 0.0)).count();
    format!(
        "{}Contact nodes (c_tll = {})\n{}{}\nk_cnt: {count} of {} rows are not zero\n{}",
        dropped(scene),
        model.contact.tolerance,
        found.text(),
        direction(model, reading, &model.nodes),
        model.nodes.len(),
        rows.text()
    )
}

/// Says that no node is in contact because of the direction of the target's edges; nothing where
/// that is not so.
fn direction(model: &Model, reading: &Reading, shape: &[[f64; 2]]) -> String {
    hidden(model, reading, shape)
        .map_or(String::new(), |why| format!("  No node is in contact: {why}\n"))
}
