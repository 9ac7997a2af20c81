//! Embedded scenes solved.

use plane_contact::answer::contact::{Outcome, run};
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::Scene;

/// Runs an embedded scene under the default reading.
pub fn solve(scene: &str, variant: Variant) -> (Scene, Outcome) {
    let scene = Scene::open(scene).expect("embedded scenes are sound");
    let outcome = run(&scene, variant, &Reading::default(), |_| ()).expect("the variant runs");
    (scene, outcome)
}
