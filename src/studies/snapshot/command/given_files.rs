//! The files that `snapshot verify` and `snapshot accept` are given, and the scenes that these are of.

use std::io;
use std::path::{Path, PathBuf};

use crate::snapshot::Snapshot;
use base::error::InputError;
use base::files::{self, kind_of};
use base::plain::shown;
use commands::note;
use engine::error::Result;
use problem::scene::{Scene, SceneFile};

/// A file, as it was read.
pub struct GivenFile<'a> {
    pub path: &'a Path,
    pub text: io::Result<Vec<u8>>,
}

/// Reads files; scenes among snapshots are skipped, which is said.
pub fn read_all(files: &[PathBuf]) -> Vec<GivenFile<'_>> {
    let read = files.iter().map(|path| GivenFile { path, text: files::read(path) });
    let (scenes, snapshots): (Vec<_>, Vec<_>) = read.partition(GivenFile::is_scene);
    if snapshots.is_empty() {
        return scenes;
    }
    for scene in scenes {
        note(&format!("note: {} is a scene, and skipped\n", shown(scene.path)));
    }
    snapshots
}

impl GivenFile<'_> {
    fn is_scene(&self) -> bool {
        self.text.as_ref().is_ok_and(|text| kind_of(text) == Some("a scene file"))
    }
}

/// Returns the scene that a snapshot's runs are made of where it is not the one in the snapshot: a `given`
/// one, or the file from which it was recorded, which may be required; and what is to be said of it.
///
/// # Errors
/// The scene is at fault, or required and gone.
pub fn scene_of(
    file: &Path,
    snapshot: &Snapshot,
    given: Option<&Scene>,
    is_required: bool,
) -> Result<(Option<Scene>, Option<String>)> {
    let (None, Some(path)) = (given, snapshot.scene_file.as_deref().map(Path::new)) else {
        return Ok((given.cloned(), None));
    };
    let today = SceneFile::of_snapshot(file.parent().unwrap_or(Path::new("")), path);
    let scene = today.map_err(|error| error.within(&shown(file)))?;
    let scene = scene.as_ref().map(Scene::of_file).transpose()?;
    let path = shown(path);
    let said = match &scene {
        None if is_required => {
            let what = format!("the scene file of {} is not there", shown(file));
            let fix = "put it back, or record the snapshot anew; without --require-scenes the scene in it is run";
            return Err(InputError::new(path, what, fix).into());
        }
        None => Some(format!("scene file {path} is not there: the scene in the snapshot is run")),
        Some(scene) => {
            let [scene_sha256, mesh_sha256] = scene.hashes();
            let own = &snapshot.input;
            let is_same = *scene_sha256 == own.scene_sha256 && *mesh_sha256 == own.mesh_sha256;
            (!is_same).then(|| format!("scene file {path}, or its mesh, was edited since"))
        }
    };
    Ok((scene, said))
}
