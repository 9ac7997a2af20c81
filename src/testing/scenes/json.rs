//! Scenes that a test writes down.

use base::error::InputError;
use problem::scene::Scene;
use serde_json::Value;

/// Builds a scene from JSON; it has no file beside it.
pub fn build(json: &Value) -> Result<Scene, InputError> {
    Scene::build("test", json.to_string().as_bytes(), |_| Err("no file".into()))
}
