//! Files and pipes that the user named, read whole up to a limit: a device would never end.

use std::collections::BTreeMap;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

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
