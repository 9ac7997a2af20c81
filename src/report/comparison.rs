//! This program beside CalculiX: tables, JSON, CSV, pictures.

use std::fmt::{Display, Write as _};
use std::path::Path;

use serde::Serialize;
use serde_json::{Value, json};

use super::folder;
use super::tables::{aligned, short};
use crate::error::InputError;
use crate::files;
use crate::problem::element::Plane;
use crate::problem::model::{Model, NodeId, Triangle, TriangleId};
use crate::problem::modelling::Variant;
use crate::problem::scene::Scene;
use crate::studies::calculix::{Comparison, Contact, Difference, Pair};

/// How many nodes are listed.
const WORST: usize = 10;

/// What was compared.
pub struct Compared<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The model that was solved.
    pub model: &'a Model,
    /// What this program ran.
    pub variant: Variant,
    /// How the deck has the bodies touch; the last of several decks.
    pub contact: &'a Contact,
    /// How many decks were run and summed.
    pub decks: usize,
    /// The version of CalculiX.
    pub version: &'a str,
    /// Both results.
    pub comparison: &'a Comparison,
}

/// The tables.
pub fn text(compared: &Compared) -> String {
    let Compared { scene, comparison, .. } = compared;
    format!(
        "{}\n{}\n\nLargest differences\n{}\nLargest von Mises stress{}\n{}\nThe worst nodes\n{}",
        scene.title,
        heading(compared),
        differences(compared),
        in_unit(&scene.units.stress),
        bodies(comparison),
        worst(compared)
    )
}

fn heading(compared: &Compared) -> String {
    let Compared { scene, model, variant, version, .. } = compared;
    let mut text = format!(
        "scene {}, variant {variant}, beside CalculiX {version}; plane {}; {} nodes, {} triangles\n",
        scene.name,
        model.plane,
        model.nodes.len(),
        model.triangles.len()
    );
    text += &contact(compared);
    if model.plane == Plane::Stress {
        text += "\nPlane stress: CalculiX lets triangles share their thickness at nodes, and so differs.";
    }
    text
}

/// How the bodies touch in what CalculiX ran.
fn contact(compared: &Compared) -> String {
    let units = &compared.scene.units;
    match (compared.contact, compared.decks) {
        (Contact::Equations(equations), 1) => {
            format!("{} equations: those of the last iteration", equations.len())
        }
        (Contact::Equations(_), decks) => {
            format!(
                "{decks} decks, one for each contact state of the increments, summed with their shares of the load"
            )
        }
        (Contact::Pair(Pair { penalty, friction }), _) => {
            let unit = match (units.stress.as_str(), units.length.as_str()) {
                ("", _) | (_, "") => String::new(),
                (stress, length) => format!(" {stress}/{length}"),
            };
            format!("contact pair, penalty {}{unit}, friction {friction}", short(*penalty))
        }
    }
}

fn differences(compared: &Compared) -> String {
    let Compared { scene, model, comparison, .. } = compared;
    let head = ["of", "largest", "relative", "of the largest", "at", "at x, y", "rms"];
    let (u, s) = (&comparison.displacement, &comparison.stress);
    aligned(&[
        head.map(String::from).to_vec(),
        row("displacement", &scene.units.length, "node", u, model.at(u.largest.at)),
        row("stress", &scene.units.stress, "triangle", s, centre(model, s.largest.at)),
    ])
}

/// A row of the table of the largest differences.
fn row<Place: Copy + Display>(
    name: &str,
    unit: &str,
    kind: &str,
    difference: &Difference<Place>,
    at: [f64; 2],
) -> Vec<String> {
    let largest = difference.largest;
    vec![
        format!("{name}{}", in_unit(unit)),
        format!("{:.3e}", largest.difference),
        format!("{:.1e}", largest.relative),
        short(largest.scale),
        format!("{kind} {}", largest.at),
        format!("{:.3}, {:.3}", at[0], at[1]),
        format!("{:.3e}", difference.rms),
    ]
}

fn bodies(comparison: &Comparison) -> String {
    let head = ["body", "here", "CalculiX", "relative difference"].map(String::from).to_vec();
    let rows = comparison.bodies.iter().map(|body| {
        let difference = if body.ours == 0.0 {
            String::from("-")
        } else {
            format!("{:.1e}", (body.calculix - body.ours) / body.ours)
        };
        vec![body.name.clone(), short(body.ours), short(body.calculix), difference]
    });
    aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>())
}

fn worst(compared: &Compared) -> String {
    let Compared { model, comparison, .. } = compared;
    let head =
        ["node", "x, y", "u_x here", "u_y here", "u_x CalculiX", "u_y CalculiX", "difference"];
    let rows = comparison.displacement.worst(WORST).into_iter().map(|n| {
        let ([x, y], u) = (model.at(n), comparison.ours.u[n.index()]);
        let cells = u.iter().chain(&comparison.theirs.u[n.index()]);
        let mut row = vec![n.to_string(), format!("{x:.3}, {y:.3}")];
        // + 0: no component is −0.
        row.extend(cells.map(|value| format!("{:.6e}", value + 0.0)));
        row.push(format!("{:.3e}", comparison.displacement.at[n.index()].1));
        row
    });
    aligned(&std::iter::once(head.map(String::from).to_vec()).chain(rows).collect::<Vec<_>>())
}

