//! The one way in which files are written: beside their target, and then renamed.
//!
//! No link is followed but those of an absolute path, no device is written to, and what the run has read is
//! not replaced. Only what is the program's own is replaced: a file that has the *mark* of its kind, and in a
//! folder files of the same names where the last of them, the mark of the folder, is already there and was
//! written by this program. The mark is renamed first, so that a run that is killed leaves no file without
//! it.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, TempDir, TempPath};

use super::json::is_from_program;
use super::kind::{is_json, kind_of};
use super::read::{is_input, read_from};
use crate::child;
use crate::error::{InputError, Result};
use crate::plain::shown;

/// How the name of everything temporary begins.
const PREFIX: &str = ".plane-contact-";

/// The first bytes of a file that tell whether this program wrote it.
const HEAD: u64 = 1024;

/// How often something temporary is removed that another program is still writing.
const TRIES: usize = 100;

/// What tells that a page of Markdown is from this program, in its first line; no reader shows it.
pub const MARKDOWN: &str = "<!-- plane-contact -->\n";

/// What tells that a page of HTML is; like all marks it stands in the first bytes.
pub const HTML: &str = "<meta name=\"generator\" content=\"plane-contact\">";

/// What tells that a worksheet of Mathcad is; one that Mathcad saved names Mathcad there.
pub const WORKSHEET: &str = "<generator>plane-contact</generator>";

/// What begins a line of a text whose comments begin with a per cent sign.
pub const PER_CENT: &str = "% Written by plane-contact: ";

/// What begins a deck of CalculiX.
pub const DECK: &str = "** plane-contact\n";

/// The outermost element of a report for JUnit.
pub const JUNIT: &str = "<testsuites name=\"plane-contact\"";

/// All marks.
const MARKS: [&str; 6] = [MARKDOWN, HTML, WORKSHEET, PER_CENT, DECK, JUNIT];

/// The temporary files and folders of this process.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Returns the list of what is temporary; a signal waits for who holds it.
fn temporary() -> MutexGuard<'static, Vec<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the programs that this one started, removes what is temporary and does `last`, which ends the
/// process.
pub fn abandon(last: impl FnOnce()) {
    let _none_starts = child::end_all();
    let temporary = temporary();
    for path in temporary.iter() {
        // What cannot be removed is left: the process ends.
        let is_left = |_: &usize| {
            let _ = fs::remove_file(path).or_else(|_| fs::remove_dir_all(path));
            path.exists()
        };
        let _tried = (0..TRIES).take_while(is_left).count();
    }
    last();
}

/// Makes a temporary folder for another program.
///
/// # Errors
/// The system's folder for them cannot be written.
pub fn temporary_folder() -> io::Result<TempDir> {
    let mut temporary = temporary();
    let folder = Builder::new().prefix(PREFIX).tempdir()?;
    temporary.push(folder.path().into());
    Ok(folder)
}

/// Writes `content` to a file that the user named, and creates its folder where it is missing.
///
/// # Errors
/// Those of [`check_file`] for the mark of the content, but a file without it may have the same content; or the file
/// cannot be written. An existing file keeps its content.
pub fn write(path: &Path, content: &(impl AsRef<[u8]> + ?Sized)) -> Result<()> {
    let content = content.as_ref();
    let head = &content[..content.len().min(HEAD as usize)];
    let mark = MARKS.iter().find(|mark| is_marked(head, mark));
    check_new(path)?;
    if !is_same(path, content).unwrap_or(false) {
        check_file(path, mark.unwrap_or(&""))?;
    }
    let written = staged(path, content).and_then(|file| put(vec![file]));
    written.map_err(|why| unwritable(path, &why))
}

/// Checks that a file of a kind, which has that `mark`, can be written to `path`, before its content is
/// computed.
///
/// # Errors
/// There is a link, a device, a folder, a file that this run reads, or one without the mark.
pub fn check_file(path: &Path, mark: &str) -> Result<()> {
    let check = || {
        no_way_elsewhere(path, path.parent().unwrap_or(path))?;
        match is_there(path)? && !has_mark(path, mark)? {
            true => Err(foreign_file("it")),
            false => Ok(()),
        }
    };
    check().map_err(|why| unwritable(path, &why))
}

/// Returns whether two paths lead to one place, where a file need not be yet.
pub fn is_same_place(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.into());
        let folder = path.parent().and_then(|folder| folder.canonicalize().ok());
        match (folder, path.file_name()) {
            (Some(folder), Some(name)) => folder.join(name),
            _ => path,
        }
    };
    place(a) == place(b)
}

/// Refuses a path that leads to another place than it says: a hyphen, by which others name standard output, and
/// one to whose `folder` a link below the current one leads. An absolute path may lead through links.
fn no_way_elsewhere(path: &Path, folder: &Path) -> io::Result<()> {
    if path == Path::new("-") {
        return Err(io::Error::other("a hyphen is no name here; a file of that name is ./-"));
    }
    match folder.ancestors().find(|way| folder.is_relative() && way.is_symlink()) {
        Some(link) => {
            let why = "is a link: name the folder that it leads to by its absolute path";
            Err(io::Error::other(format!("{} {why}", shown(link))))
        }
        None => Ok(()),
    }
}

