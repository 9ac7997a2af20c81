//! Files are written beside their target and then renamed, so that no file is ever half written.

use std::io::Write;
use std::path::Path;

use crate::error::{InputError, Result};

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
fn replace(path: &Path, content: &[u8]) -> std::io::Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder)?;
    let mut file = temporary(folder)?;
    file.write_all(content)?;
    file.persist(path).map_err(|failed| failed.error)?;
    Ok(())
}

/// Creates a temporary file with an ordinary file's permissions; tempfile's are the owner's alone.
fn temporary(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".plane-contact-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
