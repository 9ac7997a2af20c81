//! Where a scene file is: among the embedded ones, at a path, or on standard input; and what is
//! beside it.

use std::io;
use std::path::{Path, PathBuf};

use super::embedded::{Embedded, FINDING_SCENES, SCENES};
use base::error::{InputError, Result};
use base::files::{self, kind_of};
use base::plain::{shell_word, shown};
use base::suggestion::did_you_mean;

/// The text of a scene file, and the place where its mesh file is.
#[derive(Clone)]
pub struct SceneFile {
    /// The name for folders and reports.
    pub name: String,
    /// What the file contains.
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
    /// or to its folder.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read(name_or_path: &Path) -> Result<Self> {
        if let Some(embedded) = Self::embedded(name_or_path) {
            return Ok(embedded);
        }
        if name_or_path.as_os_str() == "-" {
            let text = files::read_from(std::io::stdin(), files::MOST).map_err(|why| {
                let what = format!("the scene cannot be read: {why}");
                InputError::new("standard input", what, "direct a scene file to it")
            })?;
            let files = Files::Folder(PathBuf::new(), "standard input".into());
            return Ok(SceneFile { name: "stdin".into(), text, files });
        }
        let is_folder = name_or_path.is_dir();
        let path = if is_folder { name_or_path.join("scene.json") } else { name_or_path.into() };
        let text = files::read(&path);
        Self::from_read(&path, text, name_or_path)
    }

    /// Reads the file of an embedded scene by its name, or at a path to it or to its folder that a file
    /// in `folder` names: it leads to no place outside that folder.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn read_in(folder: &Path, name_or_path: &str) -> Result<Self> {
        let asked = Path::new(name_or_path);
        if let Some(embedded) = Self::embedded(asked) {
            return Ok(embedded);
        }
        let is_folder = folder.join(asked).is_dir();
        let name = if is_folder { asked.join("scene.json") } else { asked.into() };
        let text = files::read_in(folder, &name, files::MOST);
        Self::from_read(&folder.join(name), text, asked)
    }

    /// Reads the scene file that a snapshot in `folder` names, which may lie above it; None where none is
    /// there.
    ///
    /// # Errors
    /// The name is absolute or leads through a link, or the file cannot be read or is no scene, of which nothing is
    /// said.
    pub fn of_snapshot(folder: &Path, name: &Path) -> Result<Option<Self>> {
        let text = files::read_near(folder, name, files::MOST);
        let text = text.and_then(|text| match kind_of(&text) {
            Some("a scene file") => Ok(text),
            Some(_) | None => Err(io::Error::other("it is no scene file")),
        });
        match text {
            Err(why) if why.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(why) => {
                let what = format!("the scene {} cannot be read: {why}", shown(name));
                let fix = "name the scene that is to be run by --scene";
                Err(InputError::new("field scene_file", what, fix))
            }
            text => Self::from_read(&folder.join(name), text, name).map(Some),
        }
    }

    fn embedded(name: &Path) -> Option<Self> {
        let mut all = SCENES.iter().chain(FINDING_SCENES);
        let embedded = all.find(|scene| name.as_os_str() == scene.name)?;
        let (name, text) = (embedded.name.into(), embedded.scene.into());
        Some(SceneFile { name, text, files: Files::Embedded(embedded) })
    }

    /// Returns the scene file at `path`, asked for as `name`, with what was read there.
    fn from_read(path: &Path, text: io::Result<Vec<u8>>, name: &Path) -> Result<Self> {
        let text = text.map_err(|why| {
            let names: Vec<&str> = SCENES.iter().map(|s| s.name).collect();
            let what = format!("the scene file cannot be read: {why}");
            let near = did_you_mean(&name.to_string_lossy(), names.iter().copied());
            let first = beside(path).map_or(String::new(), |mesh| {
                format!(
                    "; plane-contact scene new {} writes a first one",
                    shell_word(&shown(&mesh))
                )
            });
            let fix =
                format!("{near}give a path, or one of the scenes {}{first}", names.join(", "));
            InputError::new(shown(path), what, fix)
        })?;
        let place = shown(path);
        no_scene(path, &text)?;
        // The folder of a pipe (`<(...)`) holds nothing of the user's.
        let (name, folder) = match path.parent().filter(|_| path.is_file()) {
            Some(folder) => (name_of(path), folder),
            None => ("stdin".into(), Path::new("")),
        };
        Ok(SceneFile { name, text, files: Files::Folder(folder.into(), place) })
    }

    /// Returns where an error of the scene stands; None of an embedded scene.
    pub fn path(&self) -> Option<&str> {
        match &self.files {
            Files::Embedded(_) => None,
            Files::Folder(_, path) => Some(path),
        }
    }

    /// Reads a file beside the scene file or below: no name leads to another place.
    ///
    /// # Errors
    /// Says why it cannot be read.
    pub fn beside(&self, file: &str) -> Result<Vec<u8>, String> {
        match &self.files {
            Files::Embedded(embedded) => {
                let found = embedded.files.iter().find(|(name, _)| *name == file);
                found.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| "not embedded".to_string())
            }
            Files::Folder(folder, _) => {
                let read = files::read_in(folder, Path::new(file), files::MOST);
                read.map_err(|why| why.to_string())
            }
        }
    }
}

/// Returns the first mesh of Gmsh in the folder of a path.
fn beside(path: &Path) -> Option<PathBuf> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty())?;
    files::names(folder, "msh").ok()?.first().map(|name| folder.join(name))
}

/// Refuses a geometry or a mesh of Gmsh, and says what a scene is.
fn no_scene(path: &Path, text: &[u8]) -> Result<()> {
    let is = |extension: &str, kind: &str| {
        path.extension().is_some_and(|own| own == extension) || kind_of(text) == Some(kind)
    };
    let (mesh, kind, first) = if is("geo", "a Gmsh geometry") {
        let geometry = shell_word(&shown(path));
        (path.with_extension("msh"), "geometry", format!("gmsh {geometry} -2 meshes it; then "))
    } else if is("msh", "a Gmsh mesh") {
        (path.to_path_buf(), "mesh", String::new())
    } else {
        return Ok(());
    };
    let what = format!(
        "this is a Gmsh {kind}, not a scene file: a scene is a JSON file beside a mesh that names materials, restraints, \
         loads and what may touch"
    );
    let fix = format!(
        "{first}plane-contact scene new {} writes a first one, to be edited",
        shell_word(&shown(&mesh))
    );
    Err(InputError::new(shown(path), what, fix))
}

/// Returns a scene's name: `strand` for `golden/strand/scene.json`, `plate` for `my/plate.json`.
fn name_of(path: &Path) -> String {
    let stem = shown(Path::new(path.file_stem().unwrap_or_default()));
    let folder = path.parent().and_then(Path::file_name).map(|name| shown(Path::new(name)));
    if stem == "scene" { folder.unwrap_or(stem) } else { stem }
}
