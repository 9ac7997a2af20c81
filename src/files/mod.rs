//! Files are read up to a limit, as a device would never end, and written beside their target and
//! then renamed, so that no file is ever half written; those of a folder all at once.

mod folder;
pub mod json;
mod manifest;
mod set;
mod staged;

use std::collections::BTreeMap;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

pub use folder::Folder;
pub use manifest::{MANIFEST, sum_of};
pub use set::{check_folder, write_all};
pub use staged::{Staged, abandon};

use tempfile::TempPath;

use crate::error::{InputError, Result};

/// The bytes of a text that is read whole.
pub const MOST: u64 = 1 << 28;

/// What was read of pipes (`<(...)`), which give it once.
static PIPES: Mutex<BTreeMap<PathBuf, Vec<u8>>> = Mutex::new(BTreeMap::new());

/// Reads a text of up to 268 MB, of a pipe as often as it is asked for.
///
/// # Errors
/// The file cannot be read, or is longer.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    if path.is_file() {
        return read_from(std::fs::File::open(path)?);
    }
    let mut pipes = PIPES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = pipes.get(path) {
        return Ok(known.clone());
    }
    let text = read_from(std::fs::File::open(path)?)?;
    pipes.insert(path.into(), text.clone());
    Ok(text)
}

/// Reads up to 268 MB to their end.
///
/// # Errors
/// They cannot be read, or there are more.
pub fn read_from(source: impl Read) -> io::Result<Vec<u8>> {
    read_up_to(source, MOST)
}

/// Reads up to `most` bytes to their end.
///
/// # Errors
/// They cannot be read, or there are more.
pub fn read_up_to(source: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let why = format!("it has more than {most} bytes");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, why));
    }
    Ok(bytes)
}

/// Reads a text in UTF-8 of up to 268 MB.
///
/// # Errors
/// The file cannot be read, is longer, or is not in UTF-8, with the line where it is not.
pub fn read_text(path: &Path) -> io::Result<String> {
    text(read(path)?)
}

/// Returns a text in UTF-8.
///
/// # Errors
/// Says the line where it is not.
pub fn text(bytes: Vec<u8>) -> io::Result<String> {
    String::from_utf8(bytes).map_err(|wrong| {
        let before = &wrong.as_bytes()[..wrong.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
        io::Error::new(io::ErrorKind::InvalidData, format!("line {line} is not in UTF-8"))
    })
}

/// Writes `content` to `path`, and creates its folder where it is missing. A link is followed; a
/// target that is no ordinary file (a pipe, a device) is written directly.
/// Errors: the folder or the file cannot be written; an existing file keeps its content.
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

/// Writes `content` to a new file at `path`, and creates its folder where it is missing.
/// Errors: there is a file, or it cannot be written.
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
    let _undisturbed = staged::registry();
    rename(&staged.path().join(NAME), path)
}

/// Returns the folder in which `path` lies.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
