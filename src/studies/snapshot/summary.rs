//! What a snapshot says first: of each run what a reviewer reads in a difference of two files, a line each.

use indexmap::IndexMap;
use serde_json::{Value, json};

use super::numbers::Numbers;
use super::{Entry, Quantity, Run};
use output::layout::{counted, listed};
use output::numbers::with_unit;
use problem::model::Body;
use problem::scene::{Scene, sha256};

/// The most nodes in contact that are named.
const NODES: usize = 24;

/// A line by its name.
pub type Summary = IndexMap<String, String>;

/// Sums up a run of a scene.
pub fn of(run: &Run, scene: &Scene) -> Summary {
    let array = |quantity| {
        let numbers = run.numbers.get(&Entry::from(quantity));
        numbers.filter(|numbers| !numbers.places().is_empty())
    };
    let written = |numbers: &Numbers, values: Vec<f64>| {
        let written = values.into_iter().map(|x| numbers.written(x, run.tolerance));
        with_unit(&listed(written), &numbers.unit)
    };
    let each = |numbers: &Numbers| {
        written(numbers, numbers.places().into_iter().map(|(_, x)| x).collect())
    };
    let bodies = &scene.model.bodies;
    let moved = |numbers: &Numbers| {
        written(numbers, bodies.iter().map(|body| farthest(body, numbers)).collect())
    };
    let names = listed(bodies.iter().map(|body| &body.name));
    let lines = [
        ("end".to_string(), vec![Some(end(run)), in_contact(run)]),
        (
            "force on the target; peak pressure".into(),
            vec![
                array(Quantity::ContactForce).map(each),
                array(Quantity::Pressure).map(|of| written(of, vec![of.largest()])),
            ],
        ),
        (
            format!("largest |u|; von Mises stress of {names}"),
            vec![array(Quantity::U).map(moved), array(Quantity::VonMisesStress).map(each)],
        ),
        ("arrays".into(), vec![Some(arrays(run))]),
    ];
    let known = |parts: Vec<Option<String>>| {
        let parts = parts.into_iter().map(|part| part.unwrap_or("-".into()));
        parts.collect::<Vec<_>>().join("; ")
    };
    lines.into_iter().map(|(name, parts)| (name, known(parts))).collect()
}

/// Returns the largest displacement of a body's nodes, by the displacements of all.
fn farthest(body: &Body, u: &Numbers) -> f64 {
    let places = u.places();
    let of = |k: usize| places.get(k).map_or(0.0, |(_, x)| *x);
    let sizes = body.nodes.iter().map(|node| of(2 * node.index()).hypot(of(2 * node.index() + 1)));
    sizes.fold(0.0, f64::max)
}

/// Says how a run ended.
fn end(run: &Run) -> String {
    let failure = run.fact(Quantity::Failure).filter(|failure| !failure.is_null());
    let failure = failure.map_or(String::new(), |failure| format!(": {failure}"));
    let iterations = run.fact(Quantity::Iterations).and_then(Value::as_u64);
    let iterations = iterations
        .map_or(String::new(), |n| format!(", {}", counted(n as usize, "iteration", "iterations")));
    format!("exit status {}{failure}{iterations}", run.exit_status().unwrap_or_default())
}

/// Names the nodes in contact in the last iteration.
fn in_contact(run: &Run) -> Option<String> {
    let last = run.facts.iter().rfind(|(entry, _)| entry.quantity == Quantity::InContact)?;
    let nodes = last.1.as_array()?;
    let more = if nodes.len() > NODES { ", ..." } else { "" };
    let named = listed(nodes.iter().take(NODES));
    let count = counted(nodes.len(), "node", "nodes");
    Some(format!("{count} in contact: {named}{more}"))
}

/// Returns the start of the SHA-256 of each array of the end, and of all that is recorded of iterations.
fn arrays(run: &Run) -> String {
    let hash = |value: Value| sha256(&value)[..8].to_string();
    let of_end = run.numbers.iter().filter(|(entry, _)| entry.iteration.is_none());
    let of_end = of_end.map(|(entry, own)| format!("{entry} {}", hash(json!(own.values))));
    let facts = run.facts.iter().map(|(entry, fact)| (*entry, fact.clone()));
    let numbers = run.numbers.iter().map(|(entry, own)| (*entry, json!(own.values)));
    let path: Vec<(Entry, Value)> =
        facts.chain(numbers).filter(|(entry, _)| entry.iteration.is_some()).collect();
    let path = (!path.is_empty()).then(|| format!("iterations {}", hash(json!(path))));
    listed(of_end.chain(path))
}
