//! The scenes that come with the program.

use std::path::PathBuf;

use problem::scene::Scene;

/// Every scene under `golden/`: those embedded by name, and those of the findings.
pub fn shipped_scenes() -> Vec<Scene> {
    let golden = concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden");
    let mut folders: Vec<PathBuf> = [golden.to_string(), format!("{golden}/findings")]
        .iter()
        .filter_map(|folder| std::fs::read_dir(folder).ok())
        .flatten()
        .map(|entry| entry.expect("a folder entry").path())
        .filter(|path| path.join("scene.json").exists())
        .collect();
    folders.sort();
    folders.iter().filter_map(|path| Scene::open(path.to_str()?).ok()).collect()
}