/// `compare.json`: everything.
pub fn json(compared: &Compared) -> String {
    let Compared { scene, model, comparison, .. } = compared;
    let document = json!({
        "scene": scene.name,
        "title": scene.title,
        "variant": compared.variant,
        "calculix": compared.version,
        "plane": model.plane,
        "contact": contact_value(compared.contact),
        "decks": compared.decks,
        "units": scene.units,
        "displacement": difference_value(&comparison.displacement),
        "stress": difference_value(&comparison.stress),
        "bodies": comparison.bodies,
        "worst_nodes": comparison.displacement.worst(WORST),
        "nodes": nodes(comparison),
        "elements": elements(comparison),
    });
    document.to_string() + "\n"
}

fn difference_value<Place: Serialize>(of: &Difference<Place>) -> Value {
    json!({ "largest": of.largest, "rms": of.rms })
}

fn contact_value(contact: &Contact) -> Value {
    match contact {
        Contact::Equations(equations) => {
            json!({ "kind": "equation", "equations": equations.len() })
        }
        Contact::Pair(Pair { penalty, friction }) => {
            json!({ "kind": "pair", "penalty": penalty, "friction": friction })
        }
    }
}

fn nodes(comparison: &Comparison) -> Vec<Value> {
    let Comparison { ours, theirs, displacement, .. } = comparison;
    let row = |(node, difference): &(NodeId, f64)| {
        let k = node.index();
        json!({
            "n": node, "u": ours.u[k], "u_calculix": theirs.u[k], "difference": difference,
        })
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

/// Writes `compare.json`, `nodes.csv`, `elements.csv` and three pictures to `folder`; gives back the first one's content.
///
/// # Errors
/// A file that cannot be written.
pub fn write(folder: &Path, compared: &Compared) -> Result<String, InputError> {
    let comparison = compared.comparison;
    let units = &compared.scene.units;
    let stress = |name: &str, values: &[f64], u: &[[f64; 2]]| {
        picture(compared, &format!("von Mises stress, {name}"), &units.stress, values, u)
    };
    let (ours, theirs) = (&comparison.ours.u, &comparison.theirs.u);
    let files = [
        ("nodes.csv", nodes_csv(comparison)),
        ("elements.csv", elements_csv(comparison)),
        ("von_mises_stress.svg", stress("this program", &comparison.von_mises[0], ours)),
        ("von_mises_stress_calculix.svg", stress("CalculiX", &comparison.von_mises[1], theirs)),
        ("difference.svg", difference_picture(compared)),
    ];
    files.iter().try_for_each(|(name, content)| files::write(&folder.join(name), content))?;
    let json = json(compared);
    files::write(&folder.join("compare.json"), &json)?;
    Ok(json)
}

/// The largest difference of displacement at a triangle's corners.
fn difference_picture(compared: &Compared) -> String {
    let comparison = compared.comparison;
    let of_triangle = |triangle: &Triangle| {
        let at = triangle.nodes.map(|node| comparison.displacement.at[node.index()].1);
        at.into_iter().fold(0.0, f64::max)
    };
    let values: Vec<f64> = compared.model.triangles.iter().map(of_triangle).collect();
    let unit = &compared.scene.units.length;
    picture(compared, "difference of displacements", unit, &values, &comparison.ours.u)
}

fn picture(
    compared: &Compared,
    quantity: &str,
    unit: &str,
    values: &[f64],
    u: &[[f64; 2]],
) -> String {
    let kind = match compared.contact {
        Contact::Equations(_) => "equations",
        Contact::Pair(_) => "contact pair",
    };
    let title = format!("{} ({}, {kind})", compared.scene.title, compared.variant);
    folder::field_picture(
        compared.scene,
        &title,
        &super::picture::Field { quantity, unit, values, displacement: u },
    )
}

fn nodes_csv(comparison: &Comparison) -> String {
    let Comparison { ours, theirs, displacement, .. } = comparison;
    let mut text = String::from("node,u_x,u_y,u_x_calculix,u_y_calculix,difference\n");
    for (node, difference) in &displacement.at {
        let ([x, y], [their_x, their_y]) = (ours.u[node.index()], theirs.u[node.index()]);
        writeln!(text, "{node},{x:e},{y:e},{their_x:e},{their_y:e},{difference:e}")
            .expect("a String takes any text");
    }
    text
}

fn elements_csv(comparison: &Comparison) -> String {
    let Comparison { ours, theirs, von_mises, stress, .. } = comparison;
    let columns = ["sigma_x", "sigma_y", "tau_xy", "von_mises_stress"];
    let mut text = format!(
        "element,{},{}_calculix,difference\n",
        columns.join(","),
        columns.join("_calculix,")
    );
    for (id, difference) in &stress.at {
        let k = id.index();
        let by = |sigma: &[f64; 6], von_mises: f64| {
            let [x, y, xy] = plane(sigma);
            format!("{x:e},{y:e},{xy:e},{von_mises:e}")
        };
        let here = by(&ours.sigma[k], von_mises[0][k]);
        let there = by(&theirs.sigma[k], von_mises[1][k]);
        writeln!(text, "{id},{here},{there},{difference:e}").expect("a String takes any text");
    }
    text
}

/// sigma_x, sigma_y, tau_xy.
fn plane(sigma: &[f64; 6]) -> [f64; 3] {
    [sigma[0], sigma[1], sigma[3]]
}

/// The centre of a triangle.
fn centre(model: &Model, triangle: TriangleId) -> [f64; 2] {
    let corners = model.corners(triangle);
    [0, 1].map(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>() / 3.0)
}

/// `, unit`, or nothing where the scene names none.
fn in_unit(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(", {unit}") }
}
