//! The files of a comparison: JSON, CSV, pictures.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Value, to_value};

use super::{Compared, WORST};
use crate::json::of_scene;
use crate::output::csv;
use crate::picture::{self, Drawing, Field};
use base::error::Result;
use base::files::write_all;
use engine::estimates::Certainty;
use problem::element::Plane;
use problem::model::{NodeId, Triangle, TriangleId};
use problem::modelling::{Friction, Variant};
use studies::calculix::{BodyStress, Comparison, Contact, Difference, Largest, Pair};

/// The heading of `nodes.csv`, and the fields of a node that stand under it.
const NODES: [&str; 2] =
    ["node,u_x,u_y,u_x_calculix,u_y_calculix,difference", "n,u,u_calculix,difference"];

/// The heading of `elements.csv`, and the fields of a triangle that stand under it.
const ELEMENTS: [&str; 2] = [
    "element,sigma_x,sigma_y,tau_xy,von_mises_stress,\
     sigma_x_calculix,sigma_y_calculix,tau_xy_calculix,von_mises_stress_calculix,difference",
    "n,sigma,von_mises_stress,sigma_calculix,von_mises_stress_calculix,difference",
];

/// Writes `compare.json`, `nodes.csv`, `elements.csv` and three pictures to `folder`; gives back
/// the first one's content.
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
    write_all(
        folder,
        "compare",
        &[
            ("nodes.csv", &csv_of(NODES, &nodes)),
            ("elements.csv", &csv_of(ELEMENTS, &elements)),
            (
                "von_mises_stress.svg",
                &field("von Mises stress, this program", stress, &von_mises[0], &ours.u),
            ),
            (
                "von_mises_stress_calculix.svg",
                &field("von Mises stress, CalculiX", stress, &von_mises[1], &theirs.u),
            ),
            ("difference.svg", &picture::field(&drawing, &difference)),
            ("compare.json", &json),
        ],
    )?;
    Ok(json)
}

/// Returns the content of `compare.json`, and writes nothing.
pub fn json(compared: &Compared) -> String {
    document(compared, &nodes(compared.comparison), &elements(compared.comparison))
}

/// The content of `compare.json`.
#[derive(Serialize, JsonSchema)]
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
    displacement: Differences<NodeId>,
    stress: Differences<TriangleId>,
    bodies: &'a [BodyStress],
    /// The nodes with the largest differences, the largest first.
    worst_nodes: Vec<NodeId>,
    nodes: &'a [NodeRow],
    elements: &'a [ElementRow],
}

/// How the bodies touch in the deck.
#[derive(Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum ContactRow {
    /// The same linear systems: the number of equations.
    Equation { equations: usize },
    /// CalculiX's own contact: its penalty, stress/length.
    Pair { penalty: f64, friction: Friction },
}

/// The largest difference, and the root of the mean of the squares of all.
#[derive(Serialize, JsonSchema)]
struct Differences<Place> {
    largest: Largest<Place>,
    rms: f64,
}

impl<Place: Copy> From<&Difference<Place>> for Differences<Place> {
    fn from(of: &Difference<Place>) -> Self {
        Differences { largest: of.largest, rms: of.rms }
    }
}

/// The displacements of a node, length.
#[derive(Serialize, JsonSchema)]
struct NodeRow {
    n: NodeId,
    u: [f64; 2],
    u_calculix: [f64; 2],
    difference: f64,
}

/// The stresses sigma_x, sigma_y, tau_xy of a triangle.
#[derive(Serialize, JsonSchema)]
struct ElementRow {
    n: TriangleId,
    sigma: [f64; 3],
    sigma_calculix: [f64; 3],
    von_mises_stress: f64,
    von_mises_stress_calculix: f64,
    difference: f64,
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
        contact: contact_row(compared.contact),
        decks: compared.decks,
        displacement: (&comparison.displacement).into(),
        stress: (&comparison.stress).into(),
        bodies: &comparison.bodies,
        worst_nodes: comparison.displacement.worst(WORST),
        nodes,
        elements,
    };
    of_scene(scene, &document)
}

fn contact_row(contact: &Contact) -> ContactRow {
    match contact {
        Contact::Equations(all, _) => ContactRow::Equation { equations: all.len() },
        Contact::Pair(Pair { penalty, friction }) => {
            ContactRow::Pair { penalty: *penalty, friction: *friction }
        }
    }
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
    let Comparison { ours, theirs, von_mises, stress, .. } = comparison;
    let row = |&(n, difference): &(TriangleId, f64)| {
        let k = n.index();
        ElementRow {
            n,
            sigma: plane(&ours.sigma[k]),
            sigma_calculix: plane(&theirs.sigma[k]),
            von_mises_stress: von_mises[0][k],
            von_mises_stress_calculix: von_mises[1][k],
            difference,
        }
    };
    stress.at.iter().map(row).collect()
}

/// Lays out `fields` of rows as CSV; a list of numbers takes as many cells.
fn csv_of([head, fields]: [&str; 2], rows: &[impl Serialize]) -> String {
    let cells = |row| {
        let row = to_value(row).expect("a row has string keys");
        fields.split(',').flat_map(|field| numbers(&row[field])).collect()
    };
    csv(head, rows.iter().map(cells))
}

fn numbers(value: &Value) -> Vec<String> {
    match value {
        Value::Array(values) => values.iter().flat_map(numbers).collect(),
        Value::Number(x) if x.is_f64() => vec![format!("{:e}", x.as_f64().expect("a float"))],
        other => vec![other.to_string()],
    }
}

/// Returns sigma_x, sigma_y, tau_xy of the six components of a stress.
fn plane(sigma: &[f64; 6]) -> [f64; 3] {
    [sigma[0], sigma[1], sigma[3]]
}
