//! Tables for people.

use std::fmt::Write as _;

use crate::answer::contact::ContactNode;
use crate::answer::{Assessment, BodySummary, Cycle, Solution, Step, max_displacement};
use crate::paper::door::Call;
use crate::problem::model::{Model, NodeId};
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;

use super::numbers::uncertain;

/// Rows of cells in columns, the first row being the heading: numbers to the right, words to the left.
pub(super) fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let column = |j: usize| rows.iter().filter_map(move |row| row.get(j));
    let widths: Vec<usize> =
        (0..columns).map(|j| column(j).map(|c| c.chars().count()).max().unwrap_or(0)).collect();
    let numeric: Vec<bool> =
        (0..columns).map(|j| column(j).skip(1).all(|c| is_number(c))).collect();
    let mut text = String::new();
    for (k, row) in rows.iter().enumerate() {
        let cells = row.iter().enumerate().map(|(j, cell)| {
            let width = widths[j];
            if numeric[j] { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
        });
        let line = cells.collect::<Vec<_>>().join("  ");
        writeln!(text, "  {}", line.trim_end()).expect("a String takes any text");
        if k == 0 {
            let rule: Vec<String> = widths.iter().map(|width| "-".repeat(*width)).collect();
            writeln!(text, "  {}", rule.join("  ")).expect("a String takes any text");
        }
    }
    text
}

/// A number, a percentage, or `-` for none.
fn is_number(cell: &str) -> bool {
    cell == "-" || cell.trim_end_matches(" %").parse::<f64>().is_ok()
}

/// `name (unit)`, or the name alone where the scene names no unit.
pub(super) fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.into() } else { format!("{name}, {unit}") }
}

/// A whole number as it is, else some five digits, in scientific notation where that is shorter to read.
pub(super) fn short(x: f64) -> String {
    match x.abs() {
        size if size < 1e9 && x.fract() == 0.0 => format!("{x:.0}"),
        size if (1e-3..1e5).contains(&size) => format!("{x:.5}"),
        _ => format!("{x:.3e}"),
    }
}

/// The error of the mesh in the energy norm beyond which its bars missed the truth now and then (`error_bars::discretisation`).
const FAIR: f64 = 0.2;

/// A line on nodes that were dropped; nothing where none was.
fn dropped(scene: &Scene) -> String {
    let numbers: Vec<String> = scene.dropped.iter().map(usize::to_string).collect();
    match numbers.as_slice() {
        [] => String::new(),
        some => format!(
            "Dropped: nodes {} of the mesh belong to no triangle; the others are numbered anew, 1 to R\n",
            some.join(", ")
        ),
    }
}

/// The tables of `solve`.
pub fn solution(solution: &Solution, assessment: &Assessment) -> String {
    let scene = &solution.request.scene;
    let mut text = format!("{} ({})\n{}", scene.title, heading(solution), dropped(scene));
    text += &format!("\nIterations\n{}", iterations(solution));
    if solution.model.target().is_some() {
        let nodes = contact_list(&solution.model, solution.last());
        text += &format!("\nIn contact at the end: {nodes}\n");
    }
    text += &format!("\nBodies\n{}", bodies(scene, &assessment.bodies));
    let carrying: Vec<&ContactNode> = solution.in_contact().collect();
    if !carrying.is_empty() {
        text += &format!("\nContact surface\n{}", contact_surface(scene, &carrying));
    }
    text
}

/// The contact nodes in contact at the end.
fn contact_surface(scene: &Scene, nodes: &[&ContactNode]) -> String {
    let units = &scene.units;
    let head = vec![
        "node".into(),
        with_unit("arc", &units.length),
        with_unit("gap", &units.length),
        with_unit("pressure", &units.stress),
        with_unit("shear", &units.stress),
        "friction needed".into(),
    ];
    let rows = nodes.iter().map(|c| {
        vec![
            c.node.to_string(),
            short(c.arc),
            format!("{:.1e}", c.gap),
            short(c.pressure),
            short(c.shear),
            c.friction_needed.map_or("-".into(), short),
        ]
    });
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}

