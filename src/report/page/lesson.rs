//! The page of a lesson.
//!
//! Its data: `scenes`, each with its mesh and its `runs`; a run has the programs `c_cnt` and `Km`,
//! each with its lines and its steps. What repeats stands once and is named by its place: `names`
//! and `values`, `accesses` (a name and a value), `steps` (line, what decided it, reads, writes).

use std::collections::HashMap;

use serde_json::{Value, json};

use super::Page;
use crate::audit::FindingRow;
use crate::json::document;
use crate::picture::points;
use mathcad::Listing;
use problem::model::Model;
use problem::scene::Scene;
use studies::audit::findings::{Evidence, Finding};
use studies::audit::trace::{Access, Step};
use studies::lesson::{Program, Run, figure_numbers};

/// A scene of a lesson, with the runs that it offers, the first of them as printed.
pub struct Chapter {
    /// The scene on which the listings are run.
    pub scene: Scene,
    /// The runs: as printed, then with each switch.
    pub runs: Vec<Run>,
    /// What the scene is there to show, and what was measured on it.
    pub finding: Option<(&'static Finding, Evidence)>,
}

/// Returns the page of a lesson; its first chapter is what it opens with.
pub fn html(chapters: &[Chapter]) -> String {
    let scene = &chapters[0].scene;
    let mut shared = Shared::default();
    let scenes: Vec<Value> = chapters.iter().map(|chapter| shared.chapter(chapter)).collect();
    let own = json!({
        "scenes": scenes,
        "names": shared.names.items,
        "values": shared.values.items,
        "accesses": shared.accesses.items,
        "steps": shared.steps.items,
    });
    Page {
        title: &format!("Lesson: {}", scene.title),
        body: include_str!("lesson/body.html"),
        style: include_str!("lesson/lesson.css"),
        script: &[
            include_str!("lesson/machine.js"),
            include_str!("lesson/listing.js"),
            include_str!("lesson/scene.js"),
            include_str!("lesson/matrix.js"),
            include_str!("lesson/tables.js"),
            include_str!("lesson/questions.js"),
            include_str!("lesson/chapters.js"),
            include_str!("lesson/lesson.js"),
        ],
        data: &document(Some(scene), &own),
    }
    .html()
}

/// Values by their place, each once.
#[derive(Default)]
struct DistinctValues {
    items: Vec<Value>,
    places: HashMap<String, usize>,
}

impl DistinctValues {
    fn index(&mut self, item: Value) -> usize {
        let next = self.items.len();
        let place = *self.places.entry(item.to_string()).or_insert(next);
        if place == next {
            self.items.push(item);
        }
        place
    }
}

/// What the steps of all runs share.
#[derive(Default)]
struct Shared {
    names: DistinctValues,
    values: DistinctValues,
    accesses: DistinctValues,
    steps: DistinctValues,
}

impl Shared {
    fn chapter(&mut self, chapter: &Chapter) -> Value {
        let runs: Vec<Value> = chapter.runs.iter().map(|run| self.run(run)).collect();
        json!({
            "name": chapter.scene.name,
            "title": chapter.scene.title,
            "units": chapter.scene.units,
            "mesh": mesh(&chapter.runs[0].model),
            "runs": runs,
            "finding": chapter.finding.as_ref().map(|(finding, measured)| FindingRow::new(finding, measured)),
        })
    }

    fn run(&mut self, run: &Run) -> Value {
        json!({
            "name": run.switch.name,
            "about": run.switch.about,
            "c_tll": run.model.contact.tolerance,
            "programs": {
                "c_cnt": run.c_cnt.as_ref().map(|c_cnt| self.program(c_cnt)),
                "Km": run.km.as_ref().map(|km| self.program(km)),
            },
        })
    }

    fn program(&mut self, program: &Program) -> Value {
        let Program { listing, trace } = program;
        let mut turns: Vec<(usize, Option<usize>)> = Vec::new();
        for (place, step) in trace.steps.iter().enumerate() {
            if turns.last().is_none_or(|(_, turn)| *turn != step.turn) {
                turns.push((place, step.turn));
            }
        }
        let lines = listing.lines().iter().map(|line| (line.printed, line.level, &line.text));
        let steps: Vec<usize> = trace.steps.iter().map(|step| self.step(listing, step)).collect();
        json!({
            "lines": lines.collect::<Vec<_>>(),
            "steps": steps,
            "turns": turns,
            "failure": trace.result.as_ref().err().map(ToString::to_string),
        })
    }

    fn step(&mut self, listing: &Listing, step: &Step) -> usize {
        let own = |line: &mathcad::Line| (line.printed, line.in_file) == (step.line, step.in_file);
        let line = listing.lines().iter().position(own).expect("a step is of a line");
        let mut all = |accesses: &[Access]| -> Vec<usize> {
            accesses.iter().map(|access| self.access(access)).collect()
        };
        let (mut reads, writes) = (all(&step.reads), all(&step.writes));
        // An access that is read twice in a step is shown once.
        let mut seen = std::collections::HashSet::new();
        reads.retain(|read| seen.insert(*read));
        self.steps.index(json!([line, step.held, step.operands, reads, writes]))
    }

    fn access(&mut self, access: &Access) -> usize {
        let name = self.names.index(access.name.clone().into());
        let value = self.values.index(access.value.clone());
        self.accesses.index(json!([name, value]))
    }
}

/// Returns what is drawn of a model; nodes and triangles are counted from 1.
fn mesh(model: &Model) -> Value {
    let body = |id| model.bodies.iter().position(|body| body.triangles.contains(&id));
    let triangles = model.triangle_ids().map(|id| (model.triangle(id).nodes, body(id)));
    let edges = model.target_edges().map(|edge| (edge.number, edge.nodes));
    let restrained = model.node_ids().map(|node| model.restraints_of(node));
    let target = model.target().map(|target| target.nodes[0]);
    json!({
        "nodes": points(model),
        "triangles": triangles.collect::<Vec<_>>(),
        "bodies": model.bodies.iter().map(|body| &body.name).collect::<Vec<_>>(),
        "target": model.bodies.iter().position(|b| target.is_some_and(|node| b.has(node))),
        "contact": model.contact.nodes,
        "edges": edges.collect::<Vec<_>>(),
        "restrained": restrained.collect::<Vec<_>>(),
        "figure": figure_numbers(model),
    })
}
