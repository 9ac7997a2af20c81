//! The page of an audit report: the report as a document, then the fields of every run.
//!
//! Its data: `runs`, each with `result` as `result.json` has it, and the mesh and the fields as numbers
//! in base64, little-endian: `u` and `triangles` (all components of a quantity by its name) in 32 bits;
//! of iterations before the last `u`, and the von Mises stress in 16 bits of its largest. `quantities`
//! says what there is, and in which units.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::{Contents, Run};
use crate::calculix::{Comparison, Fields};
use engine::{Detail, Step, Stiffness, TriangleState, TriangleValues};
use problem::model::{Model, NodeId};
use report::json::document;
use report::language::Language;
use report::model::Report;
use report::page::Page;
use report::picture::{colour, points};
use report::{ResultFile, pressure, quantities};

/// The shades of a field.
const SHADES: u8 = 64;

/// Returns the page of a report, which was made of `contents`.
pub fn html(report: &Report, contents: &Contents) -> String {
    let scene = contents.scene;
    let runs = contents.runs.par_iter().map(run).collect::<Vec<Value>>();
    let calculix = contents.calculix.as_ref().map(|compared| calculix_run(compared.comparison));
    let own = json!({
        "mesh": mesh(&scene.model),
        "runs": runs.into_iter().chain(calculix).collect::<Vec<_>>(),
        "own": own_run(contents),
        "equilibrium": contents.runs.last().map(|run| pressure::name(run.solution)),
        "colours": colour::parts(SHADES),
        "quantities": quantities::on_pages(),
    });
    Page {
        language: Language::En,
        title: &format!("Report: {}", scene.name),
        body: &include_str!("page/body.html").replace("DOCUMENT", &report.html()),
        style: include_str!("page/report.css"),
        script: &[
            report::page::TABLE,
            include_str!("page/fields.js"),
            include_str!("page/raster.js"),
            include_str!("page/viewer.js"),
            include_str!("page/report.js"),
        ],
        data: document(Some(scene), &own),
    }
    .html()
}

/// Returns the name of the run of the scene's own variant.
fn own_run(contents: &Contents) -> Option<String> {
    let own = |run: &&Run| run.solution.request.variant == contents.scene.variant;
    contents.runs.iter().find(own).map(|run| pressure::name(run.solution))
}

fn base64(bytes: &[u8]) -> String {
    BASE64_STANDARD.encode(bytes)
}

/// Writes numbers in 32 bits.
fn floats(numbers: impl IntoIterator<Item = f64>) -> String {
    base64(&numbers.into_iter().flat_map(|x| (x as f32).to_le_bytes()).collect::<Vec<u8>>())
}

fn mesh(model: &Model) -> Value {
    let nodes = model.triangles.iter().flat_map(|triangle| triangle.nodes);
    let indices: Vec<u8> = nodes.flat_map(|n| (n.index() as u32).to_le_bytes()).collect();
    let mut body = vec![0u8; model.triangles.len()];
    for (place, own) in model.bodies.iter().enumerate() {
        own.triangles.iter().for_each(|id| body[id.index()] = place.min(255) as u8);
    }
    json!({
        "nodes": floats(points(model).as_flattened().iter().copied()),
        "triangles": base64(&indices),
        "body": base64(&body),
        "bodies": model.bodies.iter().map(|body| &body.name).collect::<Vec<_>>(),
        "contact": model.contact.nodes,
        "edges": model.target_edges().map(|edge| edge.nodes).collect::<Vec<[NodeId; 2]>>(),
    })
}

fn run(run: &Run) -> Value {
    let solution = run.solution;
    let stiffness = Stiffness::new(&solution.model, |x| x);
    let before = solution.steps.windows(2).filter(|steps| is_shown(&steps[0], &steps[1]));
    let before = before.map(|steps| iteration(&solution.model, &stiffness, [&steps[0], &steps[1]]));
    let result = ResultFile::new(solution, &run.assessment, None);
    json!({
        "name": pressure::name(solution),
        "result": ResultFile { nodes: None, u_digits: None, elements: None, ..result },
        "u": floats(solution.u.iter().copied()),
        "triangles": triangles(&TriangleValues::all(solution, run.assessment.mesh_error().as_deref())),
        "iterations": before.collect::<Vec<_>>(),
    })
}

/// Returns whether the fields of an iteration are shown: on a path of the load, where it ends a step.
fn is_shown(own: &Step, next: &Step) -> bool {
    match (&own.detail, &next.detail) {
        (Detail::Unilateral(own), Detail::Unilateral(next)) => own.load < next.load,
        (Detail::Published(_), _) | (_, Detail::Published(_)) => true,
    }
}

/// Returns the fields of an iteration: the shape that it ended in is that from which the next
/// started.
fn iteration(model: &Model, stiffness: &Stiffness, [own, next]: [&Step; 2]) -> Value {
    let moved = next.shape.as_flattened().iter().zip(model.nodes.as_flattened());
    let u: Vec<f64> = moved.map(|(now, before)| now - before).collect();
    let states = stiffness.states(&u.clone().into());
    let stress: Vec<f64> = states.iter().map(|state| state.von_mises_stress).collect();
    let most = stress.iter().copied().fold(0.0, f64::max);
    let part = |x: &f64| if most > 0.0 { (x / most * 65535.0).round() as u16 } else { 0 };
    let parts: Vec<u8> = stress.iter().flat_map(|x| part(x).to_le_bytes()).collect();
    json!({ "k": own.k, "u": floats(u), "von_mises": base64(&parts), "most": most })
}

/// Returns the numbers of each quantity that is known in all triangles, by its name.
fn triangles(values: &[TriangleValues]) -> Value {
    let known = TriangleValues::QUANTITIES.iter().filter_map(|quantity| {
        let numbers = values.iter().map(|row| (quantity.value)(row).numbers());
        Some((quantity.name, floats(numbers.collect::<Option<Vec<_>>>()?.concat())))
    });
    Value::from_iter(known)
}

/// Returns CalculiX's fields as a run.
fn calculix_run(comparison: &Comparison) -> Value {
    let Fields { u, sigma } = &comparison.theirs;
    let state = |(&[x, y, z, xy, ..], von_mises): (&[f64; 6], &f64)| {
        TriangleValues::new(&TriangleState::stressed([x, y, xy, z], *von_mises))
    };
    let values: Vec<_> = sigma.iter().zip(&comparison.von_mises[1]).map(state).collect();
    json!({
        "name": "CalculiX",
        "u": floats(u.as_flattened().iter().copied()),
        "triangles": triangles(&values),
        "iterations": [],
    })
}
