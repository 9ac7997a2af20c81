//! Files that the user named, written beside their place and then moved there.

use std::io;
use std::path::Path;

use tempfile::TempPath;

use super::staged::{Staged, registry};
use crate::error::{InputError, Result};

/// Writes `content` to `path`, and creates its folder where it is missing. A link is followed; a
/// target that is no ordinary file (a pipe, a device) is written directly.
///
/// # Errors
/// The folder or the file cannot be written; an existing file keeps its content.
pub fn write(path: &Path, content: &(impl AsRef<[u8]> + ?Sized)) -> Result<()> {
    let content = content.as_ref();
    let written = match std::fs::canonicalize(path) {
        Ok(there) if !there.is_file() && !there.is_dir() => std::fs::write(there, content),
        Ok(there) => put(&there, content, replace),
        Err(_) => put(path, content, replace),
    };
    written.map_err(|why| {
        let place = path.display().to_string();
        InputError::new(place, format!("the file cannot be written: {why}"), "choose another place")
    })
}

/// Checks that a file can be written to `path`, before its content is computed.
///
/// # Errors
/// A folder is in its place.
pub fn check_file(path: &Path) -> Result<()> {
    if !path.is_dir() {
        return Ok(());
    }
    let what = "the file cannot be written: it is a folder";
    Err(InputError::new(path.display().to_string(), what, "name a file"))
}

/// Writes `content` to a new file at `path`, and creates its folder where it is missing.
///
/// # Errors
/// There is a file, or it cannot be written.
pub fn write_new(path: &Path, content: &str) -> io::Result<()> {
    put(path, content.as_bytes(), |from, to| {
        Ok(TempPath::try_from_path(from)?.persist_noclobber(to)?)
    })
}

fn replace(from: &Path, to: &Path) -> io::Result<()> {
    std::fs::rename(from, to)
}

/// Writes a file in a temporary folder beside `path`, and moves it there by `rename`.
fn put(
    path: &Path,
    content: &[u8],
    rename: impl Fn(&Path, &Path) -> io::Result<()>,
) -> io::Result<()> {
    const NAME: &str = "file";
    let folder = folder_of(path);
    std::fs::create_dir_all(folder)?;
    let staged = Staged::new(folder)?;
    staged.write(NAME, content)?;
    let _undisturbed = registry();
    rename(&staged.path().join(NAME), path)
}

/// Returns the folder in which `path` lies.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
