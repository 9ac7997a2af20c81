//! The page of a lesson, which executes the listings itself.
//!
//! Its data: `scenes`, each with its `runs`; a run has its mesh, its settings and its two listings. What
//! repeats stands once and is named by its place: `meshes`, `listings`, and the `lines` of those.

mod repairs;

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use nalgebra::DVector;
use serde_json::{Value, json};

use crate::audit::findings::{Evidence, Finding};
use crate::audit::prices::Price;
use crate::audit::tables::FindingRow;
use crate::lesson::language::{Language, messages, of_interpreter};
use crate::lesson::{MOST_SOLVED, Repairs, Switch};
use mathcad::unsupported::{FUNCTIONS, UNITS};
use mathcad::{Listing, Settings};
use output::json::document;
use output::page::{INTERPRETER, Page};
use output::tables::figure_numbers;
use paper::corrected::{Program, program};
use paper::door;
use paper::listings::Which;
use problem::model::Model;
use problem::scene::Scene;

/// A scene of a lesson, with the runs that it offers, the first of them as printed.
pub struct Chapter {
    /// The scene on which the listings are run.
    pub scene: Scene,
    /// The runs, each with its model: as printed, then with each switch.
    pub runs: Vec<(Switch, Arc<Model>)>,
    /// The contact nodes whose turns are shown; none for all.
    pub nodes: Vec<usize>,
    /// What the scene is there to show.
    pub finding: Option<Measured>,
    /// The way from the print to the right answer, which the chapter goes.
    pub repairs: Option<Repairs>,
    /// The displacements with which the iterations are compared.
    pub reference: Option<DVector<f64>>,
}

/// A finding, and what the audit has of it.
pub struct Measured {
    /// The finding.
    pub finding: &'static Finding,
    /// What was measured on its scene.
    pub evidence: Evidence,
    /// What its faults cost, each with the scene on which it was reintroduced.
    pub prices: Vec<(String, Price)>,
}

impl Measured {
    fn json(&self) -> Value {
        let price = |(scene, price): &(String, Price)| json!({ "scene": scene, "price": price });
        let mut row = json!(FindingRow { finding: self.finding, measured: &self.evidence });
        row["prices"] = self.prices.iter().map(price).collect();
        row
    }
}

/// The worksheet of a scene, and the iterations around the listings, which need the interpreter alone.
pub const ITERATE: [&str; 2] =
    [include_str!("page/iterations/worksheet.js"), include_str!("page/iterations/iterate.js")];

/// What the page calls the scene fig1 with its contact nodes lowered.
pub const LOWERED: &str = "fig1 with contact nodes lower by 10 c_tll";

/// What the names of the listings are: of which listings it is said (the print's, the corrected ones, those
/// that border MJS), the name, and what it is; a later row comes before an earlier one.
pub fn meanings() -> impl Iterator<Item = [&'static str; 3]> {
    let rows = include_str!("page/teaching/meanings.tsv").lines().skip(1);
    rows.filter_map(|row| row.split('\t').collect::<Vec<_>>().try_into().ok())
}

