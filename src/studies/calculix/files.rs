//! The files of a comparison: JSON, CSV, pictures.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use super::table::{Compared, WORST};
use crate::calculix::{BodyStress, Comparison, Contact, Difference, Pair};
use base::error::Result;
use base::files::write_all;
use engine::estimates::Certainty;
use engine::{Quantity, TriangleState, TriangleValues};
use problem::element::Plane;
use problem::model::{NodeId, Triangle, TriangleId};
use problem::modelling::{Friction, Variant};
use report::json;
use report::model::Table;
use report::picture::{self, Drawing, Field};
use report::quantities::{MeasuredValue, measured};

/// The files of a comparison; the last marks their folder.
pub const FILES: [&str; 6] = [
    "nodes.csv",
    "elements.csv",
    "von_mises_stress.svg",
    "von_mises_stress_calculix.svg",
    "difference.svg",
    "compare.json",
];

/// Writes the files to `folder`; gives back the content of `compare.json`.
///
/// # Errors
/// A file cannot be written.
pub fn write(folder: &Path, compared: &Compared) -> Result<String> {
    let Compared { scene, model, comparison, .. } = compared;
    let Comparison { ours, theirs, von_mises, displacement, .. } = comparison;
    let kind = match compared.contact {
        Contact::Equations(..) => "equations",
        Contact::Pair(_) => "contact pair",
    };
    let title = format!("{} ({}, {kind})", scene.title, compared.variant);
    let drawing = Drawing::new(scene, &title);
    let field = |quantity: &str, unit: &str, values: &[f64], displacement: &[[f64; 2]]| {
        picture::field(&drawing, &Field { quantity, unit, values, displacement, largest_at: None })
    };
    let largest_at_corners = |triangle: &Triangle| {
        triangle.nodes.map(|node| displacement.at[node.index()].1).into_iter().fold(0.0, f64::max)
    };
    let difference = Field {
        quantity: "difference of displacements",
        unit: &scene.units.length,
        values: &model.triangles.iter().map(largest_at_corners).collect::<Vec<_>>(),
        displacement: &ours.u,
        largest_at: Some(displacement.largest.at.index()),
    };
    let stress = &scene.units.stress;
    let (nodes, elements) = (nodes(comparison), elements(comparison));
    let json = document(compared, &nodes, &elements);
    let contents = [
        nodes_csv(&nodes),
        elements_csv(&elements),
        field("von Mises stress, this program", stress, &von_mises[0], &ours.u),
        field("von Mises stress, CalculiX", stress, &von_mises[1], &theirs.u),
        picture::field(&drawing, &difference),
        json.clone(),
    ];
    let files: Vec<_> = FILES.into_iter().zip(contents).collect();
    write_all(folder, &files)?;
    Ok(json)
}

/// Returns the content of `compare.json`, and writes nothing.
pub fn json(compared: &Compared) -> String {
    document(compared, &nodes(compared.comparison), &elements(compared.comparison))
}

/// The content of `compare.json`.
#[derive(Serialize)]
pub struct Document<'a> {
    scene: &'a str,
    title: &'a str,
    variant: Variant,
    certainty: Certainty,
    /// The version of CalculiX.
    calculix: &'a str,
    plane: Plane,
    contact: ContactRow,
    decks: usize,
    displacement: &'a Difference<NodeId>,
    stress: &'a Difference<TriangleId>,
    bodies: &'a [BodyStress],
    /// The nodes with the largest differences, the largest first.
    worst_nodes: Vec<NodeId>,
    nodes: &'a [NodeRow],
    elements: &'a [ElementRow],
}

/// How the bodies touch in the deck.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum ContactRow {
    /// The same linear systems: the number of equations.
    Equation { equations: usize },
    /// CalculiX's own contact: its penalty, stress/length.
    Pair { penalty: f64, friction: Friction },
}

/// The displacements of a node, length.
#[derive(Serialize)]
struct NodeRow {
    n: NodeId,
    u: [f64; 2],
    u_calculix: [f64; 2],
    difference: f64,
}

