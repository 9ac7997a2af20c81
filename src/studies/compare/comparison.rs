//! A field beside the reference solution: tables and JSON.

use serde::Serialize;
use serde_json::{Value, json};

use super::{AtNode, Beside, BodyDifference, ByCalculix, ContactValues};
use engine::{Distance, Overlap};
use output::json;
use output::model::{Cell, Report, Table};
use output::numbers::{
    Digits, coordinates, figure, percent, quantity, reason, six_digits, with_unit,
};
use output::pressure;
use output::tables::{decimals, overlap};
use problem::model::NodeId;
use problem::modelling::{ContactModel, Variant};

/// How many nodes are listed, those with the largest differences.
const WORST: usize = 10;

/// The part of the largest force on a node from which a force without balance is said to spoil the tractions.
const UNBALANCED: f64 = 1e-3;

/// What was compared, and what came of it.
#[derive(Serialize)]
pub struct Compared<'a> {
    /// Where the field is from: a file, or CalculiX with its version.
    #[serde(rename = "field")]
    pub other: String,
    /// How it was found or made, in lines.
    #[serde(skip)]
    pub about: Vec<String>,
    /// How CalculiX came to it; nothing of a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub calculix: Option<ByCalculix>,
    /// The largest difference that counts as none, over the largest displacement and in the energy norm;
    /// without one, differences are not judged.
    #[serde(rename = "rtol", skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// The field beside the reference solution.
    #[serde(flatten)]
    pub beside: Beside<'a>,
}

impl Compared<'_> {
    /// Returns whether the field is the reference solution within the tolerance; nothing without one.
    pub fn is_same(&self) -> Option<bool> {
        self.tolerance.map(|tolerance| self.beside.is_within(tolerance))
    }
}

/// Reports the distance of a field, its largest differences, and what it implies of contact.
pub fn report(compared: &Compared) -> Report {
    let beside = &compared.beside;
    let reference = beside.reference;
    let request = &reference.request;
    let others = reference.has_others().then_some(
        "NOTE: the solution compared with is not the only equilibrium: solve says which others there are",
    );
    let report = Report::titled(&request.scene.title)
        .line(format!("scene {} beside {}", request.scene.name, compared.other));
    let report = compared.about.iter().fold(report, Report::line);
    report
        .line(format!(
            "compared with {}, {} geometry",
            pressure::name(reference),
            request.contact.geometry
        ))
        .notes(request.scene.adapted().to_vec())
        .heading("Result")
        .notes(overlap(reference))
        .notes(verdict(compared))
        .notes(hidden(compared))
        .notes(others)
        .notes(unbalanced(beside))
        .table("Largest differences, by body", bodies(beside))
        .then(contact(beside))
        .then(worst(beside))
}

/// Says how far the field is from the reference solution and, where that is judged, whether it is the same.
fn verdict(compared: &Compared) -> [String; 2] {
    let Beside { distance, reference, .. } = &compared.beside;
    let Distance { displacement, displacement_relative, energy_relative, .. } = *distance;
    let judged = |tolerance: f64| {
        let is_same = compared.beside.is_within(tolerance);
        let verdict = if is_same { "Same within" } else { "Differs by more than" };
        let tolerance = six_digits(tolerance);
        format!("{verdict} --rtol {tolerance} (energy norm {})", part(energy_relative))
    };
    let units = &reference.request.scene.units;
    [
        compared.tolerance.map_or_else(
            || format!("Distance in the energy norm: {}", part(energy_relative)),
            judged,
        ),
        format!(
            "Largest difference of a displacement: {}, {} of the solution's largest",
            with_unit(&figure(displacement, None), &units.length),
            part(displacement_relative)
        ),
    ]
}

/// Names the body in which the largest von Mises stress differs by more than ten times the tolerance, where
/// both norms, which are those of all bodies together, take the field for the same.
fn hidden(compared: &Compared) -> Option<String> {
    let Beside { distance, .. } = &compared.beside;
    let bodies = distance.bodies.iter();
    let largest = bodies.max_by(|a, b| a.relative.abs().total_cmp(&b.relative.abs()))?;
    let is_hidden = compared.is_same()? && largest.relative.abs() > 10.0 * compared.tolerance?;
    is_hidden.then(|| {
        format!(
            "NOTE: both are of all bodies together; the largest von Mises stress of body {:?} differs by {}",
            largest.name,
            part(largest.relative)
        )
    })
}

/// Writes a part of 1 in per cent, and a very small or large one as a power of ten.
fn part(part: f64) -> String {
    let is_handy = part == 0.0 || (1e-4..1e3).contains(&part);
    if is_handy { percent(part) } else { figure(part, None) }
}

/// Says where the field is not in equilibrium inside the bodies, so that its tractions are not those of
/// contact.
fn unbalanced(beside: &Beside) -> Option<String> {
    let AtNode { node, value } = beside.unbalanced.filter(|at| at.value > UNBALANCED)?;
    Some(format!(
        "NOTE: the field is not in equilibrium under the scene's loads on this mesh of linear triangles: node {node} \
         is left with {} of the largest force on a node; tractions below are no better",
        percent(value)
    ))
}

