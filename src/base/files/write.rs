//! The one way in which files are written: beside their target, and then renamed.
//!
//! No link is followed but those of an absolute path, no device is written to, and what the run has read is not replaced. A file that
//! the user named is replaced. Of a folder only what is the program's own is replaced: where the last
//! of the files, the *mark* of the folder, is already there and was written by this program. The mark is
//! renamed first, so that a run that is killed leaves no file without it.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, TempDir, TempPath};

use super::json::is_from_program;
use super::read::{is_input, read_from};
use crate::child;
use crate::error::{InputError, Result};
use crate::plain::shown;

/// How the name of everything temporary begins.
const PREFIX: &str = ".plane-contact-";

/// The first bytes of a file that tell whether this program wrote it.
const HEAD: u64 = 256;

/// How often something temporary is removed that another program is still writing.
const TRIES: usize = 100;

/// What begins a page of Markdown that marks a folder; no reader shows it.
pub const MARKDOWN: &str = "<!-- plane-contact -->\n";

/// What tells that a page of HTML is from this program; it stands in the first bytes.
pub const HTML: &str = "<meta name=\"generator\" content=\"plane-contact\">";

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
/// There is a link, a device, a folder or a file that this run reads, or the file cannot be written; an
/// existing file keeps its content.
pub fn write(path: &Path, content: &(impl AsRef<[u8]> + ?Sized)) -> Result<()> {
    check_file(path)?;
    let written = staged(path, content.as_ref()).and_then(|file| put(vec![file]));
    written.map_err(|why| unwritable(path, &why))
}

/// Checks that a file can be written to `path`, before its content is computed.
///
/// # Errors
/// There is a link, a device, a folder, or a file that this run reads.
pub fn check_file(path: &Path) -> Result<()> {
    let folder = path.parent().unwrap_or(path);
    let checked = no_hyphen(path).and_then(|()| no_link(folder)).and_then(|()| is_there(path));
    checked.map(drop).map_err(|why| unwritable(path, &why))
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

/// Refuses a hyphen, by which others name standard output.
fn no_hyphen(path: &Path) -> io::Result<()> {
    match path == Path::new("-") {
        true => Err(io::Error::other("a hyphen is no name here; a file of that name is ./-")),
        false => Ok(()),
    }
}

/// Refuses a folder that a link below the current one leads to. An absolute path may lead through links.
fn no_link(folder: &Path) -> io::Result<()> {
    match folder.ancestors().find(|way| folder.is_relative() && way.is_symlink()) {
        Some(link) => {
            let why = "is a link: name the folder that it leads to by its absolute path";
            Err(io::Error::other(format!("{} {why}", shown(link))))
        }
        None => Ok(()),
    }
}

/// Writes `content` to a new file at `path`, and creates its folder where it is missing.
///
/// # Errors
/// There is a file, or it cannot be written.
pub fn write_new(path: &Path, content: &str) -> io::Result<()> {
    let (staged, target) = staged(path, content.as_bytes())?;
    let _undisturbed = temporary();
    Ok(staged.persist_noclobber(target)?)
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
        match is_same(path, was)? {
            true => put(vec![staged]),
            false => Err(io::Error::other("it was changed since it was read")),
        }
    };
    write().map_err(|why| InputError { fix: "run it again".into(), ..unwritable(path, &why) })
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
pub fn check_folder(folder: &Path, names: &[&str]) -> Result<()> {
    let checked = foreign(folder, names).and_then(|foreign| match foreign.first() {
        Some(name) => Err(in_the_way(name, names)),
        None => Ok(()),
    });
    checked.map_err(|why| no_folder(folder, &why))
}

/// Returns those of the names whose files are in `folder` already and are not known to be from this
/// program.
fn foreign<'a>(folder: &Path, names: &[&'a str]) -> io::Result<Vec<&'a str>> {
    no_hyphen(folder)?;
    no_link(folder)?;
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
    let is_ours = mark.is_some_and(|mark| is_mark(&folder.join(mark)).unwrap_or(false));
    Ok(if is_ours { Vec::new() } else { there })
}

/// Returns whether this program wrote the file, which marks a folder.
fn is_mark(path: &Path) -> io::Result<bool> {
    let head = read_from(io::Read::take(fs::File::open(path)?, HEAD), HEAD)?;
    let is_page = head.windows(HTML.len()).any(|part| part == HTML.as_bytes());
    Ok(is_from_program(&head) || is_page || head.starts_with(MARKDOWN.as_bytes()))
}

fn in_the_way(name: &str, names: &[&str]) -> io::Error {
    let mark = names.last().map_or("it", |mark| if *mark == name { "it" } else { mark });
    io::Error::other(format!(
        "{name} is in the way: {mark} does not tell that it is from this program"
    ))
}

/// Returns whether there is a file at `path`, which may be replaced.
fn is_there(path: &Path) -> io::Result<bool> {
    let is_there = ordinary(path)?;
    if is_there && is_input(path) {
        return Err(io::Error::other("this run reads it"));
    }
    Ok(is_there)
}

/// Returns whether there is a file at `path`; nothing but an ordinary one may be there.
fn ordinary(path: &Path) -> io::Result<bool> {
    let there = match fs::symlink_metadata(path) {
        Err(why) if why.kind() == io::ErrorKind::NotFound => return Ok(false),
        there => there?.file_type(),
    };
    match () {
        () if there.is_file() => Ok(true),
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

/// Writes a temporary file beside `target`, with the permissions and the errors of other files: those
/// that tempfile makes are the owner's alone, and its errors hold names that no two runs share.
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
    file.as_file_mut().write_all(content)?;
    Ok((file.into_temp_path(), target.into()))
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
    let what = format!("the file cannot be written: {why}");
    InputError::new(shown(path), what, "choose another place")
}

fn no_folder(folder: &Path, why: &io::Error) -> InputError {
    let what = format!("the folder cannot be written: {why}");
    let fix = "choose another place, or move what is in the way";
    InputError::new(shown(folder), what, fix)
}
