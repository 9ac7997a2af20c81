//! Files are read up to a limit, as a device would never end, and written beside their target and
//! then renamed, so that no file is ever half written; those of a folder all at once.

mod folder;
pub mod json;
mod manifest;
mod staged;

use std::io::{self, Read, Write};
use std::path::Path;

pub use folder::{check_folder, write_all};
pub use manifest::MANIFEST;
pub use staged::{Staged, abandon};

use crate::error::{InputError, Result};

/// The bytes of a text that is read whole.
const MOST: u64 = 1 << 28;

/// Reads a text of up to 268 MB.
///
/// # Errors
/// The file cannot be read, or is longer.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    read_from(std::fs::File::open(path)?)
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
    String::from_utf8(read(path)?).map_err(|wrong| {
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
        Ok(there) => replace(&there, content),
        Err(_) => replace(path, content),
    };
    written.map_err(|why| {
        let place = path.display().to_string();
        InputError::new(place, format!("the file cannot be written: {why}"), "choose another place")
    })
}

/// Writes a file beside `path` and renames it.
fn replace(path: &Path, content: &[u8]) -> io::Result<()> {
    let folder = folder_of(path);
    std::fs::create_dir_all(folder)?;
    let _undisturbed = staged::registry();
    let mut file = staged::file(folder)?;
    file.as_file_mut().write_all(content)?;
    file.persist(path).map_err(|failed| failed.error)?;
    Ok(())
}

/// Returns the folder in which `path` lies.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