/// Checks that `path` is a place for a new file, before its content is computed; a file may be there.
///
/// # Errors
/// There is a link, a device or a folder.
pub fn check_new(path: &Path) -> Result<()> {
    let checked = no_way_elsewhere(path, path.parent().unwrap_or(path));
    checked.and_then(|()| ordinary(path)).map(drop).map_err(|why| unwritable(path, &why))
}

/// Writes `content` to a new file at `path`, and creates its folder where it is missing; returns whether
/// there was none.
///
/// # Errors
/// Those of [`check_new`], or it cannot be written.
pub fn write_new(path: &Path, content: &str) -> Result<bool> {
    check_new(path)?;
    let write = || {
        let (staged, target) = staged(path, content.as_bytes())?;
        let _undisturbed = temporary();
        match staged.persist_noclobber(target) {
            Err(why) if why.error.kind() == io::ErrorKind::AlreadyExists => Ok(false),
            written => Ok(written.map(|()| true)?),
        }
    };
    write().map_err(|why: io::Error| unwritable(path, &why))
}

/// Writes `content` in place of what this run read from `path`, `was`.
///
/// # Errors
/// There is a link or a device, the file was changed since it was read, or it cannot be written.
pub fn rewrite(path: &Path, was: &[u8], content: &str) -> Result<()> {
    let write = || {
        ordinary(path)?;
        let staged = staged(path, content.as_bytes())?;
        // Of several processes only one compares and replaces; a file system may have no locks.
        let there = fs::File::open(path)?;
        let _ = there.lock();
        let is_as_read = is_same(path, was)?;
        is_as_read.then(|| put(vec![staged])).transpose()
    };
    write().map_err(|why| unwritable(path, &why))?.ok_or_else(|| {
        let what = "the file cannot be written: it was changed since it was read";
        InputError::new(shown(path), what, "run it again")
    })
}

/// Writes files by their names in `folder`; the last marks the folder as this program's. All other files
/// there are left alone.
///
/// # Errors
/// Those of [`check_folder`], before anything is written; or a file cannot be written.
pub fn write_all<N: AsRef<str>, C: AsRef<[u8]>>(folder: &Path, files: &[(N, C)]) -> Result<()> {
    let write = || {
        let names: Vec<&str> = files.iter().map(|(name, _)| name.as_ref()).collect();
        let foreign = foreign(folder, &names)?;
        for (name, content) in files {
            let (name, content) = (name.as_ref(), content.as_ref());
            if foreign.contains(&name) && !is_same(&folder.join(name), content)? {
                return Err(in_the_way(name, &names));
            }
        }
        let new = files.iter().filter(|(name, _)| !foreign.contains(&name.as_ref()));
        let staged =
            new.map(|(name, content)| staged(&folder.join(name.as_ref()), content.as_ref()));
        put(staged.rev().collect::<io::Result<_>>()?)
    };
    write().map_err(|why| no_folder(folder, &why))
}

/// Checks that files of these names can be written to `folder`, before they are computed; the last is
/// the mark of the folder.
///
/// # Errors
/// Says which file is in place of the folder, or is in it and would be lost: a link, a device, a file that
/// this run reads, or any file where the mark is not there or not from this program.
pub fn check_folder<N: AsRef<str>>(folder: &Path, names: &[N]) -> Result<()> {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    let checked = foreign(folder, &names).and_then(|foreign| match foreign.first() {
        Some(name) => Err(in_the_way(name, &names)),
        None => Ok(()),
    });
    checked.map_err(|why| no_folder(folder, &why))
}

/// Returns those of the names whose files are in `folder` already and are not known to be from this
/// program.
fn foreign<'a>(folder: &Path, names: &[&'a str]) -> io::Result<Vec<&'a str>> {
    no_way_elsewhere(folder, folder)?;
    if let Some(file) = folder.ancestors().find(|there| there.exists() && !there.is_dir()) {
        let why = format!("{} is a file", shown(file));
        return Err(io::Error::new(io::ErrorKind::NotADirectory, why));
    }
    let mut there = Vec::new();
    // The mark is the last to be looked for: another run renames it first.
    for (j, name) in names.iter().enumerate() {
        if names[..j].contains(name) {
            return Err(io::Error::other(format!("two files are named {name}")));
        }
        let place =
            |why: io::Error| io::Error::new(why.kind(), format!("{name} is in the way: {why}"));
        let ways = Path::new(name).ancestors().skip(1);
        if ways.into_iter().any(|way| way != Path::new("") && folder.join(way).is_symlink()) {
            return Err(place(io::Error::other("a folder on its way is a link")));
        }
        if is_there(&folder.join(name)).map_err(place)? {
            there.push(*name);
        }
    }
    let mark = names.last().filter(|mark| there.contains(mark));
    let is_ours = mark.is_some_and(|mark| marks_a_folder(&folder.join(mark)).unwrap_or(false));
    Ok(if is_ours { Vec::new() } else { there })
}

