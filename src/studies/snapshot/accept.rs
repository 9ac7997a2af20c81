//! A snapshot recorded again: what its runs give now takes the place of what they gave.

use rayon::prelude::*;

use super::record::{Bounds, record};
use super::{FORMAT, Input, Run, Snapshot, VERSION};
use engine::error::Result;
use problem::scene::Scene;

/// Records the runs of `snapshot` again, on its own scene or on `scene` in its place. What is recorded
/// of each, and the tolerances that it gives, stay.
///
/// # Errors
/// The snapshot or the scene is at fault.
pub fn accept(snapshot: &Snapshot, scene: Option<&Scene>) -> Result<Snapshot> {
    let (scene, input) = match scene {
        None => (snapshot.scene()?, snapshot.input.clone()),
        Some(scene) => (scene.clone(), Input::from_scene(scene)?),
    };
    let runs: Vec<(&String, &Run)> = snapshot.runs.iter().collect();
    let again = runs.par_iter().map(|(name, old)| {
        let mut run = record(&old.options.request(&scene), Bounds::Computed)?;
        run.keep_only(old.only.clone());
        for (entry, numbers) in &mut run.numbers {
            numbers.tolerance = old.numbers.get(entry).and_then(|numbers| numbers.tolerance);
        }
        Ok(((*name).clone(), run))
    });
    let runs: Vec<(String, Run)> = again.collect::<Result<_>>()?;
    let (version, units) = (VERSION.into(), scene.units.clone());
    let scene_file = snapshot.scene_file.clone();
    let runs = runs.into_iter().collect();
    Ok(Snapshot { format: FORMAT, version, units, scene_file, input, runs })
}