/// The values of a triangle by both programs, and the largest difference of a stress.
#[derive(Serialize)]
struct ElementRow {
    n: TriangleId,
    difference: f64,
    /// The quantities that both know, by their names as in `result.json`; those of CalculiX end in
    /// `_calculix`.
    #[serde(flatten)]
    values: BTreeMap<String, MeasuredValue>,
}

fn document(compared: &Compared, nodes: &[NodeRow], elements: &[ElementRow]) -> String {
    let Compared { scene, model, comparison, .. } = compared;
    let document = Document {
        scene: &scene.name,
        title: &scene.title,
        variant: compared.variant,
        certainty: compared.certainty,
        calculix: compared.version,
        plane: model.plane,
        contact: match compared.contact {
            Contact::Equations(all, _) => ContactRow::Equation { equations: all.len() },
            Contact::Pair(Pair { penalty, friction }) => {
                ContactRow::Pair { penalty: *penalty, friction: *friction }
            }
        },
        decks: compared.decks,
        displacement: &comparison.displacement,
        stress: &comparison.stress,
        bodies: &comparison.bodies,
        worst_nodes: comparison.displacement.worst(WORST),
        nodes,
        elements,
    };
    json::line(Some(scene), &document)
}

fn nodes(comparison: &Comparison) -> Vec<NodeRow> {
    let Comparison { ours, theirs, displacement, .. } = comparison;
    let row = |&(n, difference): &(NodeId, f64)| {
        let k = n.index();
        NodeRow { n, u: ours.u[k], u_calculix: theirs.u[k], difference }
    };
    displacement.at.iter().map(row).collect()
}

fn elements(comparison: &Comparison) -> Vec<ElementRow> {
    let row = |&(n, difference): &(TriangleId, f64)| {
        // Only stresses are known of CalculiX.
        let [ours, theirs] = [0, 1].map(|of| {
            let [x, y, z, xy, ..] = [&comparison.ours, &comparison.theirs][of].sigma[n.index()];
            let von_mises = comparison.von_mises[of][n.index()];
            let state = TriangleState::stressed([x, y, xy, z], von_mises);
            measured(&TriangleValues::new(&state))
        });
        let ours = ours.into_iter().map(|(name, value)| (name.to_string(), value));
        let theirs = theirs.into_iter().map(|(name, value)| (format!("{name}_calculix"), value));
        ElementRow { n, difference, values: ours.chain(theirs).collect() }
    };
    comparison.stress.at.iter().map(row).collect()
}

fn nodes_csv(rows: &[NodeRow]) -> String {
    Table::from_rows(rows)
        .column("node", |row| row.n)
        .column("u_x", |row| row.u[0])
        .column("u_y", |row| row.u[1])
        .column("u_x_calculix", |row| row.u_calculix[0])
        .column("u_y_calculix", |row| row.u_calculix[1])
        .column("difference", |row| row.difference)
        .csv()
}

/// Writes a column for each component of a quantity that both programs know.
fn elements_csv(elements: &[ElementRow]) -> String {
    let known = TriangleValues::QUANTITIES
        .iter()
        .filter(|quantity| elements.iter().all(|row| row.values.contains_key(quantity.name)));
    let known: Vec<&Quantity<TriangleValues>> = known.collect();
    let ours = known.iter().map(|quantity| (quantity.name.to_string(), quantity.components()));
    let theirs = known.iter().map(|quantity| {
        let components = quantity.components().into_iter().map(|name| name + "_calculix");
        (format!("{}_calculix", quantity.name), components.collect())
    });
    let table = Table::from_rows(elements).column("element", |row| row.n);
    let table = ours.chain(theirs).fold(table, |table, (name, components): (_, Vec<String>)| {
        components.iter().enumerate().fold(table, |table, (k, component)| {
            table.column(component, |row| row.values[&name].numbers()[k])
        })
    });
    table.column("difference", |row| row.difference).csv()
}
