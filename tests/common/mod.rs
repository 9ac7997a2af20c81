//! What several tests share.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod golden;
pub mod recovery;
pub mod tolerances;

use plane_contact::answer::contact::{Outcome, run};
use plane_contact::paper::mirror::Reading;
use plane_contact::problem::modelling::Variant;
use plane_contact::problem::scene::{SCENES, Scene};
use serde_json::Value;

/// Runs an embedded scene under the default reading.
pub fn solve(scene: &str, variant: Variant) -> (Scene, Outcome) {
    let scene = Scene::open(scene).expect("embedded scenes are sound");
    let outcome = run(&scene, variant, &Reading::default(), |_| ()).expect("the variant runs");
    (scene, outcome)
}

/// The file of an embedded scene as JSON.
pub fn scene_json(name: &str) -> Value {
    let embedded = SCENES.iter().find(|s| s.name == name).expect("an embedded scene");
    serde_json::from_slice(embedded.scene).expect("scene files are JSON")
}

/// Builds a scene from JSON; it has no file beside it.
pub fn build(json: &Value) -> Result<Scene, plane_contact::error::InputError> {
    Scene::build("test", json.to_string().as_bytes(), |_| Err("no file".into()))
}

/// Every scene under `golden/`: those embedded by name, and those of the findings.
pub fn shipped_scenes() -> Vec<Scene> {
    let golden = concat!(env!("CARGO_MANIFEST_DIR"), "/golden");
    let mut folders: Vec<std::path::PathBuf> = [golden.to_string(), format!("{golden}/findings")]
        .iter()
        .filter_map(|folder| std::fs::read_dir(folder).ok())
        .flatten()
        .map(|entry| entry.expect("a folder entry").path())
        .filter(|path| path.join("scene.json").exists())
        .collect();
    folders.sort();
    folders.iter().filter_map(|path| Scene::open(path.to_str()?).ok()).collect()
}
