//! The files of a run in a folder appear all at once, in place of those of an earlier run.
//!
//! They are written to a temporary folder. It takes the place of the old one where that holds
//! nothing but unchanged files of the same command, which [`MANIFEST`] lists; that is one step of
//! the file system. Where the folder holds anything else, or cannot be moved, the files are moved
//! into it one by one, and the old run's are removed; the list is missing meanwhile.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::folder_of;
use super::manifest::{MANIFEST, Manifest, sum_of};
use super::staged::{Staged, locked, registry};
use crate::error::{InputError, Result};

/// Writes files of `command`, by their names in `folder`, all or none, and removes those that an
/// earlier run of the same command left there, unless they were changed since.
///
/// # Errors
/// The folder or a file cannot be written; what was there stays as it was.
pub fn write_all<N: AsRef<str>, C: AsRef<[u8]>>(
    folder: &Path,
    command: &str,
    files: &[(N, C)],
) -> Result<()> {
    let files: Vec<(&str, &[u8])> = files.iter().map(|(n, c)| (n.as_ref(), c.as_ref())).collect();
    write(folder, command, &files).map_err(|why| unwritable(folder, &why))
}

/// Checks that no file is in place of a folder that is to be written, before what is written is computed.
///
/// # Errors
/// Says which file.
pub fn check_folder(folder: &Path) -> Result<(), InputError> {
    no_file(folder).map_err(|why| unwritable(folder, &why))
}

fn unwritable(folder: &Path, why: &io::Error) -> InputError {
    let what = format!("the folder cannot be written: {why}");
    InputError::new(folder.display().to_string(), what, "choose another place")
}

fn no_file(folder: &Path) -> io::Result<()> {
    let Some(file) = folder.ancestors().find(|there| there.exists() && !there.is_dir()) else {
        return Ok(());
    };
    let why = format!("{} is a file", file.display());
    Err(io::Error::new(io::ErrorKind::NotADirectory, why))
}

fn write(folder: &Path, command: &str, files: &[(&str, &[u8])]) -> io::Result<()> {
    no_file(folder)?;
    if let Some((name, _)) = files.iter().find(|(name, _)| folder.join(name).is_dir()) {
        let why = format!("{name} is a folder in it");
        return Err(io::Error::new(io::ErrorKind::IsADirectory, why));
    }
    let folder = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.into());
    let home = folder_of(&folder);
    std::fs::create_dir_all(home)?;
    // A folder can be writable where the one above is not, and on a file system of its own.
    let is_inside = folder.exists() && !is_on_one_device(home, &folder);
    let staged = match Staged::new(if is_inside { &folder } else { home }) {
        Err(_) if folder.exists() => Staged::new(&folder)?,
        staged => staged?,
    };
    // Before anything is locked: who waits for other threads may begin another run's writing.
    let sum = |(name, content): &(&str, &[u8])| (name.to_string(), sum_of(content));
    let sums = files.par_iter().map(sum).collect();
    for (name, content) in files {
        let file = staged.path().join(name);
        std::fs::create_dir_all(folder_of(&file))?;
        let _undisturbed = registry();
        std::fs::write(file, content)?;
    }
    let _undisturbed = registry();
    // Runs into the same folder take turns.
    let _alone = locked(home);
    let old = Manifest::read(&folder);
    let own: BTreeSet<String> = old.unchanged(&folder, command).into_iter().collect();
    let mut manifest = old;
    manifest.set(command, sums);
    std::fs::write(staged.path().join(MANIFEST), manifest.text())?;
    if !folder.exists() {
        return std::fs::rename(staged.path(), &folder);
    }
    let is_replaced = !is_current(&folder) && has_only(&folder, Path::new(""), &own)?;
    if is_replaced && exchange(staged.path(), &folder).is_ok() {
        return Ok(());
    }
    let new: BTreeSet<String> = files.iter().map(|(name, _)| name.to_string()).collect();
    one_by_one(staged.path(), &folder, &own, &new)
}

/// Returns whether the process works in `folder`, which then cannot be another one of the same
/// name.
fn is_current(folder: &Path) -> bool {
    std::env::current_dir().is_ok_and(|current| current.starts_with(folder))
}

/// Returns whether the folder `inside` of `folder` holds nothing but the list and files of `own`.
fn has_only(folder: &Path, inside: &Path, own: &BTreeSet<String>) -> io::Result<bool> {
    for entry in std::fs::read_dir(folder.join(inside))? {
        let entry = entry?;
        let name: PathBuf = inside.join(entry.file_name());
        let is_own = match entry.file_type()?.is_dir() {
            true => {
                own.iter().any(|file| Path::new(file).starts_with(&name))
                    && has_only(folder, &name, own)?
            }
            false => {
                name == Path::new(MANIFEST) || name.to_str().is_some_and(|name| own.contains(name))
            }
        };
        if !is_own {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Moves the files `new` and the list from `staged` into `folder`, and removes those of `own` that
/// are not new.
fn one_by_one(
    staged: &Path,
    folder: &Path,
    own: &BTreeSet<String>,
    new: &BTreeSet<String>,
) -> io::Result<()> {
    match std::fs::remove_file(folder.join(MANIFEST)) {
        Err(why) if why.kind() != io::ErrorKind::NotFound => return Err(why),
        _ => {}
    }
    for name in new {
        let file = folder.join(name);
        std::fs::create_dir_all(folder_of(&file))?;
        std::fs::rename(staged.join(name), file)?;
    }
    for name in own.difference(new) {
        let file = folder.join(name);
        std::fs::remove_file(&file)?;
        // It goes where it is empty.
        let _ = std::fs::remove_dir(folder_of(&file));
    }
    std::fs::rename(staged.join(MANIFEST), folder.join(MANIFEST))
}

/// Lets two folders take each other's place, and gives `new` the permissions of `old`.
#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
fn exchange(new: &Path, old: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    std::fs::set_permissions(new, std::fs::metadata(old)?.permissions())?;
    Ok(renameat_with(CWD, new, CWD, old, RenameFlags::EXCHANGE)?)
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Returns whether what is in `home` can be moved into `folder`.
#[cfg(unix)]
fn is_on_one_device(home: &Path, folder: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let device = |path: &Path| std::fs::metadata(path).map(|there| there.dev()).ok();
    device(home) == device(folder)
}

#[cfg(not(unix))]
fn is_on_one_device(_: &Path, _: &Path) -> bool {
    true
}
