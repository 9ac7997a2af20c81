//! The files of a comparison: JSON, CSV, pictures.

use std::path::Path;

use serde::Serialize;
use serde_json::{Value, json};

use super::{Compared, WORST};
use crate::error::Result;
use crate::problem::model::{NodeId, Triangle, TriangleId};
use crate::report::json::headed;
use crate::report::output::{csv, write_all};
use crate::report::picture::{self, Drawing, Field};
use crate::studies::calculix::{Comparison, Contact, Difference, Pair};

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

fn document(compared: &Compared, nodes: &[Value], elements: &[Value]) -> String {
    let Compared { scene, model, comparison, .. } = compared;
    headed(
        Some(scene),
        &json!({
            "scene": scene.name,
            "title": scene.title,
            "variant": compared.variant,
            "certainty": compared.certainty,
            "calculix": compared.version,
            "plane": model.plane,
            "contact": contact_value(compared.contact),
            "decks": compared.decks,
            "displacement": difference_value(&comparison.displacement),
            "stress": difference_value(&comparison.stress),
            "bodies": comparison.bodies,
            "worst_nodes": comparison.displacement.worst(WORST),
            "nodes": nodes,
            "elements": elements,
        }),
    )
}

fn difference_value<Place: Serialize>(of: &Difference<Place>) -> Value {
    json!({ "largest": of.largest, "rms": of.rms })
}

fn contact_value(contact: &Contact) -> Value {
    match contact {
        Contact::Equations(all, _) => json!({ "kind": "equation", "equations": all.len() }),
        Contact::Pair(Pair { penalty, friction }) => {
            json!({ "kind": "pair", "penalty": penalty, "friction": friction })
        }
    }
}

fn nodes(comparison: &Comparison) -> Vec<Value> {
    let Comparison { ours, theirs, displacement, .. } = comparison;
    let row = |(node, difference): &(NodeId, f64)| {
        let k = node.index();
        json!({ "n": node, "u": ours.u[k], "u_calculix": theirs.u[k], "difference": difference })
    };
    displacement.at.iter().map(row).collect()
}

fn elements(comparison: &Comparison) -> Vec<Value> {
    let Comparison { ours, theirs, von_mises, stress, .. } = comparison;
    let row = |(id, difference): &(TriangleId, f64)| {
        let k = id.index();
        json!({
            "n": id, "sigma": plane(&ours.sigma[k]), "sigma_calculix": plane(&theirs.sigma[k]),
            "von_mises_stress": von_mises[0][k], "von_mises_stress_calculix": von_mises[1][k],
            "difference": difference,
        })
    };
    stress.at.iter().map(row).collect()
}

/// Lays out `fields` of rows of JSON as CSV; a list of numbers takes as many cells.
fn csv_of([head, fields]: [&str; 2], rows: &[Value]) -> String {
    let cells = |row: &Value| fields.split(',').flat_map(|field| numbers(&row[field])).collect();
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
