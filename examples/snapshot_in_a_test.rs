//! A snapshot within `cargo test`: what a scene gives today is that which a file recorded.

use std::path::Path;

use plane_contact::studies::snapshot::{Snapshot, verify};
use plane_contact::{Error, Request, Scene, files};

/// Verifies the snapshot of a scene; records it where there is none.
///
/// # Errors
/// Those of the scene and of its solution, or the snapshot cannot be read or written.
pub fn check(scene: &str, path: &Path) -> Result<bool, Error> {
    if !path.exists() {
        let scene = Scene::open(scene)?;
        let snapshot = Snapshot::record(&scene, &[Request::new(&scene)])?;
        files::write(path, &snapshot.text())?;
    }
    let text = std::fs::read(path).expect("the snapshot was recorded");
    Ok(verify(&Snapshot::read(&text)?, None, &|| ())?.is_same())
}

/// What the test does.
#[allow(dead_code, reason = "a test calls the function above")]
fn main() -> Result<(), Error> {
    let path = std::env::temp_dir().join("fig1.snapshot.json");
    assert!(check("fig1", &path)?, "fig1 gives something else");
    Ok(())
}
