//! The page of an exercise: a scene in tables, the listing, and a form whose answers are exported.
//! Nothing of the answers is in it, nor in the picture.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::json;

use super::Page;
use crate::language::Language;
use crate::picture::{self, Drawing};
use paper::door;
use paper::listings::Which;
use paper::mirror::Reading;
use studies::lesson::exercise::{ANSWERS, Exercise};

/// Returns the page of a student's exercise.
pub fn html(exercise: Exercise) -> String {
    let scene = exercise.scene();
    let sheet = door::worksheet(&scene.model, |x| x);
    let surface = scene.model.target_edges().flat_map(|edge| edge.nodes);
    let mut nodes: Vec<_> = surface.chain(scene.model.contact.nodes.iter().copied()).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let node = |n: &problem::model::NodeId| (n.number(), scene.model.coordinates(*n));
    let edges = scene.model.target_edges().map(|edge| (edge.number, edge.nodes));
    // The boxes and the arrows of the search are the answer.
    let drawing = Drawing { search: None, ..Drawing::new(&scene, "") };
    let picture = BASE64_STANDARD.encode(picture::mesh(&drawing));
    let listing = Which::CCnt.under(&Reading::default());
    let lines = listing.lines().iter().map(|line| (line.printed, line.level, &line.text));
    let data = json!({
        "kind": ANSWERS,
        "exercise": exercise.exercise,
        "seed": exercise.seed,
        "listing": lines.collect::<Vec<_>>(),
        "c_tll": sheet.c_tll,
        "nodes": nodes.iter().map(node).collect::<Vec<_>>(),
        "edges": edges.collect::<Vec<_>>(),
        "contact": scene.model.contact.nodes,
        "picture": picture,
    });
    Page {
        language: Language::En,
        title: &format!("Exercise {}", exercise.exercise),
        body: include_str!("exercise/body.html"),
        style: include_str!("exercise/exercise.css"),
        script: &[include_str!("table.js"), include_str!("exercise/exercise.js")],
        data,
    }
    .html()
}
