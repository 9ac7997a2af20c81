//! This program beside CalculiX: tables, JSON, CSV, pictures.

use std::fmt::Display;

use crate::calculix::{BodyStress, Comparison, Contact, Difference, Pair};
use engine::estimates::Certainty;
use problem::element::Plane;
use problem::model::{Model, NodeId};
use problem::modelling::Variant;
use problem::scene::Scene;
use report::model::{Cell, Report, Table};
use report::numbers::{coordinates, decimals_of_places, quantity, short, with_unit};
use report::tables::certainty;

pub use super::files::{Document, FILES, json, write};

/// How many nodes are listed, those with the largest differences.
pub(super) const WORST: usize = 10;

/// What a comparison with CalculiX compared.
pub struct Compared<'a> {
    /// The scene, which names units and title.
    pub scene: &'a Scene,
    /// The scene's model under the reading that was asked for.
    pub model: &'a Model,
    /// The variant whose contact was given to `ccx`.
    pub variant: Variant,
    /// Whether rounding decides who is in contact in the run that is compared.
    pub certainty: Certainty,
    /// How the deck has the bodies touch; the last of several decks.
    pub contact: &'a Contact,
    /// How many decks were run.
    pub decks: usize,
    /// The version that `ccx` reports.
    pub version: &'a str,
    /// The results of both, and their differences.
    pub comparison: &'a Comparison,
}

/// Reports the differences in tables.
pub fn report(compared: &Compared) -> Report {
    let Compared { scene, model, variant, version, comparison, .. } = compared;
    let report = Report::titled(&scene.title)
        .line(format!(
            "scene {}, variant {variant}, beside CalculiX {version}; plane {}; {} nodes, {} triangles",
            scene.name,
            model.plane,
            model.nodes.len(),
            model.triangles.len()
        ))
        .line(contact(compared));
    let report = match model.plane {
        Plane::Strain => report,
        Plane::Stress => report.line(
            "Plane stress: CalculiX lets triangles share their thickness at nodes, and so differs.",
        ),
    };
    certainty(compared.certainty)
        .into_iter()
        .fold(report, Report::line)
        .table(
            "Largest differences: of a node's displacement, over CalculiX's largest; of sigma_x, sigma_y \
             or tau_xy of a triangle, over CalculiX's largest von Mises stress",
            differences(compared),
        )
        .table(quantity("Largest von Mises stress", &scene.units.stress), bodies(comparison))
        .table("The worst nodes", worst(compared))
}

/// Says how the bodies touch in what CalculiX ran.
fn contact(compared: &Compared) -> String {
    let units = &compared.scene.units;
    match (compared.contact, compared.decks) {
        (Contact::Equations(equations, _), 1) => {
            format!("{} equations: those of the last iteration", equations.len())
        }
        (Contact::Equations(_, _), decks) => format!(
            "{decks} decks, one for each contact state of the increments, \
             summed with their shares of the load"
        ),
        (Contact::Pair(Pair { penalty, friction }), _) => {
            let unit = match (units.stress.as_str(), units.length.as_str()) {
                ("", _) | (_, "") => String::new(),
                (stress, length) => format!("{stress}/{length}"),
            };
            let penalty = with_unit(&short(*penalty), &unit);
            format!("contact pair, penalty {penalty}, friction {friction}")
        }
    }
}

fn differences(compared: &Compared) -> Table {
    let Compared { scene, model, comparison, .. } = compared;
    let (u, s) = (&comparison.displacement, &comparison.stress);
    let decimals = decimals_of_places(model.bounds().larger_side());
    let corners = model.corners(s.largest.at);
    let centre = [0, 1].map(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>() / 3.0);
    Table::new(
        [
            "quantity",
            "largest difference",
            "over CalculiX's largest",
            "CalculiX's largest",
            "at",
            "at x, y",
            "rms difference",
        ],
        [
            row(
                quantity("displacement", &scene.units.length),
                u,
                "node",
                (model.coordinates(u.largest.at), decimals),
            ),
            row(quantity("stress", &scene.units.stress), s, "triangle", (centre, decimals)),
        ],
    )
}

/// Returns the cells of the largest difference: of what, how large, and where.
fn row<Place: Display>(
    of: String,
    difference: &Difference<Place>,
    kind: &str,
    (at, decimals): ([f64; 2], usize),
) -> Vec<Cell> {
    let largest = &difference.largest;
    vec![
        of.into(),
        Cell::scientific(largest.difference, 3),
        largest.relative.map(|relative| Cell::scientific(relative, 1)).into(),
        largest.scale.into(),
        format!("{kind} {}", largest.at).into(),
        coordinates(at, decimals).into(),
        Cell::scientific(difference.rms, 3),
    ]
}

fn bodies(comparison: &Comparison) -> Table<Vec<&BodyStress>> {
    Table::from_rows(&comparison.bodies)
        .column("body", |body| body.name.clone())
        .column("here", |body| body.ours)
        .column("CalculiX", |body| body.calculix)
        .column("difference over CalculiX's", |body| body.relative().map(Cell::percent))
}

fn worst(compared: &Compared) -> Table<Vec<NodeId>> {
    let Compared { model, comparison, .. } = compared;
    let decimals = decimals_of_places(model.bounds().larger_side());
    let Comparison { ours, theirs, displacement, .. } = comparison;
    // + 0: no component is −0.
    let component = |u: &[[f64; 2]], node: NodeId, axis: usize| {
        Cell::scientific(u[node.index()][axis] + 0.0, 6)
    };
    Table::from_rows(displacement.worst(WORST))
        .column("node", |n| *n)
        .column("x, y", |n| coordinates(model.coordinates(*n), decimals))
        .column("u_x here", |n| component(&ours.u, *n, 0))
        .column("u_y here", |n| component(&ours.u, *n, 1))
        .column("u_x CalculiX", |n| component(&theirs.u, *n, 0))
        .column("u_y CalculiX", |n| component(&theirs.u, *n, 1))
        .column("difference", |n| Cell::scientific(displacement.at[n.index()].1, 3))
}