/// Returns the page of a lesson; its first chapter is what it opens with.
pub fn html(chapters: &[Chapter], language: Language) -> String {
    let scene = &chapters[0].scene;
    let mut shared = Shared::default();
    let scenes: Vec<Value> = chapters.iter().map(|chapter| shared.chapter(chapter)).collect();
    let corrected = json!({ "programs": shared.programs(&[]), "settings": Settings::default() });
    let own = json!({
        "scenes": scenes,
        "meshes": shared.meshes.items,
        "listings": shared.listings.items,
        "lines": shared.lines.items,
        "known": { "functions": FUNCTIONS, "units": UNITS },
        "corrected": corrected,
        "language": language,
        "interpreter": of_interpreter().collect::<Vec<_>>(),
        "meanings": meanings().collect::<Vec<_>>(),
        "messages": messages().map(|(english, russian)| (english, json!(russian))).collect::<Value>(),
    });
    let script = [
        include_str!("page/frame/interpreter.js"),
        include_str!("page/steps/machine.js"),
        include_str!("page/editor/checks.js"),
        include_str!("page/editor/kept.js"),
        include_str!("page/editor/edit.js"),
        include_str!("page/steps/listing.js"),
        include_str!("page/pictures/scene.js"),
        include_str!("page/steps/matrix.js"),
        include_str!("page/steps/tables.js"),
        include_str!("page/iterations/play.js"),
        include_str!("page/teaching/tour.js"),
        include_str!("page/teaching/questions.js"),
        include_str!("page/teaching/chapters.js"),
        include_str!("page/teaching/repairs.js"),
        include_str!("page/pictures/drag.js"),
        include_str!("page/frame/language.js"),
        include_str!("page/frame/address.js"),
        include_str!("page/frame/lesson.js"),
    ];
    Page {
        title: &format!("Lesson: {}", scene.title),
        body: include_str!("page/body.html"),
        style: include_str!("page/lesson.css"),
        script: &[&INTERPRETER[..], &ITERATE, &script].concat(),
        data: document(Some(scene), &own),
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

/// What the runs share.
#[derive(Default)]
struct Shared {
    meshes: DistinctValues,
    listings: DistinctValues,
    lines: DistinctValues,
}

impl Shared {
    fn chapter(&mut self, chapter: &Chapter) -> Value {
        let runs = chapter.runs.iter().map(|(switch, model)| self.run(switch, model));
        let mut runs: Vec<Value> = runs.collect();
        let repairs = chapter.repairs.as_ref();
        if let Some(repairs) = repairs {
            let printed = runs[0].clone();
            let after = |k| repairs::run(repairs, k, &printed, self);
            runs.extend(repairs.shown().map(after));
        }
        let finding = chapter.finding.as_ref().map(Measured::json);
        let title = match repairs {
            None => json!(chapter.scene.title),
            Some(repairs) => repairs::title(repairs),
        };
        json!({
            "name": chapter.scene.name,
            "title": title,
            "units": chapter.scene.units,
            "runs": runs,
            "nodes": chapter.nodes,
            "variant": chapter.scene.variant,
            "sha256": chapter.scene.hashes(),
            "isIterated": chapter.scene.model.nodes.len() <= MOST_SOLVED,
            "reference": chapter.reference.as_ref().map(|u| u.as_slice()),
            "finding": finding,
            "repairs": repairs.map(repairs::json),
        })
    }

    fn run(&mut self, switch: &Switch, model: &Model) -> Value {
        let [c_cnt, km] =
            [Which::CCnt, Which::Km].map(|which| self.listing(&switch.listing(which)));
        json!({
            "name": switch.name,
            "label": switch.name,
            "lines": switch.lines,
            "about": switch.about,
            "c_cnt": c_cnt,
            "Km": km,
            "settings": switch.settings(),
            "readsRestraintOfY": switch.reads_restraint_of_y(),
            "c_tll": model.contact.tolerance,
            "plane": model.plane,
            "mesh": self.meshes.index(mesh(model)),
        })
    }

    fn listing(&mut self, listing: &Listing) -> usize {
        let mut lines = vec![];
        for line in listing.lines() {
            let line = (line.printed, line.in_file, line.level, &line.text);
            lines.push(self.lines.index(json!(line)));
        }
        self.listings.index(json!(lines))
    }

    /// Returns the places of the corrected programs with some faults reintroduced.
    fn programs(&mut self, edits: &[&str]) -> BTreeMap<&'static str, usize> {
        let programs = Program::ALL.iter();
        programs.map(|own| (own.name(), self.listing(&program(*own, edits)))).collect()
    }
}

/// Returns a model's mesh, from which the page makes the worksheet's tables and draws it; nodes and
/// triangles are counted from 1.
pub fn mesh(model: &Model) -> Value {
    let body = |id| model.bodies.iter().position(|body| body.triangles.contains(&id));
    let triangle = |id| (model.triangle(id).nodes, body(id));
    let sheet = door::worksheet(model, |x| x);
    let elem = (1..=sheet.elem.rows()).map(|row| sheet.elem.row(row).collect::<Vec<_>>());
    let edges = model.target_edges().map(|edge| (edge.number, edge.nodes));
    let restrained = model.node_ids().map(|node| model.restraints_of(node));
    let target = model.target().map(|target| target.nodes[0]);
    json!({
        "nodes": model.nodes,
        "z": model.z,
        "dropped": model.dropped,
        "thickness": model.thickness,
        "elem": elem.collect::<Vec<_>>(),
        "E": sheet.E.as_slice(),
        "ν": sheet.nu.as_slice(),
        "triangles": model.triangle_ids().map(triangle).collect::<Vec<_>>(),
        "bodies": model.bodies.iter().map(|body| &body.name).collect::<Vec<_>>(),
        "target": model.bodies.iter().position(|b| target.is_some_and(|node| b.has(node))),
        "contact": model.contact.nodes,
        "load": model.load.as_slice(),
        "edges": edges.collect::<Vec<_>>(),
        "restrained": restrained.collect::<Vec<_>>(),
        "figure": figure_numbers(model),
    })
}
