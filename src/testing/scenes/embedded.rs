//! Embedded scenes, to be changed and built anew.

use problem::scene::SCENES;
use serde_json::Value;

/// The file of an embedded scene as JSON.
pub fn scene_json(name: &str) -> Value {
    let embedded = SCENES.iter().find(|s| s.name == name).expect("an embedded scene");
    serde_json::from_slice(embedded.scene).expect("scene files are JSON")
}