fn bodies<'b>(beside: &'b Beside) -> Table<Vec<(&'b BodyDifference, &'b engine::BodyDistance)>> {
    let units = &beside.reference.request.scene.units;
    Table::from_rows(beside.bodies.iter().zip(&beside.distance.bodies))
        .column("body", |(body, _)| body.name.clone())
        .column(quantity("difference", &units.length), |(body, _)| {
            Cell::scientific(body.difference, 2)
        })
        .column("of its largest |u|", |(body, _)| {
            Cell::percent(body.relative).because(reason("relative"))
        })
        .column("node", |(body, _)| body.node)
        .column("x, y", |(body, _)| place(beside, body.node))
        .column(quantity("von Mises, field", &units.stress), |(_, stress)| {
            stressed(stress.von_mises_stress)
        })
        .column("solution", |(_, stress)| stressed(stress.reference))
        .column("difference", |(_, stress)| {
            Cell::percent(stress.relative).because(reason("relative"))
        })
}

fn stressed(stress: f64) -> Cell {
    Cell::of_digits(stress, Digits::of(stress, None))
}

fn place(beside: &Beside, node: NodeId) -> String {
    coordinates(beside.reference.model.coordinates(node), decimals(beside.reference))
}

/// Lists what both imply of contact.
fn contact(beside: &Beside) -> Report {
    let Some([field, reference]) = beside.contact() else { return Report::default() };
    let units = &beside.reference.request.scene.units;
    let force = |of: &ContactValues| match of.force {
        Some([x, y]) => {
            let digits = Digits::of(x.hypot(y), None);
            format!("{}, {}", digits.write(x), digits.write(y))
        }
        None => "none".into(),
    };
    let value = |at: Option<AtNode>| match at {
        Some(AtNode { node, value }) if value != 0.0 => {
            format!("{}, node {node}", figure(value, None))
        }
        Some(_) => "0".into(),
        None => "-".into(),
    };
    let row = |name: &str, unit: &str, of: &dyn Fn(&ContactValues) -> String| -> Vec<Cell> {
        vec![quantity(name, unit).into(), of(&field).into(), of(&reference).into()]
    };
    let rows = [
        row("force on the target x, y", &units.force, &force),
        row("deepest penetration", &units.length, &|of| value(of.penetration)),
        row("largest pressure", &units.stress, &|of| value(of.pressure)),
        row("largest pull", &units.stress, &|of| value(of.pull)),
        row("largest shear", &units.stress, &|of| value(of.shear)),
    ];
    Report::default().table(
        "What the displacements imply of contact",
        Table::new(["", "field", "solution"], rows),
    )
}

/// Lists the nodes with the largest differences, if there are any.
fn worst(beside: &Beside) -> Report {
    let mut nodes = beside.worst(WORST);
    nodes.retain(|node| beside.differences[node.index()] > 0.0);
    if nodes.is_empty() {
        return Report::default();
    }
    let [field, own] = [&beside.field, beside.reference].map(|solution| solution.displacements());
    let u = |of: &[[f64; 2]], node: &NodeId, axis: usize| {
        Cell::scientific(of[node.index()][axis] + 0.0, 4)
    };
    let table = Table::from_rows(nodes)
        .column("node", |node| *node)
        .column("x, y", |node| place(beside, *node))
        .column("u_x field", |node| u(&field, node, 0))
        .column("u_y field", |node| u(&field, node, 1))
        .column("u_x solution", |node| u(&own, node, 0))
        .column("u_y solution", |node| u(&own, node, 1))
        .column("difference", |node| Cell::scientific(beside.differences[node.index()], 2));
    let units = &beside.reference.request.scene.units;
    Report::default().table(quantity("The worst nodes: displacements", &units.length), table)
}

/// What was compared, as `--json` prints it.
#[derive(Serialize)]
struct Comparison<'a> {
    scene: &'a str,
    title: &'a str,
    variant: Variant,
    #[serde(flatten)]
    modelled: ContactModel,
    /// Absent, as `rtol` is, where differences are not judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    is_same: Option<bool>,
    /// Whether the solution compared with is not the only equilibrium.
    has_others: bool,
    /// Where its bodies lie in each other outside the groups of contact; null where they do not.
    overlap: &'a Option<Overlap>,
    /// What both imply of contact, each null without contact.
    contact: Value,
    worst_nodes: Vec<NodeId>,
    #[serde(flatten)]
    compared: &'a Compared<'a>,
}

/// Returns the comparison as JSON.
pub fn json(compared: &Compared) -> String {
    let reference = compared.beside.reference;
    let request = &reference.request;
    let [field, own] = compared.beside.contact().map_or([None; 2], |both| both.map(Some));
    let comparison = Comparison {
        scene: &request.scene.name,
        title: &request.scene.title,
        variant: request.variant,
        modelled: request.contact,
        is_same: compared.is_same(),
        has_others: reference.has_others(),
        overlap: &reference.overlap,
        contact: json!({ "field": field, "reference": own }),
        worst_nodes: compared.beside.worst(WORST),
        compared,
    };
    json::line(Some(&request.scene), &comparison)
}
