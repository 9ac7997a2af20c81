//! What CalculiX printed: it is refused, or compared with a solution in numbers that all have a value.

use std::sync::LazyLock;

use plane_contact::engine::estimates::{Certainty, certain};
use plane_contact::input::{Friction, Variant};
use plane_contact::report::comparison::{self, Compared};
use plane_contact::studies::calculix::{Comparison, Contact, Fields, Pair, parse};
use plane_contact::{Request, Scene, Solution, solve};

use super::sound;

static OURS: LazyLock<(Solution, Certainty)> = LazyLock::new(|| {
    let scene = Scene::open("two-blocks").expect("an embedded scene");
    let request = Request::new(&scene).variant(Variant::Tied);
    certain(solve(&request, &mut |_| ()).expect("it runs"))
});

pub fn hold(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let (ours, certainty) = &*OURS;
    let Solution { request, model, .. } = ours;
    let theirs = match parse(text, model.nodes.len(), model.triangles.len()) {
        Ok(fields) => fields,
        Err(error) => return sound::input_error(&error),
    };
    let compared = Compared {
        scene: &request.scene,
        model,
        variant: request.variant,
        certainty: *certainty,
        contact: &Contact::Pair(Pair::new(model, None, Friction::NONE)),
        decks: 1,
        version: "2.20",
        comparison: &Comparison::new(model, Fields::from_solution(ours), theirs),
    };
    sound::document(&comparison::json(&compared));
    sound::text(&comparison::report(&compared).text(80));
}
