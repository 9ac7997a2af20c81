//! Where a scene file is: among the embedded ones, at a path, or on standard input; and what is
//! beside it.

use std::path::{Path, PathBuf};

use super::embedded::{Embedded, FINDING_SCENES, SCENES};
use super::source::FileBeside;
use crate::error::{InputError, Result};
use crate::files;
use crate::suggestion::did_you_mean;

/// The text of a scene file, and the place where its mesh file is.
#[derive(Clone)]
pub struct SceneFile {
    /// The name for folders and reports.
    pub name: String,
    pub text: Vec<u8>,
    files: Files,
}

/// The files beside a scene file.
#[derive(Clone)]
enum Files {
    Embedded(&'static Embedded),
    /// In a folder; the path of the scene file, for errors.
    Folder(PathBuf, String),
}

impl SceneFile {
    /// Reads the file of an embedded scene by its name, of standard input for `-`, or at a path to it
    /// or to its folder. A path that is not absolute starts in `from`.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read(name_or_path: &str, from: &Path) -> Result<Self> {
        let mut embedded = SCENES.iter().chain(FINDING_SCENES);
        if let Some(embedded) = embedded.find(|s| s.name == name_or_path) {
            let (name, text) = (embedded.name.into(), embedded.scene.into());
            return Ok(SceneFile { name, text, files: Files::Embedded(embedded) });
        }
        if name_or_path == "-" {
            let text = files::read_from(std::io::stdin()).map_err(|why| {
                let what = format!("the scene cannot be read: {why}");
                InputError::new("standard input", what, "direct a scene file to it")
            })?;
            let files = Files::Folder(PathBuf::new(), "standard input".into());
            return Ok(SceneFile { name: "stdin".into(), text, files });
        }
        let path = from.join(name_or_path);
        let path = if path.is_dir() { path.join("scene.json") } else { path };
        let text = files::read(&path).map_err(|why| {
            let names: Vec<&str> = SCENES.iter().map(|s| s.name).collect();
            let what = format!("the scene file cannot be read: {why}");
            let near = did_you_mean(name_or_path, names.iter().copied());
            let fix = format!("{near}give a path, or one of the scenes {}", names.join(", "));
            InputError::new(path.display().to_string(), what, fix)
        })?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let files = Files::Folder(folder, path.display().to_string());
        Ok(SceneFile { name: name_of(&path), text, files })
    }

    /// Returns where an error of the scene stands; None of an embedded scene.
    pub fn place(&self) -> Option<&str> {
        match &self.files {
            Files::Embedded(_) => None,
            Files::Folder(_, path) => Some(path),
        }
    }

    /// Opens a file beside the scene file.
    ///
    /// # Errors
    /// Says why it cannot be opened.
    pub fn beside(&self, file: &str) -> Result<FileBeside, String> {
        match &self.files {
            Files::Embedded(embedded) => {
                let found = embedded.files.iter().find(|(name, _)| *name == file);
                found.map(|(_, bytes)| (*bytes).into()).ok_or_else(|| "not embedded".to_string())
            }
            Files::Folder(folder, _) => open_beside(&folder.join(file)),
        }
    }
}

/// Opens an ordinary file; a device would never end.
fn open_beside(path: &Path) -> Result<FileBeside, String> {
    let metadata = std::fs::metadata(path).map_err(|why| why.to_string())?;
    if !metadata.is_file() {
        return Err("it is no ordinary file".into());
    }
    let file = std::fs::File::open(path).map_err(|why| why.to_string())?;
    Ok(FileBeside::new(file, metadata.len() as usize))
}

/// Returns a scene's name: `strand` for `golden/strand/scene.json`, `plate` for `my/plate.json`.
fn name_of(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let folder = path.parent().and_then(Path::file_name).map(|f| f.to_string_lossy().into_owned());
    if stem == "scene" { folder.unwrap_or(stem) } else { stem }
}