/// The error bars of a run.
pub fn error_bars(solution: &Solution, assessment: &Assessment) -> String {
    let (scene, bars) = (&solution.request.scene, &assessment.estimates);
    let largest = max_displacement(&solution.u);
    let moved = [(bars.displacement, "arithmetic")];
    let mut text = format!(
        "\nError bars\n  largest |u|: {}\n",
        uncertain(largest, &scene.units.length, &moved)
    );
    for body in &bars.bodies {
        let two = [(body.mesh, "mesh"), (body.arithmetic, "arithmetic")];
        let stress = uncertain(body.value, &scene.units.stress, &two);
        text += &format!("  largest von Mises stress, {}: {stress}\n", body.name);
    }
    let relative = bars.mesh.relative();
    text += &match relative.is_finite() {
        true => format!("  error of the mesh: {:.1} % in the energy norm", 100.0 * relative),
        false => "  error of the mesh: unknown, a body is too small for an estimate".into(),
    };
    if relative > FAIR {
        text += ": too coarse for its bars to be relied on";
    }
    text + "\n"
}

/// How far a run is from the converged answer; why there is none.
pub fn distance(solution: &Solution, assessment: &Assessment) -> String {
    let measured = match &assessment.reference {
        None => return String::new(),
        Some(Err(why)) => return format!("\nNo converged answer to measure this against: {why}\n"),
        Some(Ok(measured)) => measured,
    };
    let scene = &solution.request.scene;
    let (of, reference) = (&measured.distance, &measured.reference);
    let percent = |x: f64| format!("{:.2} %", 100.0 * x);
    let mut text = format!(
        "\nDistance to the converged answer ({}; {} in contact)\n",
        super::pressure::name(reference),
        reference.in_contact().count()
    );
    let head = ["", "this run", "converged", "difference"].map(String::from).to_vec();
    let displacement = vec![
        with_unit("displacement, largest difference", &scene.units.length),
        "-".into(),
        "-".into(),
        format!("{} = {}", short(of.displacement), percent(of.displacement_relative)),
    ];
    let energy = vec![
        "energy norm of the difference".into(),
        "-".into(),
        "-".into(),
        percent(of.energy_relative),
    ];
    let bodies = of.bodies.iter().map(|body| {
        vec![
            with_unit(&format!("von Mises stress, {}", body.name), &scene.units.stress),
            short(body.von_mises_stress),
            short(body.reference),
            percent(body.relative),
        ]
    });
    text += &aligned(&[head, displacement, energy].into_iter().chain(bodies).collect::<Vec<_>>());
    text
}

fn heading(solution: &Solution) -> String {
    let (request, model) = (&solution.request, &solution.model);
    let heading = format!(
        "scene {}, variant {}: {} load, plane {}; {} nodes, {} triangles; {} matrices factored",
        request.scene.name,
        request.variant,
        request.schedule(),
        model.plane,
        model.nodes.len(),
        model.triangles.len(),
        solution.factored
    );
    heading + &arithmetic(solution)
}

/// In which numbers a run was done, unless in those of every run; and how far they lead.
fn arithmetic(solution: &Solution) -> String {
    let done = solution.request.arithmetic;
    let mut text = match done.is_default() {
        true => String::new(),
        false => format!("\nin {} by {}, inputs {}", done.scalar, done.solver(), done.inputs),
    };
    if let Some(bound) = solution.error_bound {
        let unit = &solution.request.scene.units.length;
        text += &match bound.is_finite() {
            true => format!("; rounding moves no displacement by more than {bound:.1e} {unit}"),
            false => "; how far rounding leads is not known".into(),
        };
    }
    text
}

