//! Embedded scenes solved.

use plane_contact::engine::{self, Request, Solution};
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;

/// Runs an embedded scene under the default reading.
pub fn solve(scene: &str, variant: Variant) -> (Scene, Solution) {
    let scene = Scene::open(scene).expect("embedded scenes are sound");
    let request = Request::new(&scene).variant(variant);
    let solution = engine::solve(&request, &mut |_| ()).expect("the variant runs");
    (scene, solution)
}
