//! This program beside CalculiX: tables, JSON, CSV, pictures.

mod files;

use std::fmt::Display;

use super::layout::{Table, aligned};
use super::numbers::{or_dash, percent, place, quantity, short, with_unit};
use super::tables::certainty;
use engine::estimates::Certainty;
use problem::element::Plane;
use problem::model::{Model, NodeId};
use problem::modelling::Variant;
use problem::scene::Scene;
use studies::calculix::{Comparison, Contact, Difference, Pair};

pub use files::{Document, json, write};

/// How many nodes are listed, those with the largest differences.
const WORST: usize = 10;

pub struct Compared<'a> {
    /// The scene, which names units and title.
    pub scene: &'a Scene,
    pub model: &'a Model,
    pub variant: Variant,
    /// Whether rounding decides who is in contact in the run that is compared.
    pub certainty: Certainty,
    /// How the deck has the bodies touch; the last of several decks.
    pub contact: &'a Contact,
    pub decks: usize,
    pub version: &'a str,
    /// The results of both, and their differences.
    pub comparison: &'a Comparison,
}

/// Lays out the differences in tables.
pub fn text(compared: &Compared) -> String {
    let Compared { scene, comparison, .. } = compared;
    format!(
        "{}\n{}\n\nLargest differences: of a node's displacement, over CalculiX's largest; of sigma_x, sigma_y or \
         tau_xy of a triangle, over CalculiX's largest von Mises stress\n{}\n{}\n{}\nThe worst nodes\n{}",
        scene.title,
        heading(compared),
        differences(compared),
        quantity("Largest von Mises stress", &scene.units.stress),
        bodies(comparison),
        worst(compared)
    )
}

fn heading(compared: &Compared) -> String {
    let Compared { scene, model, variant, version, .. } = compared;
    let plane_stress = match model.plane {
        Plane::Strain => "",
        Plane::Stress => {
            "\nPlane stress: CalculiX lets triangles share their thickness at nodes, \
             and so differs."
        }
    };
    format!(
        "scene {}, variant {variant}, beside CalculiX {version}; plane {}; \
         {} nodes, {} triangles\n{}{plane_stress}{}",
        scene.name,
        model.plane,
        model.nodes.len(),
        model.triangles.len(),
        contact(compared),
        certainty(compared.certainty).map_or(String::new(), |words| format!("\n{words}"))
    )
}

/// Tells how the bodies touch in what CalculiX ran.
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

fn differences(compared: &Compared) -> String {
    let Compared { scene, model, comparison, .. } = compared;
    let (u, s) = (&comparison.displacement, &comparison.stress);
    let corners = model.corners(s.largest.at);
    let centre = [0, 1].map(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>() / 3.0);
    let rows = [
        row(quantity("displacement", &scene.units.length), u, "node", model.at(u.largest.at)),
        row(quantity("stress", &scene.units.stress), s, "triangle", centre),
    ];
    aligned(
        ["of", "largest difference", "over CalculiX's", "which is", "at", "at x, y", "rms"],
        rows,
    )
}

/// Returns the cells of the largest difference: of what, how large, and where.
fn row<Place: Display>(
    of: String,
    difference: &Difference<Place>,
    kind: &str,
    at: [f64; 2],
) -> Vec<String> {
    let largest = &difference.largest;
    vec![
        of,
        format!("{:.3e}", largest.difference),
        or_dash(largest.relative, |relative| format!("{relative:.1e}")),
        short(largest.scale),
        format!("{kind} {}", largest.at),
        place(at, 3),
        format!("{:.3e}", difference.rms),
    ]
}

fn bodies(comparison: &Comparison) -> String {
    Table::of(&comparison.bodies)
        .column("body", |body| body.name.clone())
        .column("here", |body| short(body.ours))
        .column("CalculiX", |body| short(body.calculix))
        .column("difference over CalculiX's", |body| {
            or_dash(body.relative(), |relative| percent(relative, 1))
        })
        .text()
}

fn worst(compared: &Compared) -> String {
    let Compared { model, comparison, .. } = compared;
    let Comparison { ours, theirs, displacement, .. } = comparison;
    // + 0: no component is −0.
    let component =
        |u: &[[f64; 2]], node: NodeId, axis: usize| format!("{:.6e}", u[node.index()][axis] + 0.0);
    Table::of(displacement.worst(WORST))
        .column("node", |n| *n)
        .column("x, y", |n| place(model.at(*n), 3))
        .column("u_x here", |n| component(&ours.u, *n, 0))
        .column("u_y here", |n| component(&ours.u, *n, 1))
        .column("u_x CalculiX", |n| component(&theirs.u, *n, 0))
        .column("u_y CalculiX", |n| component(&theirs.u, *n, 1))
        .column("difference", |n| format!("{:.3e}", displacement.at[n.index()].1))
        .text()
}