fn iterations(solution: &Solution) -> String {
    let units = &solution.request.scene.units;
    let [fx, fy] = solution.model.total_load();
    let head = vec![
        "k".into(),
        "in contact".into(),
        with_unit("largest |u|", &units.length),
        match solution.request.variant {
            Variant::Unilateral => with_unit("gap or overlap left", &units.length),
            _ => with_unit("eq. (1), total u", &units.length),
        },
        with_unit("force on target", &units.force),
        format!("of {}", short(fx.hypot(fy))),
        "residual".into(),
        "contact state".into(),
    ];
    let rows = solution.steps.iter().map(|step| {
        vec![
            step.k.to_string(),
            step.in_contact.to_string(),
            short(step.max_displacement),
            short(step.contact_residual()),
            short(step.target_force),
            share(step.target_force, fx.hypot(fy)),
            format!("{:.0e}", step.solve_residual),
            state(&step.cycle),
        ]
    });
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}

/// A force as part of the load; `-` without a load, where an overlap alone may press.
fn share(force: f64, load: f64) -> String {
    if load == 0.0 { "-".into() } else { format!("{:.1} %", 100.0 * force / load) }
}

fn state(cycle: &Option<Cycle>) -> String {
    match cycle {
        None => "new".into(),
        Some(Cycle { length: 1, .. }) => "unchanged".into(),
        Some(cycle) => format!("as in {} (cycle of {})", cycle.members[0], cycle.length),
    }
}

/// Numbers of the contact nodes in contact.
fn contact_list(model: &Model, step: &Step) -> String {
    let nodes: Vec<String> = step.contact_set(model).iter().map(NodeId::to_string).collect();
    if nodes.is_empty() { "no node".into() } else { format!("nodes {}", nodes.join(", ")) }
}

fn bodies(scene: &Scene, bodies: &[BodySummary]) -> String {
    let units = &scene.units;
    let head = vec![
        "body".into(),
        "nodes".into(),
        "triangles".into(),
        with_unit("largest |u|", &units.length),
        with_unit("von Mises stress", &units.stress),
        "at x, y".into(),
        "von Mises strain".into(),
    ];
    let rows = bodies.iter().map(|body| {
        vec![
            body.name.clone(),
            body.nodes.to_string(),
            body.triangles.to_string(),
            short(body.max_displacement),
            short(body.max_von_mises_stress),
            format!("{:.2}, {:.2}", body.centre[0], body.centre[1]),
            short(body.max_von_mises_strain),
        ]
    });
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}

/// The table of `c-cnt`: contact nodes first, then the rows of k_cnt that are not zero.
pub fn pairs(scene: &Scene, model: &Model, call: &Call) -> String {
    let head = ["i1", "cnt", "ct", "yt", "dy"].map(String::from).to_vec();
    let rows = call.statuses.iter().enumerate().map(|(k, status)| {
        vec![
            (k + 1).to_string(),
            status.node.to_string(),
            status.edge.map_or(0, |edge| model.edge(edge).number).to_string(),
            short(status.distance),
            u8::from(status.in_contact).to_string(),
        ]
    });
    let found = aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>());
    let head = ["node", "mate", "weight", "mate", "weight", "surface"].map(String::from).to_vec();
    let linked = model.node_ids().filter(|n| call.row(*n).iter().any(|x| *x != 0.0));
    let rows: Vec<Vec<String>> = linked.map(|n| links(model, call, n)).collect();
    let count = rows.len();
    let links = aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>());
    format!(
        "{}Contact nodes (c_tll = {})\n{found}\nk_cnt: {count} of {} rows are not zero\n{links}",
        dropped(scene),
        model.contact.tolerance,
        model.nodes.len()
    )
}

/// A row of k_cnt.
fn links(model: &Model, call: &Call, node: NodeId) -> Vec<String> {
    let surface = if model.contact.nodes.contains(&node) { "contact" } else { "target" };
    let cell = |(j, x): (usize, f64)| if j % 2 == 0 { format!("{x:.0}") } else { short(x) };
    let cells = call.row(node).into_iter().enumerate().map(cell);
    std::iter::once(node.to_string()).chain(cells).chain([surface.to_string()]).collect()
}
