//! Files and pipes that the user named, and files that stand beside them, read up to a limit.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, PoisonError};
#[cfg(unix)]
use std::time::SystemTime;

/// The most bytes of a file that is read.
pub const MOST: u64 = crate::limits::FILE;

/// What this process has opened to read.
static INPUTS: Mutex<BTreeSet<Identity>> = Mutex::new(BTreeSet::new());

/// What a file is known by, whatever it is called: its device, its number there, and when it was made, as the
/// number of a file that is gone is given to another one.
#[cfg(unix)]
type Identity = (u64, u64, Option<SystemTime>);
/// What a file is known by: its path without links.
#[cfg(not(unix))]
type Identity = PathBuf;

#[cfg(unix)]
fn identity(path: &Path) -> io::Result<Identity> {
    use std::os::unix::fs::MetadataExt;
    path.metadata().map(|file| (file.dev(), file.ino(), file.created().ok()))
}

#[cfg(not(unix))]
fn identity(path: &Path) -> io::Result<Identity> {
    path.canonicalize()
}

/// Returns whether this process has read the file at `path`, under this name or another one.
pub(super) fn is_input(path: &Path) -> bool {
    let inputs = INPUTS.lock().unwrap_or_else(PoisonError::into_inner);
    identity(path).is_ok_and(|file| inputs.contains(&file))
}

fn open(path: &Path) -> io::Result<File> {
    let file = File::open(path)?;
    if let Ok(file) = identity(path) {
        INPUTS.lock().unwrap_or_else(PoisonError::into_inner).insert(file);
    }
    Ok(file)
}

/// Reads a file or a pipe of up to 268 MB.
///
/// # Errors
/// It cannot be read, or is longer.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    read_most(path, MOST)
}

/// Reads a file or a pipe of up to `most` bytes.
///
/// # Errors
/// It cannot be read, or is longer.
pub fn read_most(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    read_from(open(path)?, most)
}

/// Reads up to `most` bytes to their end.
///
/// # Errors
/// They cannot be read, or there are more.
pub fn read_from(source: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let why = format!("it has more than {most} bytes");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, why));
    }
    Ok(bytes)
}

/// Reads an ordinary file of up to `most` bytes that another file names, in `folder` or below; the current
/// one where that is empty. A pipe would wait, and a device would never end.
///
/// # Errors
/// The name leads out of the folder, be it absolute, by `..` or through a link, or to no ordinary
/// file, or the file may not be read or is longer.
pub fn read_in(folder: &Path, name: &Path, most: u64) -> io::Result<Vec<u8>> {
    let is_plain = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    let folder = whole(folder)?;
    let path = match name.components().all(is_plain) {
        true => folder.join(name).canonicalize()?,
        false => PathBuf::new(),
    };
    if !path.starts_with(&folder) {
        return Err(leads_elsewhere("the name leads out of the folder"));
    }
    read_ordinary(&path, most)
}

/// Reads an ordinary file as [`read_in`], but that the name may lead out of the folder by `..`.
///
/// # Errors
/// The name is absolute or leads through a link, or to no ordinary file, or the file may not be read or is longer.
pub fn read_near(folder: &Path, name: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut path = whole(folder)?;
    for part in name.components() {
        match part {
            Component::Normal(name) => path.push(name),
            Component::ParentDir => drop(path.pop()),
            Component::CurDir => (),
            Component::RootDir | Component::Prefix(_) => {
                return Err(leads_elsewhere("the name is absolute"));
            }
        }
    }
    if path.canonicalize()? != path {
        return Err(leads_elsewhere("the name leads through a link"));
    }
    read_ordinary(&path, most)
}

/// Returns a folder by its path without links; the current one where it is empty.
fn whole(folder: &Path) -> io::Result<PathBuf> {
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }.canonicalize()
}

fn leads_elsewhere(why: &str) -> io::Error {
    io::Error::new(io::ErrorKind::PermissionDenied, why)
}

fn read_ordinary(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    match path.metadata()?.is_file() {
        true => read_from(open(path)?, most),
        false => Err(io::Error::other("it is no ordinary file")),
    }
}

/// Returns the path of a file from the folder of `from`, which need not be there, with `/`; None where there is no
/// such file.
pub fn from_folder_of(from: &Path, file: impl AsRef<Path>) -> Option<String> {
    let folder = from.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    // A folder that is not there yet is below one that is.
    let there = folder.ancestors().find(|folder| folder.is_dir()).unwrap_or(Path::new("."));
    let folder = there.canonicalize().ok()?.join(folder.strip_prefix(there).unwrap_or(folder));
    let file = file.as_ref().canonicalize().ok().filter(|path| path.is_file())?;
    let pairs = file.components().zip(folder.components());
    let common = pairs.take_while(|(one, other)| one == other).count();
    let up = folder.components().skip(common).map(|_| Some(".."));
    let down = file.components().skip(common).map(|part| part.as_os_str().to_str());
    Some(up.chain(down).collect::<Option<Vec<_>>>()?.join("/"))
}

/// Returns the names in `folder` that end in `.extension`, sorted; a name that is no text is left out.
///
/// # Errors
/// The folder may not be read.
pub fn names(folder: &Path, extension: &str) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in folder.read_dir()? {
        let name = entry?.file_name();
        let is_wanted = Path::new(&name).extension().is_some_and(|found| found == extension);
        names.extend(name.into_string().ok().filter(|_| is_wanted));
    }
    names.sort();
    Ok(names)
}

/// Returns what was read as [`utf8`] does.
///
/// # Errors
/// Says in which encoding it is, or in which line it is not in UTF-8.
pub fn text(bytes: Vec<u8>) -> io::Result<String> {
    let text = utf8(&bytes).map(String::from);
    text.map_err(|why| io::Error::new(io::ErrorKind::InvalidData, why))
}

/// Returns a text in UTF-8 without its byte order mark.
///
/// # Errors
/// Says in which encoding it is, or in which line it is not in UTF-8.
pub fn utf8(text: &[u8]) -> Result<&str, String> {
    match text {
        [0xFF, 0xFE, 0, 0, ..] | [0, 0, 0xFE, 0xFF, ..] => Err("the file is in UTF-32".into()),
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] | [_, 0, _, 0, ..] | [0, _, 0, _, ..] => {
            Err("the file is in UTF-16".into())
        }
        _ => {
            let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
            std::str::from_utf8(text).map_err(|wrong| {
                let before = &text[..wrong.valid_up_to()];
                let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
                format!("line {line} is not in UTF-8")
            })
        }
    }
}