fn head(path: &Path) -> io::Result<Vec<u8>> {
    read_from(io::Read::take(fs::File::open(path)?, HEAD), HEAD)
}

/// Returns whether this program wrote the file, which marks a folder: a page, or a document that can be made
/// again, as a snapshot cannot.
fn marks_a_folder(path: &Path) -> io::Result<bool> {
    let head = head(path)?;
    let is_document = || Ok(kind_of(&fs::read(path)?) != Some("a snapshot"));
    if is_from_program(&head) { is_document() } else { Ok(is_marked(&head, MARKDOWN)) }
}

/// Returns whether a file has a mark in its first bytes, or nothing in it.
fn has_mark(path: &Path, mark: &str) -> io::Result<bool> {
    let head = head(path)?;
    Ok(head.is_empty() || is_marked(&head, mark))
}

/// Returns whether a text has a mark, which is none where it is empty; no document of JSON has one.
fn is_marked(head: &[u8], mark: &str) -> bool {
    let has = || head.windows(mark.len()).any(|part| part == mark.as_bytes());
    !mark.is_empty() && !is_json(head) && has()
}

fn in_the_way(name: &str, names: &[&str]) -> io::Error {
    let mark = names.last().map_or("it", |mark| if *mark == name { "it" } else { mark });
    io::Error::other(format!("{name} is in the way: {}", foreign_file(mark)))
}

fn foreign_file(name: &str) -> io::Error {
    io::Error::other(format!("{name} does not tell that it is from this program"))
}

/// Returns whether there is a file at `path`, which may be replaced.
fn is_there(path: &Path) -> io::Result<bool> {
    let is_there = ordinary(path)?;
    if is_there && is_input(path) {
        return Err(io::Error::other("this run reads it"));
    }
    Ok(is_there)
}

/// Returns whether there is a file at `path`; nothing but an ordinary one may be there, which may be written.
fn ordinary(path: &Path) -> io::Result<bool> {
    let metadata = match fs::symlink_metadata(path) {
        Err(why) if why.kind() == io::ErrorKind::NotFound => return Ok(false),
        there => there?,
    };
    let there = metadata.file_type();
    match () {
        () if there.is_file() && metadata.permissions().readonly() => {
            Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is write-protected"))
        }
        () if there.is_file() => OpenOptions::new().write(true).open(path).map(|_| true),
        () if there.is_dir() => Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")),
        () if there.is_symlink() => Err(io::Error::other("it is a link")),
        () => Err(io::Error::other("it is no ordinary file")),
    }
}

/// Returns whether a file has this content.
fn is_same(path: &Path, content: &[u8]) -> io::Result<bool> {
    let is_as_long = fs::metadata(path)?.len() == content.len() as u64;
    Ok(is_as_long && fs::read(path)? == content)
}

/// Writes a temporary file beside `target`, with the owner and the mode of the file that is there, else those
/// of other files, and with their errors: files that tempfile makes are the owner's alone, and its errors
/// hold names that no two runs share.
fn staged(target: &Path, content: &[u8]) -> io::Result<(TempPath, PathBuf)> {
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    fs::create_dir_all(folder)?;
    let mut file = {
        let mut temporary = temporary();
        let create = |path: &Path| OpenOptions::new().write(true).create_new(true).open(path);
        let file = Builder::new().prefix(PREFIX).make_in(folder, create)?;
        temporary.push(file.path().into());
        file
    };
    if let Ok(there) = fs::metadata(target) {
        #[cfg(unix)]
        own_like(file.as_file(), &there)?;
        file.as_file().set_permissions(there.permissions())?;
    }
    file.as_file_mut().write_all(content)?;
    Ok((file.into_temp_path(), target.into()))
}

/// Gives a file the owner and the group of another one.
#[cfg(unix)]
fn own_like(file: &fs::File, other: &fs::Metadata) -> io::Result<()> {
    use std::os::unix::fs::{MetadataExt, fchown};
    let own = file.metadata()?;
    match (own.uid(), own.gid()) == (other.uid(), other.gid()) {
        true => Ok(()),
        false => fchown(file, Some(other.uid()), Some(other.gid())),
    }
}

/// Renames temporary files to their targets, in their order, undisturbed by a signal.
fn put(files: Vec<(TempPath, PathBuf)>) -> io::Result<()> {
    let mut temporary = temporary();
    for (file, target) in files {
        temporary.retain(|path| **path != *file);
        file.persist(target)?;
    }
    Ok(())
}

fn unwritable(path: &Path, why: &io::Error) -> InputError {
    InputError::new(shown(path), format!("the file cannot be written: {why}"), remedy(why))
}

fn no_folder(folder: &Path, why: &io::Error) -> InputError {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    InputError::new(shown(folder), format!("the folder cannot be written: {why}"), remedy(why))
}

/// Returns what to do where something cannot be written.
fn remedy(why: &io::Error) -> &'static str {
    match why.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "make room there, or choose another place"
        }
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "make it writable, or choose another place"
        }
        _ => "choose another place, or move what is in the way",
    }
}
