//! The page of an audit report: the first screen, the report as a document, then the fields of every run.
//!
//! Its data: one `mesh`, and `runs`, each with tables of its `result`, and fields as numbers in base64,
//! little-endian: `u` in 32 bits, and `triangles` (all components of a quantity by its name) in the first 24
//! of 32, which keep five digits. `quantities` says what there is, and in which units.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::{Contents, Run, first, parts};
use engine::{Assessment, TriangleValues};
use output::json::document;
use output::page::Page;
use output::picture::{colour, points};
use output::{ResultFile, pressure, quantities};
use problem::model::{Model, NodeId};

/// The contact nodes of a result, and what `quantities` calls what stands there.
const CONTACT: (&str, &str) = ("contact", "contact");

/// The tables of a run.
const TABLES: [(&str, &str); 3] = [("iterations", "iteration"), ("bodies", "body"), CONTACT];

/// Returns the page of a report.
pub fn html(contents: &Contents) -> String {
    let scene = contents.scene;
    let parts = parts(contents);
    let body = include_str!("page/body.html")
        .replace("FIRST", &first::html(contents, &first::menu(&parts)))
        .replace("PARTS", &parts.html());
    let quantities = quantities::on_pages();
    let own = |own: &Run| run(&pressure::name(own.solution), own, &TABLES, &quantities);
    let runs = contents.runs.par_iter().map(own).collect::<Vec<Value>>();
    let calculix = contents.calculix.as_ref().map(|compared| {
        let solution = &compared.beside.field;
        let theirs = Run { solution, assessment: Assessment::none(solution) };
        run("CalculiX", &theirs, &[CONTACT], &quantities)
    });
    let own = json!({
        "mesh": mesh(&scene.model),
        "runs": runs.into_iter().chain(calculix).collect::<Vec<_>>(),
        "own": own_run(contents),
        "equilibrium": contents.runs.last().map(|run| pressure::name(run.solution)),
        "colours": colour::parts(colour::SHADES),
        "quantities": quantities,
    });
    Page {
        title: &format!("Report: {}", scene.name),
        body: &body,
        style: include_str!("page/report.css"),
        script: &[
            output::page::TABLE,
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

/// Returns a run under a name, with these tables of its result.
fn run(name: &str, run: &Run, tables: &[(&str, &str)], known: &Value) -> Value {
    let solution = run.solution;
    let result = json!(ResultFile::new(solution, &run.assessment, None, false));
    let tables =
        tables.iter().map(|(table, place)| (*table, rows(&result[*table], &known[*place])));
    json!({
        "name": name,
        "result": Value::from_iter(tables),
        "u": floats(solution.u.iter().copied()),
        "triangles": triangles(&TriangleValues::all(solution, run.assessment.mesh_error().as_deref())),
    })
}

/// Returns rows of a result with the quantities that tables show.
fn rows(rows: &Value, known: &Value) -> Value {
    let is_shown = |name: &str| known.as_array().into_iter().flatten().any(|it| it["name"] == name);
    let row = |row: &Value| {
        let entries = row.as_object().into_iter().flatten().filter(|(name, _)| is_shown(name));
        Value::from_iter(entries.map(|(name, value)| (name.clone(), value.clone())))
    };
    rows.as_array().into_iter().flatten().map(row).collect()
}

/// Returns the numbers of each quantity that is known in all triangles, by its name.
fn triangles(values: &[TriangleValues]) -> Value {
    let known = TriangleValues::QUANTITIES.iter().filter_map(|quantity| {
        let numbers = values.iter().map(|row| (quantity.value)(row).numbers());
        let numbers = numbers.collect::<Option<Vec<_>>>()?.concat();
        let first = numbers.iter().flat_map(|x| (*x as f32).to_le_bytes()[1..].to_vec());
        Some((quantity.name, base64(&first.collect::<Vec<u8>>())))
    });
    Value::from_iter(known)
}
